#pragma once

#include <cmath>
#include <cstring>

#include "renderers/graph/method.h"
#include "renderers/methods/ldm-indirect/stages.h"
#include "renderers/methods/ldm-indirect/tracing/energy.h"
#include "renderers/passes/ldm/builder.h"
#include "tests/unit/passes/pass_fixture.h"
#include "tests/unit/passes/small_world.h"

namespace ir::test {

namespace li = methods::ldm_indirect;

/// Emission and tracing of ldm-indirect, without what splats the photons.
class IndirectTracingTest : public PassTest {
  protected:
    static scene::Light lamp(glm::vec3 position, float intensity = 3) {
        scene::Light light;
        light.position = position;
        light.colour = {1, 0.5f, 0.25f};
        light.intensity = intensity;
        return light;
    }
    static scene::Light spot(glm::vec3 position, glm::vec3 direction, float outer_degrees) {
        auto light = lamp(position);
        light.type = scene::LightType::spot;
        light.direction = glm::normalize(direction);
        light.inner_angle = 0;
        light.outer_angle = glm::radians(outer_degrees);
        return light;
    }
    static scene::Light sun(glm::vec3 direction) {
        scene::Light light;
        light.type = scene::LightType::directional;
        light.direction = glm::normalize(direction);
        light.intensity = 2;
        return light;
    }
    static scene::Camera camera(glm::vec3 eye, glm::vec3 target) {
        scene::Camera result;
        result.eye = eye;
        result.target = target;
        result.fov_y = 1.4f;
        return result;
    }

    /// A box of walls that look inwards, 4 m wide, 3 m high, of one colour each.
    static scene::Scene box(std::vector<scene::Light> lights, glm::vec3 reflectance = {0.8f, 0.5f, 0.2f}) {
        SmallWorld small;
        small.quad({-2, 0, -2}, {-2, 0, 2}, {2, 0, 2}, {2, 0, -2});
        small.quad({-2, 3, -2}, {2, 3, -2}, {2, 3, 2}, {-2, 3, 2});
        small.quad({-2, 0, -2}, {2, 0, -2}, {2, 3, -2}, {-2, 3, -2});
        small.quad({-2, 0, 2}, {-2, 3, 2}, {2, 3, 2}, {2, 0, 2});
        small.quad({-2, 0, -2}, {-2, 3, -2}, {-2, 3, 2}, {-2, 0, 2});
        small.quad({2, 0, -2}, {2, 0, 2}, {2, 3, 2}, {2, 3, -2});
        return with(small.scene(), std::move(lights), reflectance);
    }
    /// Floor and ceiling, 8 m wide, 2 m apart.
    static scene::Scene planes(std::vector<scene::Light> lights, glm::vec3 reflectance = {0.8f, 0.5f, 0.2f}) {
        SmallWorld small;
        small.square({0, 0, 0}, {0, 1, 0}, 4);
        small.square({0, 2, 0}, {0, -1, 0}, 4);
        return with(small.scene(), std::move(lights), reflectance);
    }
    static scene::Scene with(scene::Scene scene, std::vector<scene::Light> lights, glm::vec3 reflectance) {
        for (auto& material : scene.materials) {
            material.base_colour = glm::vec4(reflectance, 1);
            material.metallic = 0;
        }
        scene.lights = std::move(lights);
        return scene;
    }

    static Settings quick() {
        return {{"directions", std::int64_t{32}},      {"resolution", std::int64_t{100}},
                {"emission", std::int64_t{16}},        {"clipping", std::string("none")},
                {"overhang", std::string("returned")}, {"reject_hidden", true}};
    }

    FrameReport trace(const Shot& shot, const Settings& settings, double initial_capacity = 1,
                      std::uint64_t memory_budget = 0) {
        ParameterTable<li::Parameters> table;
        table.include(&li::Parameters::maps, passes::ldm::map_parameters());
        table.include(&li::Parameters::transport,
                      transport_parameters({.paths = {"direct", "indirect", "full"},
                                            .keys = {"max_bounces", "materials", "normal_maps"}}));
        li::add_tracing_parameters(table);
        table.add(&li::Parameters::direct,
                  {.key = "direct",
                   .label = "Direct light",
                   .doc = "As the method's own.",
                   .choices = {{"rasterisation", "Rasterisation", ""}, {"photons", "Photons", ""}}});
        table.include(&li::Parameters::maps, passes::ldm::self_hit_parameters());
        MethodDescription description;
        description.id = "test";
        description.outputs = li::tracing_outputs();
        const auto method = graph::make_method<li::Parameters>(
            description, table, [&](graph::GraphBuilder& builder, const li::Parameters& parameters) {
                const auto scene = passes::upload_scene(builder);
                const auto gbuffer =
                    passes::gbuffer(builder, scene, {.normal_maps = parameters.transport.normal_maps});
                li::trace_photons(builder, scene, gbuffer, parameters);
            });
        graph::FrameOptions options;
        options.wanted = {"*"};
        options.initial_capacity = initial_capacity;
        options.memory_budget = memory_budget;
        auto inputs = shot.inputs();
        inputs.processor = on;
        inputs.threads = threads;
        const auto report = run_method(method, completed(table.descriptions(), settings), inputs, options);
        count_ = static_cast<std::size_t>(report.counters.at("indirect.count"));
        return report;
    }
    std::vector<li::Primary> primaries() { return elements<li::Primary>("indirect.primary_photons"); }
    std::vector<li::Shares> shares() { return elements<li::Shares>("indirect.shares"); }
    std::vector<li::EnergyRow> energy() { return elements<li::EnergyRow>("indirect.energy"); }
    std::vector<passes::ldm::MapFrame> frames() { return elements<passes::ldm::MapFrame>("ldm.frames"); }
    std::vector<li::Photon> photons() {
        auto all = elements<li::Photon>("indirect.photons");
        EXPECT_GE(all.size(), count_);
        all.resize(std::min(all.size(), count_));
        return all;
    }
    Processor on = Processor::gl;
    int threads = 0;
    /// Of travel behind the first surface.
    static glm::dvec3 direction_of(const li::Photon& photon,
                                   const std::vector<passes::ldm::MapFrame>& frames) {
        const glm::dvec3 v(frames.at(photon.leg & 0xffff).direction);
        return photon.leg >> 16 & 1 ? v : -v;
    }
    static glm::dvec3 normal_of(const li::Photon& photon) {
        const auto part = [&](int shift) {
            return std::max(-1.0, static_cast<std::int16_t>(photon.normal >> shift & 0xffff) / 32767.0);
        };
        glm::dvec3 n(part(0), part(16), 0);
        n.z = 1 - std::abs(n.x) - std::abs(n.y);
        if (n.z < 0) {
            const double x = n.x;
            n.x = (1 - std::abs(n.y)) * (x >= 0 ? 1 : -1);
            n.y = (1 - std::abs(x)) * (n.y >= 0 ? 1 : -1);
        }
        return glm::normalize(n);
    }
    /// What of its footprint is said to lie beyond its surface.
    static double part_beyond(const li::Photon& photon) {
        return (photon.leg >> li::leg_beyond_shift & li::leg_beyond) / 64.0;
    }
    /// Its leg without that part.
    static std::uint32_t way(const li::Photon& photon) {
        return photon.leg & ~(li::leg_beyond << li::leg_beyond_shift);
    }
    static glm::dvec3 flux(const li::EnergyRow& row) { return {row.flux[0], row.flux[1], row.flux[2]}; }

    /// Whether what was emitted is found again, in every channel, and photons stored hold what the table
    /// says.
    void expect_balanced(const std::string& name) {
        SCOPED_TRACE(name);
        const auto rows = energy();
        ASSERT_EQ(rows.size(), li::energy_rows);
        glm::dvec3 found(0), direct(0);
        for (std::uint32_t row = 1; row < li::row_direct; ++row)
            found += flux(rows[static_cast<std::size_t>(row)]);
        for (std::uint32_t row = li::row_direct; row < li::energy_rows; ++row)
            direct += flux(rows[static_cast<std::size_t>(row)]);
        const auto emitted = flux(rows[li::row_emitted]);
        glm::dvec3 indirect(0), stored_directly(0);
        for (const auto& photon : photons())
            (photon.leg >> 17 & 1 ? stored_directly : indirect) += glm::dvec3(photon.flux);
        const auto row = [&](int index) { return flux(rows[static_cast<std::size_t>(index)]); };
        const auto stored = row(li::row_indirect + 6) + row(li::row_indirect + 7);
        for (int i = 0; i < 3; ++i) {
            EXPECT_GT(emitted[i], 0);
            EXPECT_NEAR(found[i] / emitted[i], 1, 1e-4);
            EXPECT_NEAR(indirect[i] / emitted[i], stored[i] / emitted[i], 1e-4);
            EXPECT_NEAR(stored_directly[i] / emitted[i], (row(20)[i] + row(21)[i]) / emitted[i], 1e-4);
            if (direct[i] == 0) continue;
            EXPECT_NEAR(direct[i] / (emitted[i] - row(li::row_nothing)[i] - row(li::row_range)[i]), 1, 1e-4);
        }
    }

  private:
    std::size_t count_ = 0;
};

}  // namespace ir::test
