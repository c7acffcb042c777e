#pragma once

#include <algorithm>
#include <cmath>

#include "renderers/methods/all_methods.h"
#include "renderers/passes/direct/direct_light.h"
#include "tests/unit/passes/pass_fixture.h"
#include "tests/unit/passes/small_world.h"

namespace ir::test {

/// How far the same picture by one body is from that by the other.
struct Apart {
    double part = 0;   ///< of the values: farther from the other's than a twentieth of their mean
    double ratio = 0;  ///< of the sums
};
inline Apart apart(const Image& image, const Image& other) {
    double sum = 0, other_sum = 0, far = 0;
    for (const float value : image.pixels) sum += value;
    const double tolerance = 0.05 * sum / static_cast<double>(image.pixels.size());
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        other_sum += other.pixels[i];
        far += std::abs(image.pixels[i] - other.pixels[i]) > tolerance;
    }
    return {far / static_cast<double>(image.pixels.size()), other_sum / sum};
}

/// A box without openings, with every source in it, a mirror, rough metal and a sheet of tinted glass.
inline scene::Scene closed_room() {
    SmallWorld small;
    for (int axis = 0; axis < 3; ++axis)
        for (const float side : {-1.0f, 1.0f}) {
            glm::vec3 normal(0);
            normal[axis] = -side;
            small.square(-2.0f * normal + glm::vec3(0, 2, 0), normal, 2);
        }
    small.square({-0.8f, 0.8f, -1}, {0.5f, 0.5f, 0.7f}, 0.6f, static_cast<SmallWorld::Material>(2));
    small.square({0.8f, 0.8f, -1}, {-0.5f, 0.5f, 0.7f}, 0.6f, static_cast<SmallWorld::Material>(3));
    small.square({0.4f, 1, 0.3f}, {0, 1, 0.2f}, 0.5f, static_cast<SmallWorld::Material>(4));
    small.square({-0.5f, 0.4f, 0.5f}, {0.3f, 1, 0}, 0.2f, static_cast<SmallWorld::Material>(5));
    auto scene = small.scene();
    scene.materials.resize(6);
    for (auto& material : scene.materials) {
        material.base_colour = {0.7f, 0.6f, 0.5f, 1};
        material.metallic = 0;
        material.roughness = 0.6f;
    }
    scene.materials[2].metallic = scene.materials[3].metallic = 1;
    scene.materials[2].roughness = 0;
    scene.materials[3].roughness = 0.25f;
    scene.materials[4].transmission = 0.9f;
    scene.materials[4].roughness = 0;
    scene.materials[5].emission = {3, 2, 1};
    scene.environment.constant = glm::vec3(5);
    for (const auto type : {scene::LightType::rectangle, scene::LightType::disk}) {
        scene::Light lamp;
        lamp.type = type;
        lamp.position = {type == scene::LightType::disk ? -1 : 1, 2.5f, 0};
        lamp.direction = glm::normalize(glm::vec3(0.1f, -1, 0.2f));
        lamp.size = {0.8f, 0.4f};
        lamp.intensity = 5;
        scene.lights.push_back(lamp);
    }
    return scene;
}

/// Light of sources with an extent, as the shared pass samples it and as the reference does.
class ExtendedLightTest : public PassTest {
  protected:
    enum class Source { rectangle, disk, mesh, constant, map };
    static constexpr int size = 48;
    Processor body = Processor::host;  ///< that samples

    /// A glossy floor and a metal wall, a plate and one with a hole above the floor, lit by one source.
    static scene::Scene room(Source source) {
        SmallWorld small;
        small.square({0, 0, 0}, {0, 1, 0}, 2);
        small.quad({-2, 0, -1.5f}, {2, 0, -1.5f}, {2, 2, -1.5f}, {-2, 2, -1.5f}, metal);
        small.square({-0.7f, 0.5f, 0}, {0, 1, 0}, 0.3f);
        small.square({0.7f, 0.5f, 0}, {0, 1, 0}, 0.3f, SmallWorld::masked);
        if (source == Source::mesh) small.square({0.3f, 1.6f, 0.2f}, {0, -1, 0}, 0.3f, emitter);
        auto scene = small.scene();
        scene.materials.resize(4);
        for (auto& material : scene.materials) {
            material.base_colour = {0.7f, 0.7f, 0.7f, 1};
            material.metallic = 0;
            material.roughness = 0.45f;
        }
        scene.materials[metal].metallic = 1;
        scene.materials[metal].roughness = 0.3f;
        scene.materials[emitter].emission = glm::vec3(6);
        light(scene, source);
        return scene;
    }

    /// The room as the camera sees it.
    static Shot shot_of(Source source) { return shot_of(room(source)); }
    static Shot shot_of(scene::Scene scene) {
        return {std::move(scene), looking({0, 1.3f, 3.2f}, {0, 0.5f, -0.2f}), size, size};
    }

    static passes::DirectLightOptions unfiltered(int samples) {
        passes::DirectLightOptions options;
        options.extended.parameters.light_samples = samples;
        options.extended.parameters.light_filter = false;
        options.extended.mirrors = false;  // as the reference's direct light
        return options;
    }

    FrameReport sample(const Shot& shot, const passes::DirectLightOptions& options, int frame = 0,
                       std::uint64_t seed = 1, int threads = 0) {
        auto inputs = shot.inputs();
        inputs.frame = frame;
        inputs.seed = seed;
        inputs.threads = threads;
        inputs.processor = body;
        return run(inputs, [&](graph::GraphBuilder& builder) {
            const auto scene = passes::upload_scene(builder);
            passes::direct_light(builder, scene, passes::gbuffer(builder, scene), options);
        });
    }
    /// Frame `frame` alone.
    FrameReport sample_anew(const Shot& shot, const passes::DirectLightOptions& options, int frame = 0,
                            std::uint64_t seed = 1, int threads = 0) {
        graph().reset_history();
        return sample(shot, options, frame, seed, threads);
    }

    /// Red with the variance of the mean.
    struct Picture {
        Image radiance, variance;
    };
    Picture sampled(const Shot& shot, const passes::DirectLightOptions& options, int frames) {
        graph().reset_history();
        for (int frame = 0; frame < frames; ++frame) sample(shot, options, frame);
        return {read("direct.radiance"), read("direct.extended.variance")};
    }
    Picture reference(const Shot& shot, std::int64_t samples, const std::string& materials = "gltf") {
        graph().reset_history();
        const auto& method = **std::ranges::find_if(
            methods::all_methods(), [](const auto* m) { return m->description.is_reference; });
        const Settings chosen{{"paths", std::string("direct")},
                              {"primary", std::string("gbuffer")},
                              {"materials", materials},
                              {"samples", samples}};
        auto inputs = shot.inputs();
        inputs.seed = 5;
        inputs.processor = body;  // the same G-buffer
        graph::FrameOptions options;
        options.wanted = {"radiance", "reference.variance"};
        graph().run(method, completed(method.description.parameters, chosen), inputs, options);
        return {read("radiance"), read("reference.variance")};
    }

    static double sum_of(const Image& image, int left, int top, int side) {
        double sum = 0;
        for (int y = top; y < top + side; ++y)
            for (int x = left; x < left + side; ++x) sum += image.at(x, y);
        return sum;
    }
    static double mean_of(const Image& image) { return sum_of(image, 0, 0, size) / (1.0 * size * size); }
    /// The largest difference of blocks of pixels, in standard errors.
    static double largest_z(const Picture& a, const Picture& b) {
        constexpr int side = 8;
        double most = 0;
        for (int y = 0; y < size; y += side)
            for (int x = 0; x < size; x += side) {
                const double difference = sum_of(a.radiance, x, y, side) - sum_of(b.radiance, x, y, side);
                const double variance = sum_of(a.variance, x, y, side) + sum_of(b.variance, x, y, side);
                if (variance > 0) most = std::max(most, std::abs(difference) / std::sqrt(variance));
            }
        return most;
    }

  private:
    static constexpr auto metal = static_cast<SmallWorld::Material>(2),
                          emitter = static_cast<SmallWorld::Material>(3);

    static void light(scene::Scene& scene, Source source) {
        scene::Light lamp;
        lamp.position = {0.3f, 1.6f, 0.2f};
        lamp.direction = glm::normalize(glm::vec3(-0.2f, -1, -0.1f));
        lamp.size = {0.8f, 0.4f};
        lamp.intensity = 5;
        if (source == Source::rectangle || source == Source::disk) {
            lamp.type = source == Source::disk ? scene::LightType::disk : scene::LightType::rectangle;
            scene.lights.push_back(lamp);
        }
        if (source == Source::constant) scene.environment.constant = glm::vec3(0.8f);
        if (source == Source::map) scene.environment.map = sky();
    }
    /// Dim, with a small bright sun.
    static std::shared_ptr<const Image> sky() {
        auto map = std::make_shared<Image>(64, 32, 3, 0.3f);
        for (int y = 6; y < 8; ++y)
            for (int x = 45; x < 47; ++x)
                for (int c = 0; c < 3; ++c) map->at(x, y, c) = 120;
        return map;
    }
};

}  // namespace ir::test
