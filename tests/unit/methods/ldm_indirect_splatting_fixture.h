#pragma once

#include <cmath>
#include <cstring>
#include <numbers>
#include <random>

#include "renderers/core/record.h"
#include "renderers/graph/pass_context.h"
#include "renderers/methods/ldm-indirect/stages.h"
#include "renderers/passes/gbuffer/pixel_rays.h"
#include "tests/unit/passes/pass_fixture.h"
#include "tests/unit/passes/small_world.h"

namespace ir::test {

namespace li = methods::ldm_indirect;

/// How photons are added, and where.
struct Way {
    const char* name;
    li::Splatting splatting;
    Processor processor = Processor::gl;
};
inline constexpr Way all_ways[] = {{"quads", li::Splatting::quads},
                                   {"tiles", li::Splatting::tiles},
                                   {"tiles on the host", li::Splatting::tiles, Processor::host},
                                   {"image-atomics", li::Splatting::image_atomics}};

/// A photon as one would say it. It comes from above +Z in the one direction of a single map, which is +Y:
/// `leg` 0 comes from +Y, bit 16 from -Y.
struct FreePhoton {
    glm::vec3 position_ws{0}, axis_u{0.3f, 0, 0}, axis_v{0, 0.3f, 0}, flux{1, 2, 3}, normal{0, 0, 1};
    std::uint32_t leg = 1u << 17, source = 0;
    float path_length = 1;
};

inline li::Photon record_of(const FreePhoton& photon) {
    return {photon.position_ws, photon.source,      photon.axis_u, photon.leg,
            photon.axis_v,      photon.path_length, photon.flux,   octahedral(photon.normal)};
}

struct IndirectRun {
    std::vector<FreePhoton> photons = {};
    li::Parameters parameters = {};
    std::uint64_t capacity = 0;  ///< 0: as many as there are photons
    std::vector<std::string> wanted = {"indirect.*", "gbuffer.position", "gbuffer.geometric_normal"};
    Inspection inspection = {};
    double initial_capacity = 1;
    bool composed = false;
    Processor processor = Processor::gl;
    int threads = 0;
    void by(const Way& way) {
        parameters.splatting = way.splatting;
        processor = way.processor;
    }
};

/// What eqs. 4 to 7 add at x, as printed; without their π the mutant. [Aalund15]
inline glm::dvec3 printed_contribution(const FreePhoton& photon, const li::Parameters& parameters,
                                       glm::dvec3 x, bool with_pi = true) {
    const double s = parameters.splat_size;
    const auto d_u = 2 * s * glm::dvec3(photon.axis_u), d_v = 2 * s * glm::dvec3(photon.axis_v);
    const auto n = glm::dvec3(photon.normal), d = x - glm::dvec3(photon.position_ws);
    const double parallelogram = glm::length(glm::cross(d_u, d_v));
    const double a = parameters.topological_bias * std::sqrt(parallelogram);
    const double scale = 2 / glm::dot(d_u, glm::cross(d_v, n));
    const auto rows =
        glm::dvec3(glm::dot(glm::cross(d_v, n), d), glm::dot(glm::cross(n, d_u), d), a * glm::dot(n, d));
    const double l = scale * scale * glm::dot(rows, rows);
    if (l >= 1) return glm::dvec3(0);
    using std::numbers::pi;
    const auto irradiance = glm::dvec3(photon.flux) / (pi / 4 * parallelogram);
    return irradiance * (with_pi ? pi : 1) * 3.0 / pi * (1 - l) * (1 - l);
}

inline scene::Camera splat_camera(glm::vec3 eye, glm::vec3 target, bool orthographic = false) {
    return looking_at(eye, target, orthographic, 3, {0, 0, 1});
}

/// A square of 2 half m around the origin in z = 0, and a lamp above it that photons with bit 17 come from.
inline scene::Scene lit_square(float half = 20) {
    SmallWorld small;
    small.square({0, 0, 0}, {0, 0, 1}, half);
    auto scene = small.scene();
    scene::Light light;
    light.position = {0, 0, 30};
    scene.lights.push_back(light);
    return scene;
}

/// What a surface with normal n gets more than the photon's plane, of light that comes from the lamp.
inline double turned(const FreePhoton& photon, const glm::dvec3& n) {
    const auto towards = glm::normalize(glm::dvec3(0, 0, 30) - glm::dvec3(photon.position_ws));
    const double cosine = glm::dot(glm::dvec3(photon.normal), towards);
    return cosine < 0.9999 ? std::clamp(glm::dot(n, towards) / cosine, 0.0, 4.0) : 1.0;
}

/// No clamps but those asked for, and direct photons.
inline li::Parameters free_parameters() {
    li::Parameters parameters;
    parameters.maps.directions = 1;
    parameters.direct = li::DirectBy::photons;
    parameters.max_axis = 10;
    return parameters;
}

class IndirectSplatTest : public PassTest {
  protected:
    static li::Photons upload(graph::GraphBuilder& builder, const IndirectRun& run) {
        std::vector<li::Photon> records;
        for (const auto& photon : run.photons) records.push_back(record_of(photon));
        const auto photons = upload_records(builder,
                                            {.text = {.key = "indirect.photons", .label = "Photons"},
                                             .kind = OutputKind::glyphs,
                                             .fields = {}},
                                            "indirect.photon_count", records, run.capacity);
        return {photons.elements, photons.count};
    }

    static graph::Method method(const IndirectRun& run) {
        graph::Method method;
        method.description.id = "test";
        method.description.outputs = li::splatting_outputs();
        method.setup = [run](graph::GraphBuilder& builder, const Settings&) {
            const auto scene = passes::upload_scene(builder);
            const auto gbuffer = passes::gbuffer(builder, scene);
            const auto photons = upload(builder, run);
            const auto splat = li::splat_photons(builder, gbuffer, photons, run.parameters);
            if (run.composed) li::compose(builder, scene, gbuffer, photons, splat, run.parameters);
            li::explain(builder, gbuffer, photons, splat, run.parameters);
        };
        return method;
    }

    FrameReport splat(const Shot& shot, const IndirectRun& run) {
        return run_shot(shot, method(run), run, 0, run.processor, run.threads);
    }

    /// Σ E dA over the plane that all pixels show, W; areas are those at the pixels' middles.
    glm::dvec3 flux(const Shot& shot, glm::dvec3 plane_normal) {
        const auto irradiance = read("indirect.irradiance"), position = read("gbuffer.position");
        const auto rays = passes::pixel_rays(shot.view);
        const bool orthographic = shot.view.clip_from_view[3][3] == 1;
        const auto axis = -glm::dvec3(glm::vec3(glm::transpose(shot.view.view_from_world)[2]));
        glm::dvec3 sum(0);
        for (int y = 0; y < irradiance.height; ++y)
            for (int x = 0; x < irradiance.width; ++x) {
                const auto direction = glm::dvec3(rays.direction + (x + 0.5f) * rays.direction_dx +
                                                  (y + 0.5f) * rays.direction_dy);
                const auto step_x = orthographic ? rays.origin_dx : rays.direction_dx;
                const auto step_y = orthographic ? rays.origin_dy : rays.direction_dy;
                const double z =
                    orthographic
                        ? 1
                        : glm::dot(glm::dvec3(rgb(position, x, y)) - glm::dvec3(shot.view.eye_ws), axis);
                const double area = double(glm::length(step_x)) * glm::length(step_y) * z * z /
                                    std::abs(glm::dot(plane_normal, direction));
                sum += area * glm::dvec3(rgb(irradiance, x, y));
            }
        return sum;
    }

    /// Photons in one place on a picture of size² pixels, by all ways.
    void expect_overlapping(std::size_t count, int size) {
        const Shot shot(lit_square(), splat_camera({0, 0, 4}, {0, 0, 0}), size, size);
        IndirectRun run{.photons = std::vector<FreePhoton>(count), .parameters = free_parameters()};
        std::mt19937 random(3);
        std::uniform_real_distribution<float> unit(0.5f, 1.5f);
        glm::dvec3 flux(0);
        for (auto& photon : run.photons) {  // the same rounding a million times would be an error
            photon.flux = glm::vec3(unit(random), 1, 1);
            flux += photon.flux;
        }
        run.wanted = {"indirect.irradiance", "gbuffer.position"};
        for (const auto& way : all_ways) {
            run.by(way);
            splat(shot, run);
            const auto irradiance = read("indirect.irradiance");
            const int middle = size / 2;
            auto one = run.photons[0];
            one.flux = glm::vec3(flux);
            const auto expected =
                printed_contribution(one, run.parameters, rgb(read("gbuffer.position"), middle, middle));
            EXPECT_NEAR(irradiance.at(middle, middle, 0), expected.r, 1e-3 * expected.r) << way.name;
            EXPECT_EQ(irradiance.at(middle, middle, 3), float(count));
        }
    }
};

}  // namespace ir::test
