// Panes and slabs of glass before a wall: what the G-buffer shows of what lies behind, and how much of its
// light is left.
#include <cmath>

#include "renderers/passes/gbuffer/glass.h"
#include "renderers/passes/scattering/microfacets.h"
#include "tests/unit/passes/pass_fixture.h"
#include "tests/unit/passes/small_world.h"

namespace ir::test {
namespace {

constexpr int side = 9, middle = side / 2, edge = 0;

/// A wall at z = 0 that fills the picture, seen along -z from 4 m before it; panes may stand before its
/// middle.
class GlassTest : public PassTest {
  protected:
    GlassTest() {
        small_.square({0, 0, 0}, {0, 0, 1}, 10);
        scene_ = small_.scene();
        scene_.materials[0].base_colour = {0.5f, 0.25f, 0.125f, 1};
    }
    scene::Material& glass(float transmission = 1) {
        auto& material = scene_.materials.emplace_back();
        material.metallic = material.roughness = 0;
        material.transmission = transmission;
        return material;
    }
    /// A square of 0.6 m of the last material, which looks to +z, or to -z.
    scene::Mesh& pane(float z, bool to_viewer = true) {
        SmallWorld pane;
        pane.square({0, 0, z}, {0, 0, to_viewer ? 1 : -1}, 0.3f);
        auto mesh = pane.scene().meshes.at(0);
        mesh.material = static_cast<int>(scene_.materials.size()) - 1;
        scene::Node node;
        node.meshes = {static_cast<int>(scene_.meshes.size())};
        scene_.nodes.push_back(node);
        return scene_.meshes.emplace_back(std::move(mesh));
    }
    Shot shot(bool orthographic = false) const {
        scene::Camera camera;
        camera.eye = {0, 0, 4};
        camera.target = {0, 0, 0};
        camera.orthographic = orthographic;
        camera.height = 2;
        return {scene_, camera, side, side};
    }
    glm::vec3 transmittance() const { return rgb(read("gbuffer.glass"), middle, middle); }

    scene::Scene scene_;

  private:
    SmallWorld small_;
};

void expect_near(glm::vec3 found, glm::vec3 expected, float tolerance = 1e-5f) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], tolerance) << "channel " << c;
}

TEST_F(GlassTest, IsLeftOutOfTheGBufferAndNotValid) {
    run_gbuffer(shot());
    const auto without = read("gbuffer.position"), colours = read("gbuffer.albedo"),
               velocity = read("gbuffer.velocity");
    glass().base_colour = {1, 1, 1, 1};
    pane(1);
    const auto report = run(shot(), [](graph::GraphBuilder& builder) {
        passes::gbuffer(builder, passes::upload_scene(builder));
    });
    EXPECT_EQ(read("gbuffer.position").pixels, without.pixels);
    EXPECT_EQ(read("gbuffer.albedo").pixels, colours.pixels);
    EXPECT_EQ(read("gbuffer.velocity").pixels, velocity.pixels);
    EXPECT_EQ(read("valid").at(middle, middle), 0);
    EXPECT_EQ(read("valid").at(edge, edge), 1);
    const auto glass = read("gbuffer.glass");
    EXPECT_EQ(glass.at(middle, middle, 3), 1);
    EXPECT_EQ(glass.at(edge, edge, 3), 0);
    EXPECT_EQ(rgb(glass, edge, edge), glm::vec3(1));
    int pixels = 0;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) pixels += glass.at(x, y, 3) > 0;
    EXPECT_GT(pixels, 0);
    EXPECT_EQ(report.counters.at("gbuffer.glass_pixels"), pixels);
}

TEST_F(GlassTest, CostsNothingWhereThereIsNone) {
    glass(0.5f);
    pane(1);
    const auto report = run(shot(), [](graph::GraphBuilder& builder) {
        passes::gbuffer(builder, passes::upload_scene(builder));
    });
    EXPECT_FALSE(graph().read_image("gbuffer.glass"));
    for (const auto& pass : report.passes) EXPECT_NE(pass.name, "glass");
}

TEST_F(GlassTest, IsASurfaceWhereAllMaterialsAreOpaque) {
    Transport transport{.paths = Transport::Paths::direct, .materials = Transport::Materials::lambert};
    EXPECT_FALSE(passes::gbuffer_options(transport).sees_through_glass);
    transport.paths = Transport::Paths::ao;  // materials have no meaning
    EXPECT_TRUE(passes::gbuffer_options(transport).sees_through_glass);
    glass();
    pane(1);
    run_gbuffer(shot(), {.sees_through_glass = false});
    EXPECT_FLOAT_EQ(read("gbuffer.position").at(middle, middle, 2), 1);
    EXPECT_EQ(read("valid").at(middle, middle), 0) << "it is still glass";
    EXPECT_FALSE(graph().read_image("gbuffer.glass"));
}

TEST_F(GlassTest, IsWhatIsMoreThanHalfGlassAndDoesNotShine) {
    struct Case {
        float transmission, metallic;
        bool unlit, shines, is_left_out, is_valid;
    };
    for (const auto& c : {Case{0.4f, 0, false, false, false, true}, Case{0.6f, 0, false, false, true, false},
                          Case{1, 0.6f, false, false, false, true}, Case{1, 0.4f, false, false, true, false},
                          Case{1, 0, true, false, false, true}, Case{1, 0, false, true, false, false}}) {
        auto& material = glass(c.transmission);
        material.metallic = c.metallic;
        material.unlit = c.unlit;
        material.emission = glm::vec3(c.shines ? 1 : 0);
        pane(1);
        run_gbuffer(shot());
        EXPECT_FLOAT_EQ(read("gbuffer.position").at(middle, middle, 2), c.is_left_out ? 0 : 1);
        EXPECT_EQ(read("valid").at(middle, middle), c.is_valid ? 1 : 0);
        scene_.meshes.pop_back(), scene_.nodes.pop_back(), scene_.materials.pop_back();
    }
}

TEST_F(GlassTest, APaneTintsOnceAndLosesWhatItReflects) {
    const glm::vec3 tint(0.9f, 0.6f, 0.3f);
    glass().base_colour = glm::vec4(tint, 1);
    pane(1);
    for (const bool orthographic : {false, true}) {
        run_gbuffer(shot(orthographic));
        // F = ((n - 1) / (n + 1))² = 0.04 at both sides of the pane, with all reflections in between
        expect_near(transmittance(), tint * (1 - 0.08f / 1.04f));
    }
    pane(2);
    run_gbuffer(shot());
    expect_near(transmittance(), tint * tint * (1 - 0.08f / 1.04f) * (1 - 0.08f / 1.04f));
    EXPECT_EQ(read("gbuffer.glass").at(middle, middle, 3), 2);
}

TEST_F(GlassTest, InPartLetsThatPartThrough) {
    glass(0.75f).metallic = 0.2f;
    pane(1);
    run_gbuffer(shot());
    expect_near(transmittance(), glm::vec3(0.6f * (1 - 0.08f / 1.04f)));
}

TEST_F(GlassTest, LosesMoreWhereSeenAtAnAngle) {
    glass();
    auto& mesh = pane(1);
    const float angle = 1.3f;
    for (auto& n : mesh.normals) n = {std::sin(angle), 0, std::cos(angle)};
    for (auto& p : mesh.positions) p = {p.x * std::cos(angle), p.y, 1 - p.x * std::sin(angle)};
    run_gbuffer(shot());
    const float reflected =
        passes::sheet_reflectance(passes::dielectric_fresnel(std::cos(angle), 1.5f).reflectance);
    EXPECT_GT(reflected, 0.3f);
    expect_near(transmittance(), glm::vec3(1 - reflected));
}

TEST_F(GlassTest, AVolumeAbsorbsAlongTheWayInsideIt) {
    auto& material = glass();
    material.thickness = 1;  // that there is a volume; how thick it is the triangles say
    material.attenuation_colour = {0.5f, 0.8f, 1};
    material.attenuation_distance = 0.25f;
    pane(2);
    pane(1.5f, false);
    run_gbuffer(shot());
    const auto absorbed = glm::pow(material.attenuation_colour, glm::vec3(0.5f / 0.25f));
    expect_near(transmittance(), absorbed * 0.96f * 0.96f);
    EXPECT_EQ(read("gbuffer.glass").at(middle, middle, 3), 2);
}

TEST_F(GlassTest, AVolumeWithSomethingInItEndsThere) {
    auto& material = glass();
    material.thickness = 1;
    material.attenuation_colour = {0.5f, 0.8f, 1};
    material.attenuation_distance = 0.5f;
    pane(1.5f);
    pane(-1, false);  // behind the wall
    run_gbuffer(shot());
    expect_near(transmittance(), glm::pow(material.attenuation_colour, glm::vec3(3)) * 0.96f);
}

TEST_F(GlassTest, BeforeTheBackgroundAbsorbsTheSame) {
    scene_.nodes.clear(), scene_.meshes.clear();
    auto& material = glass();
    material.thickness = 1;
    material.attenuation_colour = {0.5f, 0.8f, 1};
    material.attenuation_distance = 0.5f;
    pane(1.5f);
    pane(1, false);
    run_gbuffer(shot());
    expect_near(transmittance(), material.attenuation_colour * 0.96f * 0.96f);
    EXPECT_EQ(read("gbuffer.position").at(middle, middle, 3), 0);
}

TEST_F(GlassTest, HasHolesWhereItsMaskHas) {
    auto& material = glass();
    material.alpha_mode = scene::AlphaMode::mask;
    material.base_colour_texture.texture = 0;  // its first texel is a hole
    for (auto& uv : pane(1).uv0) uv = {0.25f, 0.25f};
    run_gbuffer(shot());
    EXPECT_EQ(read("gbuffer.glass").at(middle, middle, 3), 0);
    EXPECT_EQ(read("valid").at(middle, middle), 1);
}

}  // namespace
}  // namespace ir::test
