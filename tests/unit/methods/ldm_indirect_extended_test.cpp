// Photons of rectangles, disks, emissive meshes and the environment up to their first surface.
#include <numbers>

#include "tests/unit/methods/ldm_indirect_tracing_fixture.h"

namespace ir::test {
namespace {

using std::numbers::pi;

class PhotonsOfLampsTest : public IndirectTracingTest {
  protected:
    static scene::Light lamp_of(scene::LightType type, glm::vec2 size, float radiance = 2) {
        scene::Light light;
        light.type = type;
        light.position = {0.2f, 2.5f, 0.1f};
        light.direction = {0, -1, 0};
        light.size = size;
        light.colour = {1, 0.5f, 0.25f};
        light.intensity = radiance;
        return light;
    }
    /// The room with a square of 0.6 m that shines 3, 2 and 1 W/(m² sr) to both sides.
    static scene::Scene with_panel() {
        auto scene = box({});
        SmallWorld panel;
        panel.square({0, 1.5f, 0}, {0, -1, 0}, 0.3f);
        auto mesh = panel.scene().meshes.front();
        mesh.material = static_cast<int>(scene.materials.size());
        scene::Material material;
        material.base_colour = glm::vec4(0, 0, 0, 1);
        material.emission = {3, 2, 1};
        scene.materials.push_back(material);
        scene::Node node;
        node.meshes = {static_cast<int>(scene.meshes.size())};
        scene.meshes.push_back(mesh);
        scene.nodes.push_back(node);
        return scene;
    }
    /// Of a square of 1 m to one of 2 m, 2 m apart, by quadrature. No lambda, which the compiler would
    /// evaluate.
    static double form_factor() {
        double sum = 0;
        constexpr int n = 24;
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j)
                for (int k = 0; k < 2 * n; ++k)
                    for (int l = 0; l < 2 * n; ++l) {
                        const double x = (i + 0.5) / n - 0.5 - ((k + 0.5) / n - 1),
                                     z = (j + 0.5) / n - 0.5 - ((l + 0.5) / n - 1);
                        const double squared = x * x + z * z + 4;
                        sum += 4 / (pi * squared * squared);
                    }
        return sum / (double(n) * n * n * n);
    }
    static scene::Camera inside() { return camera({0, 1.4f, 1.9f}, {0, 1.2f, 0}); }
    double emitted() { return flux(energy()[li::row_emitted]).r; }
};

TEST_F(PhotonsOfLampsTest, SourcesEmitTheirFluxAndNoneIsLost) {
    trace(Shot(box({lamp_of(scene::LightType::rectangle, {0.8f, 0.5f})}), inside(), 48, 48), quick());
    expect_balanced("rectangle");
    EXPECT_NEAR(emitted() / (pi * 0.4 * 2), 1, 1e-4);
    EXPECT_EQ(energy()[li::row_nothing].photons, 0u);
    trace(Shot(box({lamp_of(scene::LightType::disk, {0.8f, 0.5f})}), inside(), 48, 48), quick());
    expect_balanced("disk");
    EXPECT_NEAR(emitted() / (pi * pi * 0.1 * 2), 1, 1e-4);
    trace(Shot(with_panel(), inside(), 48, 48), quick());
    expect_balanced("emissive mesh");
    EXPECT_NEAR(emitted() / (2 * pi * 0.36 * 3), 1, 1e-4);
    auto outdoors = planes({});
    outdoors.environment.constant = {1, 2, 3};
    trace(Shot(outdoors, camera({0, 1, 3.9f}, {0, 0, 0}), 48, 48), quick());
    expect_balanced("environment");
    EXPECT_GT(energy()[li::row_nothing].photons, 0u);
    // ρ L π A on the outer side of both planes, and what passes between them.
    double outer = 0;
    for (const auto& photon : primaries())
        if (photon.fate == 1 && (photon.position_ws.y > 1) == (photon.direction_ws.y < 0))
            outer += photon.emitted.r;
    EXPECT_NEAR(outer / (2 * pi * 64), 1, 0.05);
}

// Half of the panel is black, and of the room only the floor is left: of eight rays of a photon some start
// where nothing shines, and often none of the others is of use.
TEST_F(PhotonsOfLampsTest, BlackTexelsEmitNoEnergy) {
    auto scene = with_panel();
    scene.nodes.erase(scene.nodes.begin() + 1, scene.nodes.end() - 1);
    scene.materials.back().emission_texture.texture = static_cast<int>(scene.textures.size());
    auto& texture = scene.textures.emplace_back();
    texture.width = 2, texture.height = 1;
    texture.rgba = {0, 0, 0, 255, 255, 255, 255, 255};
    texture.sampler.mag = texture.sampler.min = scene::Filter::nearest;
    trace(Shot(scene, inside(), 48, 48), quick());
    expect_balanced("half of a panel");
    EXPECT_NEAR(emitted() / (pi * 0.36 * 3), 1, 0.05);
}

// The lamp lies in the plane of the ceiling.
TEST_F(PhotonsOfLampsTest, LightArrivesByTheFormFactor) {
    auto lamp = lamp_of(scene::LightType::rectangle, {1, 1});
    lamp.position = {0, 2, 0};
    auto settings = quick();
    settings["emission"] = std::int64_t{128};
    settings["directions"] = std::int64_t{2};
    trace(Shot(planes({lamp}), camera({0, 1, 3.9f}, {0, 0, 0}), 16, 16), settings);
    double all = 0, below = 0;
    for (const auto& photon : primaries()) {
        const auto at = glm::abs(photon.position_ws);
        const bool arrives = photon.fate == 1 && at.y < 1e-3f;
        all += photon.emitted.r * (1 + photon.missed);
        below += arrives && std::max(at.x, at.z) < 1 ? photon.emitted.r : 0;
    }
    EXPECT_NEAR(below / all / form_factor(), 1, 0.05);  // 3,600 photons
}

// A lamp of 0.5 m above a roof with an opening of 0.4 m: most light is lost on the roof, to the sky.
TEST_F(PhotonsOfLampsTest, LightThroughAnOpeningHasMorePhotonsAndItsFlux) {
    SmallWorld small;
    small.square({0, 0, 0}, {0, 1, 0}, 4);
    for (const float side : {-1.0f, 1.0f}) {
        const float edge = side * 0.2f, end = side * 4;
        small.quad({edge, 2, -4}, {end, 2, -4}, {end, 2, 4}, {edge, 2, 4});
        small.quad({-0.2f, 2, edge}, {0.2f, 2, edge}, {0.2f, 2, end}, {-0.2f, 2, end});
    }
    auto light = lamp_of(scene::LightType::rectangle, {0.5f, 0.5f});
    light.position = {0, 3, 0};
    auto settings = quick();
    settings["emission"] = std::int64_t{64};
    settings["directions"] = std::int64_t{2};
    trace(Shot(with(small.scene(), {light}, glm::vec3(0.5f)), camera({0, 1, 3.9f}, {0, 0, 0}), 16, 16),
          settings);
    expect_balanced("opening");
    double through = 0;
    int photons = 0;
    for (const auto& p : primaries()) {
        if (p.fate != li::primary_splits || p.position_ws.y > 1) continue;
        through += p.emitted.r;
        ++photons;
    }
    double expected = 0;  // form factor of the lamp to the opening, by the midpoint rule
    constexpr int n = 16;
    for (int i = 0; i < n * n * n * n; ++i) {
        const auto at = [&](int step, double size) { return ((i / step % n + 0.5) / n - 0.5) * size; };
        const double x = at(1, 0.5) - at(n, 0.4), z = at(n * n, 0.5) - at(n * n * n, 0.4),
                     d = x * x + z * z + 1;
        expected += 0.16 / (pi * d * d) / (n * n * n * n);
    }
    EXPECT_NEAR(through / emitted() / expected, 1, 0.06);
    EXPECT_GT(photons, 2 * expected * 64 * 64);
}

// Of n photons each has 1/n of the lamp's area and of the directions, π/(n cosθ) sr.
TEST_F(PhotonsOfLampsTest, FootprintsAreAsFarApartAsPhotons) {
    const Shot shot(box({lamp_of(scene::LightType::rectangle, {1, 1})}), inside(), 16, 16);
    for (const std::int64_t emission : {16, 64}) {
        auto settings = quick();
        settings["emission"] = emission;
        settings["directions"] = std::int64_t{2};
        trace(shot, settings);
        const double n = double(emission * emission);
        int tested = 0;
        for (const auto& p : primaries()) {
            if (p.fate != 1 || p.direction_ws.y > -0.1f) continue;
            EXPECT_NEAR(glm::dot(p.axis_u, p.normal_ws), 0, 1e-3f * glm::length(p.axis_u));
            EXPECT_NEAR(glm::dot(p.turn_u, p.direction_ws), 0, 1e-5f);
            const double across = pi * std::abs(glm::dot(glm::cross(p.axis_u, p.axis_v), p.direction_ws));
            const double t = p.path_length, expected = (1 + t * t * pi / -p.direction_ws.y) / n;
            EXPECT_NEAR(across / expected, 1, 1e-3);
            ++tested;
        }
        EXPECT_GT(tested, 0.9 * n);
    }
}

// The panel's back sends half of its light up to the ceiling, half a millimetre away, from where it does not
// come down through the panel.
TEST_F(PhotonsOfLampsTest, LightOfNarrowGapsStaysThere) {
    auto scene = with_panel();
    const auto below_ceiling = [&](float gap) {
        for (auto& p : scene.meshes.back().positions) p.y = 3 - gap;
        trace(Shot(scene, inside(), 48, 48), quick());
        expect_balanced("panel");
        double reflected = 0, all = 0;
        for (const auto& p : primaries())
            if (p.fate == 1 && p.direction_ws.y > 0) {
                reflected += (p.emitted * p.reflectance).g;
                all += p.emitted.g;
            }
        return reflected / all;
    };
    EXPECT_LT(below_ceiling(0.0005f), 0.05);
    EXPECT_NEAR(below_ceiling(1), 0.5, 0.01);  // the box's reflectance
}

TEST_F(PhotonsOfLampsTest, LightsKeepTheirNumbers) {
    auto scene = with_panel();
    scene.lights = {lamp({0.3f, 1.2f, -0.4f}), lamp_of(scene::LightType::disk, {0.8f, 0.5f})};
    trace(Shot(scene, inside(), 16, 16), quick());
    const auto all = primaries();
    ASSERT_EQ(all.size(), 6u * 256 + 256);
    std::array<int, 256> found{};
    for (std::size_t i = 0; i < all.size(); ++i) {
        EXPECT_EQ(all[i].source, i);
        ++found.at(all[i].light);
    }
    EXPECT_EQ(found[0], 6 * 256);
    EXPECT_GT(found[1], 20);
    EXPECT_EQ(found[1] + found[li::light_mesh], 256);
    auto settings = quick();
    settings["paths"] = std::string("direct");
    trace(Shot(scene, inside(), 16, 16), settings);
    EXPECT_EQ(primaries().size(), 6u * 256);
}

}  // namespace
}  // namespace ir::test
