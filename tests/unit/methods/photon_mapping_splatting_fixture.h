#pragma once

#include <cmath>
#include <cstring>
#include <random>

#include "renderers/core/record.h"
#include "renderers/graph/pass_context.h"
#include "renderers/methods/photon-mapping/splatting/splat_view.h"
#include "renderers/methods/photon-mapping/stages.h"
#include "renderers/passes/gbuffer/pixel_rays.h"
#include "shaders/methods/photon-mapping/records.glsl.h"
#include "tests/unit/methods/photon_mapping_packing.h"
#include "tests/unit/passes/pass_fixture.h"
#include "tests/unit/passes/small_world.h"

namespace ir::test {

namespace pm = methods::photon_mapping;

/// A photon as one would say it; power in W.
struct SomePhoton {
    glm::vec3 position_ws{0}, power{1}, normal{0, 0, 1}, direction{0, 0, 1};
    float ray_length = 1000;
    int bounce = 1, light = 0;
};

inline pm::Photon packed(const SomePhoton& photon, float power_unit) {
    const auto normal = pm::packed_stereographic(photon.normal);
    const auto direction = pm::packed_stereographic(photon.direction);
    pm::Photon result{};
    result.position_ws = photon.position_ws;
    result.power = pm::packed_power(photon.power / power_unit);
    result.normal = normal.xy;
    result.direction = direction.xy;
    result.ray_length = photon.ray_length;
    result.bits = (normal.below ? 1u : 0u) | (direction.below ? 2u : 0u) |
                  static_cast<std::uint32_t>(photon.bounce) << 2 |
                  static_cast<std::uint32_t>(photon.light) << 6;
    return result;
}

/// Kernels that have the power of their photons wherever they lie. Probes at edges have tests of their own.
inline pm::Parameters plain_kernels() {
    pm::Parameters parameters;
    parameters.edge_probes = false;
    return parameters;
}

/// What a run differs in.
struct SplatRun {
    std::vector<SomePhoton> photons;
    pm::Parameters parameters = plain_kernels();
    float power_unit = 1;
    std::uint64_t capacity = 0;   ///< 0: as many as there are photons
    std::uint32_t uncounted = 0;  ///< added to the counter: photons that found no place
    std::vector<std::string> wanted = {"splat.*", "photons.*", "gbuffer.*", "valid"};
    Inspection inspection = {};
    double initial_capacity = 1;
};

/// As in struct FoundPhoton of the method.
struct ExplainedPhoton {
    glm::vec3 centre, axis_u, axis_v, axis_w, contribution, power;
    std::uint32_t bounce, light;
    float distance, radius;
    std::uint32_t photon, path;
};

struct ExplainedSum {
    std::uint32_t texel_x, texel_y, photons;
    glm::vec3 gathered, pixel, difference;
};

class SplatTest : public PassTest {
  protected:
    std::vector<OutputDescription> outputs() const override { return pm::splatting_outputs(); }
    /// Declares photons with these contents.
    static pm::Photons upload(graph::GraphBuilder& builder, const SplatRun& run) {
        std::vector<pm::Photon> records;
        for (const auto& photon : run.photons) records.push_back(packed(photon, run.power_unit));
        const auto uploaded = upload_records(builder,
                                             {.text = {.key = "photons.records", .label = "Photons"},
                                              .kind = OutputKind::point_set,
                                              .fields = {}},
                                             "photons.count", records, run.capacity, run.uncounted);
        pm::Photons photons;
        photons.power_unit = run.power_unit;
        photons.records = uploaded.elements;
        photons.count = uploaded.count;
        return photons;
    }

    graph::Method method(const SplatRun& run) const {
        graph::Method method;
        method.description.id = "test";
        method.description.outputs = outputs();
        method.setup = [run](graph::GraphBuilder& builder, const Settings&) {
            const auto scene = passes::upload_scene(builder);
            const auto gbuffer = passes::gbuffer(builder, scene);
            pm::splat_photons(builder, scene, gbuffer, upload(builder, run), run.parameters);
        };
        return method;
    }

    FrameReport splat(const Shot& shot, const SplatRun& run) { return run_shot(shot, method(run), run); }

    struct Sums {
        Image irradiance, direction;
    };
    /// Of a graph that has run nothing before.
    Sums sums(const Shot& shot, SplatRun run, Processor processor = Processor::gl, int threads = 0) {
        run.wanted = {"splat.irradiance", "splat.direction"};
        graph().reset_history();
        run_shot(shot, method(run), run, 0, processor, threads);
        return {read("splat.irradiance"), read("splat.direction")};
    }
    /// Photons on the surfaces that a camera sees, with kernels as large as many texels.
    SplatRun on_what_is_seen(const Shot& shot, int photons, unsigned seed);
    /// One texel in so many may differ: at the border of a kernel it may be on either side, by rounding.
    static void expect_equal(const Sums& expected, const Sums& sums, const std::string& name,
                             int of_texels = 100) {
        ASSERT_EQ(expected.irradiance.width, sums.irradiance.width);
        double sum = 0, difference = 0;
        int lit = 0, other = 0;
        for (int y = 0; y < sums.irradiance.height; ++y)
            for (int x = 0; x < sums.irradiance.width; ++x) {
                const float value = expected.irradiance.at(x, y, 1);
                const auto is_near = [&](const Image& a, const Image& b, int c) {
                    return std::abs(a.at(x, y, c) - b.at(x, y, c)) <= 1e-5f * (1e-6f + 3 * value);
                };
                bool equal = true;
                for (int c = 0; c < 4; ++c) equal = equal && is_near(expected.irradiance, sums.irradiance, c);
                for (int c = 0; c < 2; ++c) equal = equal && is_near(expected.direction, sums.direction, c);
                lit += value > 0;
                other += !equal;
                sum += value;
                difference += sums.irradiance.at(x, y, 1) - value;
            }
        EXPECT_GT(lit, 20) << name;
        EXPECT_LE(other, 2 + lit / of_texels) << name << ", of " << lit;
        EXPECT_NEAR(difference / sum, 0, 2e-3) << name;
    }
    std::vector<ExplainedPhoton> explained_photons() const {
        return elements<ExplainedPhoton>("splat.explain.photons");
    }
    ExplainedSum explained_sum() const { return elements<ExplainedSum>("splat.explain.sum").at(0); }

    /// Σ E dA over the plane, W; areas are those at the texels' pixels.
    glm::dvec3 flux(const Shot& shot, glm::vec3 plane_normal, int divisor) const {
        const auto irradiance = read("splat.irradiance");
        const auto depth = read("splat.depth");
        const auto rays = passes::pixel_rays(shot.view);
        const bool orthographic = shot.view.clip_from_view[3][3] == 1;
        glm::dvec3 sum(0);
        for (int y = 0; y < irradiance.height; ++y)
            for (int x = 0; x < irradiance.width; ++x) {
                const auto px = glm::vec2(glm::ivec2(x, y) * divisor + pm::pixel_of_texel(divisor)) + 0.5f;
                const auto direction = rays.direction + px.x * rays.direction_dx + px.y * rays.direction_dy;
                const auto step_x = orthographic ? rays.origin_dx : rays.direction_dx;
                const auto step_y = orthographic ? rays.origin_dy : rays.direction_dy;
                const double a = double(glm::length(step_x)) * glm::length(step_y) * divisor * divisor;
                const double z = orthographic ? 1 : depth.at(x, y);
                const double area = a * z * z / std::abs(glm::dot(plane_normal, direction));
                if (std::isfinite(depth.at(x, y))) sum += area * glm::dvec3(rgb(irradiance, x, y));
            }
        return sum;
    }
};

inline scene::Camera camera_at(glm::vec3 eye, glm::vec3 target, bool orthographic = false) {
    return looking_at(eye, target, orthographic, 4, {0, 0, 1});
}

/// A square of 20 m around the origin in z = 0.
inline scene::Scene wide_square() {
    SmallWorld small;
    small.square({0, 0, 0}, {0, 0, 1}, 10);
    return small.scene();
}

/// Kernels of this radius (m) everywhere, whatever the density.
inline pm::Parameters with_radius(const Shot& shot, float radius) {
    auto parameters = plain_kernels();
    parameters.min_radius = parameters.max_radius = radius / shot.world.bounds.radius();
    parameters.min_radius_texels = 0;
    return parameters;
}

/// Photons on a camera's surfaces: at random pixels, with directions from above them.
inline std::vector<SomePhoton> on_surfaces(const Image& positions, const Image& normals, int count,
                                           unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_int_distribution<int> x(0, positions.width - 1), y(0, positions.height - 1), bounce(1, 4);
    std::uniform_real_distribution<float> unit(0.05f, 1);
    std::vector<SomePhoton> photons;
    while (static_cast<int>(photons.size()) < count) {
        const int px = x(random), py = y(random);
        const glm::vec3 normal(normals.at(px, py, 0), normals.at(px, py, 1), normals.at(px, py, 2));
        if (normal == glm::vec3(0)) continue;
        auto direction = random_direction(random);
        if (glm::dot(direction, normal) < 0) direction = -direction;
        photons.push_back(
            {.position_ws = {positions.at(px, py, 0), positions.at(px, py, 1), positions.at(px, py, 2)},
             .power = 1e-3f * glm::vec3(unit(random), unit(random), unit(random)),
             .normal = normal,
             .direction = direction,
             .ray_length = 3 * unit(random),
             .bounce = bounce(random),
             .light = bounce(random)});
    }
    return photons;
}

inline SplatRun SplatTest::on_what_is_seen(const Shot& shot, int photons, unsigned seed) {
    run_gbuffer(shot);
    SplatRun run{on_surfaces(read("gbuffer.position"), read("gbuffer.geometric_normal"), photons, seed),
                 plain_kernels()};
    run.parameters.sum_precision = pm::Precision::single_float;
    run.parameters.kernel_scale = 6;
    run.parameters.normal_axis = 0.5f;
    return run;
}

struct NamedShot {
    std::string name;
    Shot shot;
};

/// A box from afar, from its middle, and in parallel; pictures end within a tile.
inline std::vector<NamedShot> views_of_a_box(int size) {
    const auto box = scene::load_scene("builtin:cornell");
    auto close = box.cameras[0], parallel = box.cameras[0];
    close.eye = scene::bounds_of(box, 0).centre();
    close.target = close.eye + glm::vec3(0.3f, 0.2f, -1);
    parallel.orthographic = true;
    parallel.height = 0.5f * scene::bounds_of(box, 0).radius();
    return {{"perspective", Shot(box, box.cameras[0], size, size - 3)},
            {"close", Shot(box, close, size, size - 3)},
            {"parallel", Shot(box, parallel, size, size - 3)}};
}

/// Kernels around the eye, one beside it, and one behind it altogether.
inline SplatRun around_the_eye(const Shot& shot) {
    SplatRun run{{{.position_ws = {0, 0, 0}, .power = glm::vec3(2)},
                  {.position_ws = {0, 3, 0}, .power = glm::vec3(1)},
                  {.position_ws = {-0.5f, -9, 0}, .power = glm::vec3(1)}},
                 with_radius(shot, 1)};
    run.parameters.sum_precision = pm::Precision::single_float;
    return run;
}

}  // namespace ir::test
