#pragma once

#include <cmath>
#include <cstring>

#include "renderers/core/error.h"
#include "renderers/core/record.h"
#include "renderers/methods/photon-mapping/emission/histogram.h"
#include "renderers/methods/photon-mapping/emission/sources.h"
#include "renderers/methods/photon-mapping/stages.h"
#include "renderers/passes/lights/punctual.h"
#include "shaders/methods/photon-mapping/records.glsl.h"
#include "tests/unit/methods/photon_mapping_packing.h"
#include "tests/unit/passes/pass_fixture.h"
#include "tests/unit/passes/small_world.h"

namespace ir::test {

namespace pm = methods::photon_mapping;

/// Emission on a small open scene: floor and wall of different colours, and between them and the lamps a leaf
/// with a hole.
class EmissionTest : public PassTest {
  protected:
    std::vector<OutputDescription> outputs() const override { return pm::emission_outputs(); }
    static Shot room(std::vector<scene::Light> lights) {
        SmallWorld small;
        small.square({0, 0, 0}, {0, 1, 0}, 2);
        small.square({-2, 1, 0}, {1, 0, 0}, 1.5f);
        small.square({0.6f, 1, 0}, {0, 1, 0}, 0.3f, SmallWorld::masked);
        auto scene = small.scene();
        scene.materials[0].base_colour = {0.8f, 0.5f, 0.2f, 1};
        scene.materials[1].base_colour = {0.3f, 0.3f, 0.6f, 1};
        for (auto& material : scene.materials) material.metallic = 0, material.roughness = 0.6f;
        scene.lights = std::move(lights);
        return {scene, scene.cameras.at(0), 8, 8};
    }
    static scene::Light lamp(glm::vec3 position = {0, 1.5f, 0.2f}) {
        scene::Light light;
        light.position = position;
        light.colour = {1, 0.5f, 0.25f};
        light.intensity = 3;
        return light;
    }
    static scene::Light spot(float inner_degrees, float outer_degrees) {
        auto light = lamp({0, 2.5f, 0});
        light.type = scene::LightType::spot;
        light.direction = {0, -1, 0};
        light.inner_angle = glm::radians(inner_degrees);
        light.outer_angle = glm::radians(outer_degrees);
        return light;
    }
    static scene::Light sun() {
        scene::Light light;
        light.type = scene::LightType::directional;
        light.direction = glm::normalize(glm::vec3(-0.4f, -1, 0.1f));
        light.intensity = 2;
        return light;
    }
    static pm::Parameters quick() {
        pm::Parameters parameters;
        parameters.photons = 40'000;
        parameters.rsm_resolution = pm::Resolution::r128;
        return parameters;
    }

    FrameReport emit(const Shot& shot, const pm::Parameters& parameters, std::uint64_t seed = 1,
                     int frame = 0, const Inspection& inspection = {}) {
        auto inputs = shot.inputs();
        inputs.seed = seed;
        inputs.frame = frame;
        inputs.inspection = inspection;
        auto report = run(inputs, [&](graph::GraphBuilder& builder) {
            const auto scene = passes::upload_scene(builder);
            emitted_ = pm::emit(builder, scene, passes::gbuffer(builder, scene), parameters);
        });
        count_ = static_cast<std::size_t>(report.counters.at("photons.sample_count"));
        return report;
    }

    template <class T>
    std::vector<T> elements(const std::string& key) const {
        const auto bytes = graph_bytes(key);
        std::vector<T> result(bytes.size() / sizeof(T));
        std::memcpy(result.data(), bytes.data(), result.size() * sizeof(T));
        return result;
    }
    std::vector<pm::SamplePoint> samples() const {
        auto all = elements<pm::SamplePoint>("photons.samples");
        EXPECT_GE(all.size(), count_);
        all.resize(count_);
        return all;
    }
    std::vector<pm::SourceData> sources() const { return elements<pm::SourceData>("photons.sources"); }

    /// What the sample points hold together, W, and the squares of that, for its standard error.
    struct Flux {
        glm::dvec3 sum{0}, squares{0};
    };
    Flux stored() const {
        Flux flux;
        for (const auto& sample : samples()) {
            const auto power = glm::dvec3(pm::unpacked_power(sample.power)) * double(emitted_.power_unit) *
                               double(emitted_.photons_per_point);
            flux.sum += power;
            flux.squares += power * power;
        }
        return flux;
    }

    /// Σ Φ_i over the texels of the RSM that photons leave, by other code than the shaders'.
    glm::dvec3 flux_of_texels(const Shot& shot, const pm::Parameters& parameters) const {
        const int size = pm::texels(parameters.rsm_resolution);
        const auto views = passes::shadow_views(shot.world, size);
        glm::dvec3 sum(0);
        for (std::size_t layer = 0; layer < views.size(); ++layer) {
            const auto depth = read("rsm.depth", static_cast<int>(layer));
            const auto normal = read("rsm.normal_metalness", static_cast<int>(layer));
            for (int y = 0; y < size; ++y)
                for (int x = 0; x < size; ++x)
                    if (normal.at(x, y, 3) > 0)
                        sum += flux_of_texel(shot, parameters, views[layer], depth.at(x, y), x, y);
        }
        return sum;
    }

    const pm::SamplePoints& emitted() const { return emitted_; }
    std::size_t count() const { return count_; }

  private:
    std::vector<std::byte> graph_bytes(const std::string& key) const {
        auto bytes = const_cast<EmissionTest*>(this)->graph().read_buffer(key);
        if (!bytes) throw std::runtime_error("no buffer " + key);
        return *bytes;
    }
    static glm::dvec3 flux_of_texel(const Shot& shot, const pm::Parameters& parameters,
                                    const passes::ShadowViewData& view, float stored, int x, int y) {
        const auto& light = shot.world.lights.at(static_cast<std::size_t>(view.light));
        const double size = pm::texels(parameters.rsm_resolution);
        const double area = 4 * glm::length(view.right_ws) * glm::length(view.up_ws) / (size * size);
        const glm::dvec2 ndc(2 * (x + 0.5) / size - 1, 1 - 2 * (y + 0.5) / size);
        const auto lateral = ndc.x * glm::dvec3(view.right_ws) + ndc.y * glm::dvec3(view.up_ws);
        const glm::dvec3 intensity = glm::dvec3(light.colour) * double(light.intensity);
        const double depth = double(stored) * view.far;
        const auto inside = [&](double distance) {
            return distance >= parameters.photon_near &&
                   (parameters.photon_far == 0 || distance <= parameters.photon_far);
        };
        if (view.perspective == 0) return inside(depth) ? intensity * area : glm::dvec3(0);
        const auto direction = glm::dvec3(view.forward_ws) + lateral;
        const double slant = glm::length(direction), distance = depth * slant;
        if (!inside(distance)) return glm::dvec3(0);
        const auto arriving = passes::punctual_arrival(
            light, light.position + glm::vec3(direction / slant));  // at 1 m: intensity and profile
        if (!arriving) return glm::dvec3(0);
        const double window = passes::range_window(light.range, static_cast<float>(distance)) /
                              passes::range_window(light.range, 1);
        return glm::dvec3(arriving->irradiance) * window * area / (slant * slant * slant);
    }

    pm::SamplePoints emitted_;
    std::size_t count_ = 0;
};

/// Standard normal beyond which lies 1e-4 on both sides together, and on one side.
inline constexpr double two_sided = 3.891, one_sided = 3.719;

/// χ² that is exceeded with probability 1e-4.  [Wilson31]
inline double chi_square_limit(int degrees) {
    const double part = 2.0 / (9 * degrees);
    return degrees * std::pow(1 - part + one_sided * std::sqrt(part), 3);
}

/// Standard errors by which a sum of independent powers misses what was expected, in its worst channel. The
/// squares of all bound the variance.
template <class Flux>
double deviation(const Flux& flux, glm::dvec3 expected) {
    double worst = 0;
    for (int i = 0; i < 3; ++i)
        worst = std::max(worst, std::abs(flux.sum[i] - expected[i]) / std::sqrt(flux.squares[i]));
    return worst;
}

}  // namespace ir::test
