#pragma once

#include <cmath>
#include <functional>
#include <numbers>

#include "renderers/graph/pass_context.h"
#include "renderers/passes/bounce/reconstruction.h"
#include "renderers/passes/scattering/bsdf.h"
#include "renderers/scene/frame.h"
#include "tests/unit/passes/pass_fixture.h"
#include "tests/unit/passes/small_world.h"

namespace ir::test {

namespace bounce = passes::bounce;

/// Standard normal beyond which lies 1e-4 on both sides together, and on one side.
inline constexpr double two_sided = 3.891, one_sided = 3.719;

/// χ² that is exceeded with probability 1e-4.  [Wilson31]
inline double chi_square_limit(int degrees) {
    const double part = 2.0 / (9 * degrees);
    return degrees * std::pow(1 - part + one_sided * std::sqrt(part), 3);
}

/// One large square of one material that fills an orthographic picture, so that all pixels see the same
/// surface under the same angle.
struct Wall {
    SmallWorld small;
    scene::Scene scene;
    glm::vec3 normal;
    glm::vec3 towards_eye;  ///< unit

    explicit Wall(glm::vec3 n = glm::normalize(glm::vec3(0.3f, 0.8f, 0.5f)),
                  glm::vec3 eye = glm::normalize(glm::vec3(-0.2f, 0.9f, 0.7f)))
        : normal(n), towards_eye(eye) {
        small.square({0, 0, 0}, n, 50);
        scene = small.scene();
    }
    scene::Material& material() { return scene.materials[SmallWorld::opaque]; }
    Shot shot(int width, int height) const {
        scene::Camera camera;
        camera.eye = 5.0f * towards_eye;
        camera.target = {0, 0, 0};
        camera.up = {0, 0, 1};
        camera.orthographic = true;
        camera.height = 1;
        return {scene, camera, width, height};
    }
    /// The scattering of the whole wall as light transport on the host knows it; the least roughness applied.
    passes::Bsdf bsdf(Transport::Materials model, float min_roughness = 0) const {
        const auto& m = scene.materials[SmallWorld::opaque];
        passes::Surface surface;
        surface.geometric_normal_ws = surface.shading_normal_ws = normal;
        surface.base_colour = glm::vec3(m.base_colour);
        surface.metallic = m.metallic;
        surface.roughness = std::max(m.roughness, min_roughness);
        return {surface, m, model};
    }
};

/// What a ray meets, as a test makes it up.
struct Met {
    float distance = -1;    ///< m; negative: nothing
    glm::vec3 radiance{0};  ///< W/(m² sr), for light
};
using Meeting = std::function<Met(glm::ivec2 pixel, int sample, glm::vec4 direction)>;

struct BounceRun {
    bounce::DirectionOptions options;
    bounce::ReconstructionParameters reconstruction;
    Transport transport{.max_distance = 1};
    Meeting meeting = [](glm::ivec2, int, glm::vec4) { return Met{}; };
    std::uint64_t seed = 1;
    Inspection inspection = {};
    Processor on = Processor::gl;

    static BounceRun with(int samples, bounce::Spread spread, int blur_radius) {
        BounceRun run;
        run.options.parameters.samples = samples;
        run.options.parameters.spread = spread;
        run.reconstruction.blur.blur = blur_radius > 0;
        run.reconstruction.blur.radius = blur_radius;
        return run;
    }
};

/// Standard deviation and mean of a list of numbers.
struct Moments {
    double mean = 0, deviation = 0;
    std::size_t n = 0;
    explicit Moments(const std::vector<float>& values) : n(values.size()) {
        for (const double v : values) mean += v / static_cast<double>(n);
        for (const double v : values) deviation += (v - mean) * (v - mean) / static_cast<double>(n - 1);
        deviation = std::sqrt(deviation);
    }
    double standard_error() const { return deviation / std::sqrt(static_cast<double>(n)); }
};

class BounceTest : public PassTest {
  protected:
    std::vector<OutputDescription> outputs() const override {
        return joined(
            {bounce::direction_outputs({}), bounce::sample_outputs({}), bounce::reconstruction_outputs({})});
    }
    /// Only G-buffer and directions.
    void choose_directions(const Shot& shot, const bounce::DirectionOptions& options, std::uint64_t seed = 0,
                           int frame = 0) {
        auto inputs = shot.inputs();
        inputs.seed = seed;
        inputs.frame = frame;
        run(inputs, [&](graph::GraphBuilder& builder) {
            const auto scene = passes::upload_scene(builder);
            bounce::directions(builder, scene, passes::gbuffer(builder, scene), options);
        });
    }
    /// Directions, what the run says that they meet, and "result" reconstructed of it.
    FrameReport reconstruct(const Shot& shot, const BounceRun& r) {
        auto inputs = shot.inputs();
        inputs.seed = r.seed;
        inputs.inspection = r.inspection;
        inputs.processor = r.on;
        return run(inputs, [&](graph::GraphBuilder& builder) {
            const auto scene = passes::upload_scene(builder);
            const auto gbuffer = passes::gbuffer(builder, scene);
            const auto directions = bounce::directions(builder, scene, gbuffer, r.options);
            const auto samples = meet(builder, gbuffer, directions, r);
            bounce::reconstruct(builder, scene, gbuffer, directions, samples, r.reconstruction,
                                {"result", "Result"}, 0.5f);
        });
    }
    std::vector<float> result(int channel = 0) const {
        const auto image = read("result");
        std::vector<float> values;
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x) values.push_back(image.at(x, y, channel));
        return values;
    }
    std::vector<glm::vec4> all_directions(int samples) const {
        std::vector<glm::vec4> result;
        for (int layer = 0; layer < samples; ++layer) {
            const auto image = read("bounce.directions", layer);
            for (int y = 0; y < image.height; ++y)
                for (int x = 0; x < image.width; ++x)
                    result.emplace_back(image.at(x, y, 0), image.at(x, y, 1), image.at(x, y, 2),
                                        image.at(x, y, 3));
        }
        return result;
    }

  private:
    static bounce::Samples meet(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer,
                                const bounce::Directions& directions, const BounceRun& r) {
        bounce::Samples samples;
        bounce::Batches all(directions.samples);
        samples.distance = bounce::declare_distance(builder, all);
        samples.incoming = bounce::declare_incoming(
            builder, all, r.options.light ? bounce::Effects::light : bounce::Effects::ambient_occlusion);
        auto pass = builder.pass("meet", graph::Queue::cpu);
        pass.reads(directions.directions).writes(samples.distance);
        if (r.options.light) pass.writes(samples.incoming);
        pass.execute([=, &r](graph::PassContext& context) {
            const int width = context.inputs().view.width;
            for (int layer = 0; layer < directions.samples; ++layer) {
                const auto from = context.pixels<glm::vec4>(directions.directions, layer);
                const auto distances = context.pixels<float>(samples.distance, layer);
                for (std::size_t i = 0; i < from.size(); ++i) {
                    const auto met =
                        r.meeting({static_cast<int>(i) % width, static_cast<int>(i) / width}, layer, from[i]);
                    distances[i] = met.distance;
                    if (r.options.light)
                        context.pixels<glm::vec4>(samples.incoming, layer)[i] = glm::vec4(met.radiance, 0);
                }
            }
        });
        if (!r.options.light) bounce::fill_visibility(builder, gbuffer, directions, samples, r.transport);
        return samples;
    }
};

}  // namespace ir::test
