// Sample points of light that no map shows: of rectangles, disks, emissive meshes, the environment, and of
// lights beyond the maps.
#include <glm/gtc/packing.hpp>
#include <map>
#include <random>
#include <set>

#include "renderers/core/constants.h"
#include "renderers/passes/lights/flat_light.h"
#include "renderers/passes/lights/light_sampler.h"
#include "renderers/passes/raytracing/bvh.h"
#include "tests/unit/methods/photon_mapping_emission_fixture.h"

namespace ir::test {
namespace {

glm::vec3 unpacked_octahedral(std::uint32_t bits) {
    const auto p = glm::unpackSnorm2x16(bits);
    glm::vec3 v(p, 1 - std::abs(p.x) - std::abs(p.y));
    if (v.z < 0) {
        const glm::vec2 folded = 1.0f - glm::abs(glm::vec2(p.y, p.x));
        v.x = p.x >= 0 ? folded.x : -folded.x;
        v.y = p.y >= 0 ? folded.y : -folded.y;
    }
    return glm::normalize(v);
}

/// Floor, wall and a shelf, of different colours.
class ExtendedEmissionTest : public EmissionTest {
  protected:
    static scene::Scene bare_room() {
        SmallWorld small;
        small.square({0, 0, 0}, {0, 1, 0}, 2);
        small.square({-2, 1, 0}, {1, 0, 0}, 1.5f);
        small.square({0.6f, 1, 0}, {0, 1, 0}, 0.3f);
        auto scene = small.scene();
        scene.materials[0].base_colour = {0.8f, 0.5f, 0.2f, 1};
        scene.materials[0].metallic = 0, scene.materials[0].roughness = 0.6f;
        return scene;
    }
    static scene::Light panel(scene::LightType type) {
        scene::Light light;
        light.type = type;
        light.position = {0.2f, 2, 0.1f};
        light.direction = glm::normalize(glm::vec3(-0.2f, -1, 0.1f));
        light.size = {0.6f, 0.4f};
        light.colour = {1, 0.5f, 0.25f};
        light.intensity = 4;
        return light;
    }
    static void add_glowing_square(scene::Scene& scene) {
        SmallWorld glowing;
        glowing.square({0.3f, 1.8f, 0.2f}, glm::normalize(glm::vec3(0.2f, 1, 0)), 0.25f);
        auto mesh = glowing.scene().meshes[0];
        mesh.material = static_cast<int>(scene.materials.size());
        scene.materials.emplace_back().emission = {5, 3, 1};
        scene::Node node;
        node.meshes = {static_cast<int>(scene.meshes.size())};
        scene.meshes.push_back(mesh);
        scene.nodes.push_back(node);
    }
    static scene::Scene lit(std::vector<scene::Light> lights, bool glowing = false, glm::vec3 sky = {}) {
        auto scene = bare_room();
        scene.lights = std::move(lights);
        if (glowing) add_glowing_square(scene);
        scene.environment.constant = sky;
        return scene;
    }
    static Shot shot_of(const scene::Scene& scene) { return {scene, scene.cameras.at(0), 8, 8}; }

    /// W that all sides of all surfaces get directly, by samples of the lights; the error's squares beside.
    static Flux received(const Shot& shot, int n) {
        const passes::SurfaceLookup surfaces(shot.scene, shot.world, false);
        const passes::LightSampler lights(surfaces);
        const passes::Bvh bvh(shot.scene, shot.world);
        std::mt19937 random(3);
        std::uniform_real_distribution<float> unit(0, 0.9999999f);
        glm::dvec3 mean(0), squares(0);
        const auto triangles = static_cast<std::uint32_t>(shot.world.triangles());
        for (int i = 0; i < n; ++i) {
            const auto triangle = static_cast<std::uint32_t>(i) % triangles;
            glm::vec3 p[3];
            for (std::size_t c = 0; c < 3; ++c)
                p[c] = shot.world.positions[shot.world.indices[3 * triangle + c]];
            float u = unit(random), v = unit(random);
            if (u + v > 1) u = 1 - u, v = 1 - v;
            auto normal = glm::cross(p[1] - p[0], p[2] - p[0]);
            const double area = 0.5 * glm::length(normal);
            normal = glm::normalize(normal) * (i / static_cast<int>(triangles) % 2 == 0 ? 1.0f : -1.0f);
            const auto at = p[0] + u * (p[1] - p[0]) + v * (p[2] - p[0]) + 1e-5f * normal;
            const float choice = unit(random), x = unit(random);
            const auto s = lights.sample(at, normal, choice, {x, unit(random)});
            if (!s || bvh.occluded(at, s->direction_ws, 0, s->distance * 0.9999f)) continue;
            const double cosine = std::max(glm::dot(normal, s->direction_ws), 0.0f);
            const auto value =
                glm::dvec3(s->radiance) * (cosine / s->pdf * area * 2.0 * static_cast<double>(triangles));
            mean += value;
            squares += value * value;
        }
        mean /= n;
        return {mean, (squares / double(n) - mean * mean) / double(n)};
    }
    void expect_flux(const scene::Scene& scene, pm::Parameters parameters, const std::string& name) {
        const auto shot = shot_of(scene);
        emit(shot, parameters);
        const auto expected = received(shot, 200'000);
        const auto found = stored();
        for (int i = 0; i < 3; ++i) {
            const double error = std::sqrt(expected.squares[i] + found.squares[i]);
            ASSERT_GT(expected.sum[i], 0) << name;
            // the maps of point lights are as exact as in TracedFirstHitsAgreeWithTheMaps
            EXPECT_NEAR(found.sum[i], expected.sum[i], two_sided * error + 0.004 * expected.sum[i])
                << name << " channel " << i;
            EXPECT_LT(error, 0.03 * expected.sum[i]) << name;
        }
    }
};

/// n = 40,000 points, alpha = 1e-4 two-sided and per case.
TEST_F(ExtendedEmissionTest, SampleAllThatSurfacesGet) {
    const auto rectangle = panel(scene::LightType::rectangle), disk = panel(scene::LightType::disk);
    const std::pair<const char*, scene::Scene> cases[] = {
        {"rectangle", lit({rectangle})},
        {"disk", lit({disk})},
        {"emissive mesh", lit({}, true)},
        {"sky", lit({}, false, {1, 0.8f, 0.6f})},
        {"all with extent", lit({rectangle, disk}, true, {0.2f, 0.2f, 0.3f})},
        {"with a lamp and a spot", lit({lamp(), rectangle, spot(10, 50)}, true)}};
    for (const auto& [name, scene] : cases) {
        auto parameters = quick();
        parameters.rsm_resolution = pm::Resolution::r256;
        expect_flux(scene, parameters, name);
        parameters.first_hit = pm::FirstHit::traced;
        expect_flux(scene, parameters, std::string(name) + ", all traced");
    }
}

TEST_F(ExtendedEmissionTest, LightsBeyondTheMapsAreTraced) {
    std::vector<scene::Light> lights;
    for (int i = 0; i < 13; ++i)
        lights.push_back(
            lamp({-1.2f + 0.2f * static_cast<float>(i), 1.4f, 0.1f * static_cast<float>(i % 3)}));
    const auto scene = lit(lights);
    auto parameters = quick();
    expect_flux(scene, parameters, "13 lamps");
    const auto all = sources();
    ASSERT_EQ(all.size(), 63u) << "ten lamps have six maps each";
    std::uint32_t points = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
        EXPECT_EQ(all[i].is_traced, i >= 60) << i;
        EXPECT_EQ(all[i].first_point, points);
        points += all[i].points;
        if (i >= 60) {
            EXPECT_NEAR(all[i].points, 40'000 / 13.0, 2) << "divided by power";
        }
    }
    EXPECT_EQ(points, 40'000u);
    std::set<std::uint32_t> names;
    for (const auto& sample : samples()) names.insert(sample.light & 63);
    EXPECT_EQ(names.size(), 13u);
}

TEST_F(ExtendedEmissionTest, PointsKnowTheirLightAndWhereItIs) {
    const auto rectangle = panel(scene::LightType::rectangle);
    const auto scene = lit({lamp(), rectangle}, true, {0.5f, 0.5f, 0.5f});
    emit(shot_of(scene), quick());
    const passes::FlatLight shape(rectangle);
    std::map<std::uint32_t, int> found;
    int outside = 0;  // directions are exact to 1e-4, so that some pass the panel's edge
    for (const auto& sample : samples()) {
        const auto name = sample.light & 63;
        ++found[name];
        EXPECT_EQ(sample.origin == 0xffffffffu, name != 0) << "only the lamp has maps";
        const auto towards = unpacked_octahedral(sample.arrived_from);
        const auto from = sample.position_ws + 1e-4f * unpacked_octahedral(sample.geometric_normal);
        if (name == 0) {
            ASSERT_GT(glm::dot(towards, glm::normalize(scene.lights[0].position - sample.position_ws)),
                      0.99999f);
        } else if (name == 1) {
            outside += !shape.intersect(from, towards, infinity);
        }
    }
    EXPECT_EQ(found.size(), 4u);
    EXPECT_LT(outside, 0.01 * found[1]);
    for (const std::uint32_t name : {0u, 1u, pm::light_mesh, pm::light_sky})
        EXPECT_GT(found[name], 100) << name;
}

TEST_F(ExtendedEmissionTest, PointsFillTheirTexels) {
    emit(room({spot(10, 50)}), quick());
    std::set<std::tuple<float, float, float>> places;
    for (const auto& sample : samples())
        places.insert({sample.position_ws.x, sample.position_ws.y, sample.position_ws.z});
    EXPECT_GT(static_cast<double>(places.size()), 0.9 * static_cast<double>(count()));
}

/// A metal has nothing to transmit by, as the G-buffer knows; and photons leave along the ray to what is
/// glass in part.
TEST_F(ExtendedEmissionTest, GlassIsWhatTheGBufferTakesForIt) {
    for (const auto first_hit : {pm::FirstHit::rsm, pm::FirstHit::traced}) {
        auto parameters = quick();
        parameters.first_hit = first_hit;
        auto scene = lit({spot(10, 50)});
        scene.materials[0].metallic = 1;
        emit(shot_of(scene), parameters);
        const auto opaque = stored().sum.r;
        ASSERT_GT(opaque, 0);
        scene.materials[0].transmission = 1;
        emit(shot_of(scene), parameters);
        EXPECT_NEAR(stored().sum.r / opaque, 1, 1e-3);
        scene.materials[0].metallic = 0;
        scene.materials[0].transmission = 0.4f;
        emit(shot_of(scene), parameters);
        EXPECT_NEAR(stored().sum.r / opaque, 1, 0.01) << "the power before the surface";
        for (const auto& sample : samples()) {
            ASSERT_TRUE(sample.light & pm::leaves_along_ray);
            ASSERT_GT(sample.position_ws.y, 2.4f) << "before the surface";
        }
    }
}

TEST_F(ExtendedEmissionTest, TheSkyIsLeftOutWhereTheTransportHasNone) {
    auto parameters = quick();
    parameters.transport.environment_light = false;
    emit(shot_of(lit({}, false, {1, 1, 1})), parameters);
    EXPECT_EQ(emitted().paths, 0u);
}

}  // namespace
}  // namespace ir::test
