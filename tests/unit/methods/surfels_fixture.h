#pragma once

#include <cstring>

#include "renderers/methods/deep-screen-space/surfels.h"
#include "renderers/methods/deep-screen-space/surfels/steps.h"
#include "shaders/methods/deep-screen-space/surfels/show.comp.h"
#include "tests/unit/methods/dss_published.h"
#include "tests/unit/passes/pass_fixture.h"
#include "tests/unit/passes/small_world.h"

namespace ir::test {

namespace dss = methods::deep_screen_space;

/// What a run differs in.
struct SurfelRun {
    dss::Parameters parameters = published();
    float reach = 1;
    std::uint64_t seed = 0;
    double initial_capacity = 1;
    const CancelToken* cancel = nullptr;
    ProgressCallback progress = {};
    Processor on = Processor::gl;
};

/// Surfels of a scene, without what splats them.
class SurfelTest : public PassTest {
  protected:
    FrameReport make(const Shot& shot, const SurfelRun& run) {
        graph::Method method;
        method.description.id = "test";
        method.description.outputs = dss::surfel_outputs();
        method.setup = [&](graph::GraphBuilder& builder, const Settings&) {
            const auto scene = passes::upload_scene(builder);
            const auto shadow = passes::shadow_maps(builder, scene, 256, Transport::Materials::lambert);
            dss::make_surfels(builder, scene, shadow, run.reach, run.parameters);
        };
        graph::FrameOptions options;
        options.wanted = {"surfels", "surfels.*"};
        options.initial_capacity = run.initial_capacity;
        options.cancel = run.cancel;
        options.progress = run.progress;
        auto inputs = shot.inputs();
        inputs.seed = run.seed;
        inputs.processor = run.on;
        return run_method(method, {}, inputs, options);
    }
    std::vector<dss::Surfel> surfels() { return elements<dss::Surfel>("surfels.records"); }
    /// As people see them, with their light.
    std::vector<dss::ShownSurfel> shown() { return elements<dss::ShownSurfel>("surfels"); }
    std::vector<dss::FineSurfel> fine() { return elements<dss::FineSurfel>("surfels.fine"); }
    dss::SurfelCounts counts() { return elements<dss::SurfelCounts>("surfels.counts").at(0); }

    template <class Record>
    static double area(const Record& record) {
        return 3.14159265358979 * record.radius * record.radius;
    }
    template <class Record>
    static double area(const std::vector<Record>& records) {
        double sum = 0;
        for (const auto& record : records) sum += area(record);
        return sum;
    }
    static double area(const scene::World& world, std::size_t triangle) {
        const auto corner = [&](std::size_t i) {
            return glm::dvec3(world.positions[world.indices[3 * triangle + i]]);
        };
        return 0.5 * glm::length(glm::cross(corner(1) - corner(0), corner(2) - corner(0)));
    }
    static double area(const scene::World& world) {
        double sum = 0;
        for (std::size_t i = 0; i < world.triangles(); ++i) sum += area(world, i);
        return sum;
    }

    static scene::Camera camera(glm::vec3 eye, glm::vec3 target, bool orthographic = false) {
        scene::Camera result;
        result.eye = eye;
        result.target = target;
        result.orthographic = orthographic;
        result.height = 4;
        return result;
    }
    /// All surfels of everything, wherever the camera looks.
    static SurfelRun whole() {
        SurfelRun run;
        run.parameters.frustum_culling = false;
        run.parameters.surfel_radius = 1.5f;
        return run;
    }
};

}  // namespace ir::test
