#pragma once

#include <cstring>
#include <random>

#include "renderers/graph/pass_context.h"
#include "renderers/methods/deep-screen-space/splatting/explain.h"
#include "tests/unit/methods/dss_fixture.h"

namespace ir::test {

struct VisibleRun {
    std::vector<Disc> surfels = {};
    dss::Parameters parameters = published();
    std::uint64_t seed = 0;
    std::vector<std::string> wanted = {"splats.hit_level", "splats.nearest", "bounce.distance"};
    Inspection inspection = {};
    double initial_capacity = 1;
};

/// n discs, independently and uniformly at random on the parallelogram from `corner` along `u` and `v`, of
/// its whole area together.
inline void scatter_discs(std::vector<Disc>& surfels, std::mt19937& random, glm::vec3 corner, glm::vec3 u,
                          glm::vec3 v, int n, glm::vec3 radiance = glm::vec3(1)) {
    std::uniform_real_distribution<float> unit(0, 1);
    const float area = glm::length(glm::cross(u, v));
    const float radius = std::sqrt(area / (3.14159265f * static_cast<float>(n)));
    for (int i = 0; i < n; ++i)
        surfels.push_back(disc(corner + unit(random) * u + unit(random) * v, glm::cross(u, v), radius,
                               static_cast<std::uint32_t>(surfels.size()), radiance));
}

class VisibleTest : public DeepScreenSpaceTest {
  protected:
    static graph::Method method(const VisibleRun& run) {
        graph::Method method;
        method.description.id = "test";
        method.description.outputs =
            joined({dss::hierarchy_outputs(), dss::splat_outputs(), dss::visible_outputs(),
                    dss::explanation_outputs(), passes::bounce::direction_outputs({}),
                    passes::bounce::sample_outputs({})});
        method.setup = [run](graph::GraphBuilder& builder, const Settings&) {
            const auto& parameters = run.parameters;
            const auto scene = passes::upload_scene(builder);
            const auto gbuffer = passes::gbuffer(builder, scene);
            const auto shadow = passes::shadow_maps(builder, scene, 256, Transport::Materials::lambert);
            const auto hierarchy = dss::shuffle(builder, gbuffer, parameters);
            passes::bounce::Batches batches(builder, parameters.directions.samples);
            const auto visible = dss::declare_visible(builder, scene, gbuffer, shadow, hierarchy,
                                                      upload(builder, run.surfels), parameters, batches);
            const auto explanation = dss::declare_explanation(builder, visible, batches.samples());
            for (const auto& batch : batches.all()) {
                dss::splat_visible(builder, visible, batch);
                dss::explain_splats(builder, explanation, visible, batch);
                batches.keep(builder, batch);
            }
            dss::judge_splats(builder, explanation, visible, batches.samples());
            dss::show_visible(builder, dss::whole(visible, batches));
        };
        return method;
    }

    FrameReport splat(const Shot& shot, const VisibleRun& run) {
        return run_shot(shot, method(run), run, run.seed);
    }
};

/// A floor in y = 0, seen from above, each pixel with independent directions: n rays in all.
inline Shot floor_shot(int size, float half = 2) {
    SmallWorld small;
    small.square({0, 0, 0}, {0, 1, 0}, 20);
    return {small.scene(), dss_camera({0, 6, 0.01f}, {0, 0, 0}, true, 2 * half), size, size};
}

inline dss::Parameters visible_parameters(int samples = 1, int levels = 1, float max_distance = 0,
                                          float shell_radius = 100) {
    auto parameters = published();
    parameters.transport.max_distance = max_distance;
    parameters.shell_radius = shell_radius;
    parameters.levels = levels;
    parameters.directions.samples = samples;
    parameters.directions.spread = passes::bounce::Spread::independent;
    parameters.coverage = 1;
    parameters.influence = dss::Influence::constant;
    return parameters;
}

}  // namespace ir::test
