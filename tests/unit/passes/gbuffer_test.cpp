#include <cmath>

#include "renderers/passes/gbuffer/pixel_rays.h"
#include "tests/unit/passes/pass_fixture.h"
#include "tests/unit/passes/small_world.h"

namespace ir::test {
namespace {

using scene::Camera;
using scene::Scene;

constexpr int width = 48, height = 32;

/// Drawn, and found by rays.
class GBufferTest : public PassTest, public testing::WithParamInterface<Processor> {
  protected:
    Processor processor() const override { return GetParam(); }
};

INSTANTIATE_TEST_SUITE_P(On, GBufferTest, testing::Values(Processor::gl, Processor::host),
                         [](const auto& tested) { return to_string(tested.param); });

TEST_P(GBufferTest, PositionIsWhereThePixelsRayMeetsThePlane) {
    const Shot shot("builtin:plane", "above", width, height);
    run_gbuffer(shot);
    const auto position = read("gbuffer.position"), valid = read("valid"), depth = read("gbuffer.depth");
    const auto normal = read("gbuffer.normal"), geometric = read("gbuffer.geometric_normal");
    int hits = 0, misses = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const auto ray = scene::pixel_ray(shot.view, {x + 0.5f, y + 0.5f});
            const float t = -ray.origin_ws.y / ray.direction_ws.y;
            const auto expected = ray.origin_ws + t * ray.direction_ws;
            const float outside = std::max(std::abs(expected.x), std::abs(expected.z)) - 5;
            if (std::abs(outside) < 1e-3f) continue;
            const bool hit = t > 0 && outside < 0;
            (hit ? hits : misses)++;
            ASSERT_EQ(valid.at(x, y), hit ? 1 : 0) << x << ' ' << y;
            if (!hit) {
                EXPECT_EQ(rgb(position, x, y), glm::vec3(0));
                EXPECT_EQ(position.at(x, y, 3), 0);
                EXPECT_EQ(depth.at(x, y), 1);
                continue;
            }
            EXPECT_LT(glm::distance(rgb(position, x, y), expected), 1e-4f);
            EXPECT_NEAR(rgb(position, x, y).y, 0, 1e-5f);
            EXPECT_NEAR(position.at(x, y, 3), t, 1e-4f);
            EXPECT_LT(glm::distance(rgb(normal, x, y), {0, 1, 0}), 1e-3f);
            EXPECT_LT(glm::distance(rgb(geometric, x, y), {0, 1, 0}), 1e-6f);
            const auto distance = -(shot.previous_view.view_from_world * glm::vec4(expected, 1)).z;
            EXPECT_NEAR(geometric.at(x, y, 3), distance, 1e-4f);
            const auto clip = shot.view.clip_from_world() * glm::vec4(expected, 1);
            EXPECT_NEAR(depth.at(x, y), clip.z / clip.w, 2e-5f);
        }
    EXPECT_GT(hits, 100);
    EXPECT_GT(misses, 100);
}

TEST_P(GBufferTest, RaysOfTheShadersAreThoseOfTheScene) {
    auto camera = looking({3, 2, 5}, {-1, 0.5f, 0}, {0.2f, 1, 0});
    const scene::Bounds bounds{{-5, -5, -5}, {5, 5, 5}};
    for (const bool orthographic : {false, true}) {
        camera.orthographic = orthographic;
        const auto view = scene::make_view(camera, 37, 21, bounds);
        const auto rays = passes::pixel_rays(view);
        for (const glm::vec2 p : {glm::vec2(0), glm::vec2(37, 0), glm::vec2(0, 21), glm::vec2(11.5f, 7.5f)}) {
            const auto expected = scene::pixel_ray(view, p);
            const auto origin = rays.origin + p.x * rays.origin_dx + p.y * rays.origin_dy;
            const auto direction = rays.direction + p.x * rays.direction_dx + p.y * rays.direction_dy;
            EXPECT_LT(glm::distance(origin, expected.origin_ws), 1e-5f);
            EXPECT_LT(glm::distance(glm::normalize(direction), expected.direction_ws), 1e-6f);
            EXPECT_NEAR((view.view_from_world * glm::vec4(direction, 0)).z, -1, 1e-6f);
        }
    }
}

TEST_P(GBufferTest, PositionsAreExactInAnOrthographicView) {
    auto camera = looking({0, 4, 0}, {0, 0, 0}, {0, 0, -1});
    camera.orthographic = true;
    camera.height = 8;
    const Shot shot(scene::load_scene("builtin:plane"), camera, width, height);
    run_gbuffer(shot);
    const auto position = read("gbuffer.position");
    for (int y = 0; y < height; ++y)
        for (int x = 8; x < width - 8; ++x) {
            const auto ray = scene::pixel_ray(shot.view, {x + 0.5f, y + 0.5f});
            EXPECT_LT(glm::distance(rgb(position, x, y), {ray.origin_ws.x, 0, ray.origin_ws.z}), 1e-5f);
        }
}

TEST_P(GBufferTest, RowZeroIsTheTopRow) {
    SmallWorld small;
    small.square({0, 2, 0}, {0, 0, 1}, 0.5f);  // above the eye's level
    const Shot shot(small.scene(), looking({0, 0, 6}, {0, 0, 0}), 33, 33);
    run_gbuffer(shot);
    const auto valid = read("valid");
    double sum = 0, rows = 0;
    for (int y = 0; y < 33; ++y)
        for (int x = 0; x < 33; ++x) {
            sum += valid.at(x, y);
            rows += y * valid.at(x, y);
        }
    ASSERT_GT(sum, 4);
    EXPECT_LT(rows / sum, 10);
}

TEST_P(GBufferTest, NormalsTurnToTheViewerOnBackFacesToo) {
    const Shot shot("builtin:cornell", "", width, height);
    run_gbuffer(shot);
    const auto position = read("gbuffer.position"), valid = read("valid");
    const auto normal = read("gbuffer.normal"), geometric = read("gbuffer.geometric_normal");
    int checked = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            if (valid.at(x, y) == 0) continue;
            const auto v = glm::normalize(shot.view.eye_ws - rgb(position, x, y));
            EXPECT_NEAR(glm::length(rgb(normal, x, y)), 1, 2e-3f);
            EXPECT_NEAR(glm::length(rgb(geometric, x, y)), 1, 1e-5f);
            EXPECT_GE(glm::dot(rgb(geometric, x, y), v), 0);
            EXPECT_GT(glm::dot(rgb(normal, x, y), rgb(geometric, x, y)), 0);
            ++checked;
        }
    EXPECT_GT(checked, 200);

    for (const float side : {1.0f, -1.0f}) {
        SmallWorld small;
        small.square({0, 0, 0}, {0, 0, 1}, 1);
        const Shot back(small.scene(), looking({0.3f, 0.2f, 4 * side}, {0, 0, 0}), 9, 9);
        run_gbuffer(back);
        EXPECT_LT(glm::distance(rgb(read("gbuffer.normal"), 4, 4), {0, 0, side}), 1e-3f);
        EXPECT_LT(glm::distance(rgb(read("gbuffer.geometric_normal"), 4, 4), {0, 0, side}), 1e-6f);
    }
}

TEST_P(GBufferTest, TheGeometricNormalOfASliverIsThatOfItsPlane) {
    SmallWorld small;
    scene::Mesh mesh;  // 2 m long, 1/1000 m wide, in a tilted plane far from the origin
    const glm::vec3 origin(100, 50, -30), along = glm::normalize(glm::vec3(1, 2, 3));
    const auto across = glm::normalize(glm::cross(along, glm::vec3(0, 1, 0)));
    const auto expected = glm::normalize(glm::cross(along, across));
    mesh.positions = {origin - along, origin + along, origin + 0.02f * across};
    mesh.normals.assign(3, expected);
    mesh.uv0.assign(3, {0, 0});
    mesh.indices = {0, 1, 2};
    small.add(std::move(mesh));
    const auto middle = origin + 0.005f * across;
    const Shot shot(small.scene(), looking(middle + expected, middle), 65, 65);
    run_gbuffer(shot);
    const auto geometric = rgb(read("gbuffer.geometric_normal"), 32, 32);
    EXPECT_GT(glm::dot(geometric, expected), 1 - 1e-6f);
}

TEST_P(GBufferTest, AlphaMasksCutHolesAtTheTexelsOfTheBitmap) {
    SmallWorld small;
    small.quad({-1, 1, 0}, {1, 1, 0}, {1, -1, 0}, {-1, -1, 0}, SmallWorld::masked);
    auto camera = looking({0, 0, 3}, {0, 0, 0});
    camera.orthographic = true;
    camera.height = 2;
    const Shot shot(small.scene(), camera, 16, 16);
    run_gbuffer(shot);
    const auto valid = read("valid");
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) EXPECT_EQ(valid.at(x, y), x < 8 && y < 8 ? 0 : 1) << x << ' ' << y;
}

TEST_P(GBufferTest, CoverageAgreesWithTheSceneForEveryWrapAndTransform) {
    using scene::Wrap;
    for (const auto wrap : {Wrap::repeat, Wrap::mirrored_repeat, Wrap::clamp_to_edge}) {
        SmallWorld small;
        small.quad({-1, 1, 0}, {1, 1, 0}, {1, -1, 0}, {-1, -1, 0}, SmallWorld::masked);
        auto scene = small.scene();
        auto& texture = scene.textures[0];
        texture.width = 37;  // two words a row
        texture.height = 5;
        texture.rgba.resize(37 * 5 * 4);
        for (std::size_t i = 0; i < 37 * 5; ++i) texture.rgba[4 * i + 3] = i * 7919 % 5 < 2 ? 255 : 0;
        texture.sampler.wrap_s = texture.sampler.wrap_t = wrap;
        auto& slot = scene.materials[SmallWorld::masked].base_colour_texture;
        slot.offset = {-1.3f, 0.37f};
        slot.scale = {2.7f, -3.1f};
        slot.rotation = 0.4f;
        auto camera = looking({0, 0, 3}, {0, 0, 0});
        camera.orthographic = true;
        camera.height = 2;
        const Shot shot(scene, camera, 64, 64);
        run_gbuffer(shot);
        const auto valid = read("valid");
        int covered = 0;
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 64; ++x) {
                const glm::vec2 uv((x + 0.5f) / 64, (y + 0.5f) / 64);
                const bool expected = scene::is_covered(shot.world, shot.world.opacity.at(0), texture.sampler,
                                                        scene::transformed_uv(slot, uv));
                EXPECT_EQ(valid.at(x, y), expected ? 1 : 0) << x << ' ' << y;
                covered += expected;
            }
        EXPECT_GT(covered, 400);
        EXPECT_LT(covered, 3700);
    }
}

/// A square in z = 0 with a normal map that leans everything towards +u by 45 degrees.
Scene leaning_square() {
    SmallWorld small;
    small.quad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0});
    auto scene = small.scene();
    scene.meshes[0].tangents.assign(4, {1, 0, 0, 1});
    scene::Texture texture;
    texture.width = texture.height = 1;
    texture.rgba = {218, 128, 218, 255};  // (0.71, 0, 0.71)
    scene.textures.push_back(texture);
    scene.materials[0].normal_texture.texture = 1;
    return scene;
}

TEST_P(GBufferTest, NormalMapsLeanTheShadingNormalOnly) {
    const Shot shot(leaning_square(), looking({0, 0, 4}, {0, 0, 0}), 9, 9);
    run_gbuffer(shot);
    const float half = std::sqrt(0.5f);
    EXPECT_LT(glm::distance(rgb(read("gbuffer.normal"), 4, 4), {half, 0, half}), 0.01f);
    EXPECT_LT(glm::distance(rgb(read("gbuffer.geometric_normal"), 4, 4), {0, 0, 1}), 1e-6f);
    run_gbuffer(shot, {.normal_maps = false});
    EXPECT_LT(glm::distance(rgb(read("gbuffer.normal"), 4, 4), {0, 0, 1}), 1e-3f);
}

TEST_P(GBufferTest, ReliefOfABackFaceIsTheFrontsFromBehind) {
    const Shot shot(leaning_square(), looking({0, 0, -4}, {0, 0, 0}), 9, 9);
    run_gbuffer(shot);
    const float half = std::sqrt(0.5f);
    EXPECT_LT(glm::distance(rgb(read("gbuffer.normal"), 4, 4), {-half, 0, -half}), 0.01f);
}

TEST_P(GBufferTest, MirroredInstancesMirrorTheirRelief) {
    auto scene = leaning_square();
    scene.nodes[0].scale = {-1, 1, 1};
    const Shot shot(scene, looking({0, 0, 4}, {0, 0, 0}), 9, 9);
    run_gbuffer(shot);
    const float half = std::sqrt(0.5f);
    EXPECT_LT(glm::distance(rgb(read("gbuffer.normal"), 4, 4), {-half, 0, half}), 0.01f);
    EXPECT_LT(glm::distance(rgb(read("gbuffer.geometric_normal"), 4, 4), {0, 0, 1}), 1e-6f);
}

TEST_P(GBufferTest, VelocityIsTheDifferenceOfProjections) {
    SmallWorld small;
    small.square({0, 0, 0}, {0, 0, 1}, 2);
    auto scene = small.scene();
    scene::AnimationChannel slide;
    slide.times = {0, 1};
    slide.values = {glm::vec4(0), glm::vec4(0.2f, 0.1f, 0.3f, 0)};
    scene.animation.push_back(slide);
    Shot shot(scene, looking({0, 0, 5}, {0, 0, 0}), width, height, 1, 0);
    shot.previous_view =
        scene::make_view(looking({0.1f, 0, 5}, {0, 0.05f, 0}), width, height, shot.world.bounds);
    run_gbuffer(shot);
    const auto velocity = read("gbuffer.velocity"), position = read("gbuffer.position");
    for (const auto& [x, y] : {std::pair{24, 16}, std::pair{20, 10}, std::pair{30, 20}}) {
        const auto before_ws = rgb(position, x, y) - glm::vec3(0.2f, 0.1f, 0.3f);
        const auto clip = shot.previous_view.clip_from_world() * glm::vec4(before_ws, 1);
        const glm::vec2 before_px((clip.x / clip.w * 0.5f + 0.5f) * width,
                                  (0.5f - clip.y / clip.w * 0.5f) * height);
        const auto expected = glm::vec2(x + 0.5f, y + 0.5f) - before_px;
        EXPECT_GT(glm::length(expected), 0.5f);
        EXPECT_NEAR(velocity.at(x, y, 0), expected.x, 1e-2f);
        EXPECT_NEAR(velocity.at(x, y, 1), expected.y, 1e-2f);
        const auto before_vs = shot.previous_view.view_from_world * glm::vec4(before_ws, 1);
        EXPECT_NEAR(read("gbuffer.geometric_normal").at(x, y, 3), -before_vs.z, 1e-4f);
    }
}

TEST_P(GBufferTest, MaterialsReachTheBuffers) {
    SmallWorld small;
    small.square({0, 0, 0}, {0, 0, 1}, 1);
    auto scene = small.scene();
    auto& material = scene.materials[0];
    material.base_colour = {0.5f, 0.25f, 0.125f, 1};
    material.metallic = 0.25f;
    material.roughness = 0.75f;
    material.emission = {3, 2, 1};
    material.transmission = 1;
    scene.meshes[0].colours.assign(4, {0.2f, 0.4f, 1, 1});
    const Shot shot(scene, looking({0, 0, 4}, {0, 0, 0}), 9, 9);
    run_gbuffer(shot, {.sees_through_glass = false});
    EXPECT_LT(glm::distance(rgb(read("gbuffer.albedo"), 4, 4), {0.1f, 0.1f, 0.125f}), 1e-3f);
    EXPECT_EQ(read("gbuffer.albedo").at(4, 4, 3), 1);
    EXPECT_EQ(rgb(read("gbuffer.material"), 4, 4), glm::vec3(0.25f, 0.75f, 0));
    EXPECT_EQ(rgb(read("gbuffer.emission"), 4, 4), glm::vec3(3, 2, 1));
    EXPECT_EQ(read("valid").at(4, 4), 0) << "glass does not count";
    EXPECT_GT(read("gbuffer.position").at(4, 4, 3), 0) << "but it is seen";
}

TEST_P(GBufferTest, SrgbTexturesAreDecodedAndOthersNot) {
    for (const bool srgb : {true, false}) {
        SmallWorld small;
        small.square({0, 0, 0}, {0, 0, 1}, 1);
        auto scene = small.scene();
        scene::Texture texture;
        texture.width = texture.height = 1;
        texture.rgba = {128, 128, 128, 255};
        texture.srgb = srgb;
        scene.textures.push_back(texture);
        scene.materials[0].base_colour_texture.texture = 1;
        const Shot shot(scene, looking({0, 0, 4}, {0, 0, 0}), 9, 9);
        run_gbuffer(shot);
        EXPECT_NEAR(read("gbuffer.albedo").at(4, 4), srgb ? 0.21586f : 0.50196f, 2e-3f);
    }
}

TEST_P(GBufferTest, EachSlotHasItsOwnCoordinatesAndTransform) {
    SmallWorld small;
    small.square({0, 0, 0}, {0, 0, 1}, 1);
    auto scene = small.scene();
    scene.meshes[0].uv0.assign(4, {0.25f, 0.25f});  // the first texel
    scene.meshes[0].uv1.assign(4, {0.75f, 0.25f});  // the one to its right
    scene::Texture texture;
    texture.width = texture.height = 2;
    texture.rgba = {0, 51, 102, 255, 255, 255, 255, 255, 153, 204, 51, 255, 102, 0, 204, 255};
    texture.sampler.mag = texture.sampler.min = scene::Filter::nearest;
    scene.textures.push_back(texture);
    auto& material = scene.materials[0];
    material.emission = {1, 1, 1};
    material.base_colour_texture.texture = material.metallic_roughness_texture.texture = 1;
    material.emission_texture.texture = 1;
    material.base_colour_texture.uv_set = 1;
    material.metallic_roughness_texture.offset = {0, 0.5f};  // to the texel below the first
    material.emission_texture.rotation = -3.14159265f / 2;   // (u, v) to (-v, u)
    const Shot shot(scene, looking({0, 0, 4}, {0, 0, 0}), 9, 9);
    run_gbuffer(shot);
    EXPECT_EQ(rgb(read("gbuffer.albedo"), 4, 4), glm::vec3(1));
    EXPECT_LT(glm::distance(rgb(read("gbuffer.material"), 4, 4), {0.2f, 0.8f, 0}), 1e-3f)
        << "metallic is blue, roughness green";
    EXPECT_EQ(rgb(read("gbuffer.emission"), 4, 4), glm::vec3(1)) << "-0.25 repeats to the right column";
}

/// The border pixels of a triangle take differences from neighbours beside it.
TEST_P(GBufferTest, MipLevelsAreTheSameAtBordersOfTriangles) {
    SmallWorld small;
    small.square({0, 0, 0}, {0, 0, 1}, 1);
    auto scene = small.scene();
    scene::Texture texture;  // a white square in a black one: coarse levels are grey
    texture.width = texture.height = 64;
    texture.rgba.assign(64 * 64 * 4, 0);
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x)
            if (x >= 16 && y >= 16 && x < 48 && y < 48)
                std::fill_n(texture.rgba.begin() + 4 * (y * 64 + x), 4, std::uint8_t{255});
    scene.textures.push_back(texture);
    scene.materials[0].base_colour_texture.texture = 1;
    auto camera = looking({0, 0, 3}, {0, 0, 0});
    camera.orthographic = true;
    camera.height = 2;
    const Shot shot(scene, camera, 64, 64);
    run_gbuffer(shot);
    const auto albedo = read("gbuffer.albedo");
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
            const int inside = std::min(std::min(x, 63 - x), std::min(y, 63 - y)) - 16;
            if (inside > -3 && inside < 2) continue;
            EXPECT_EQ(albedo.at(x, y), inside > 0 ? 1 : 0) << x << ' ' << y;
        }
}

/// Edges lie where the pixel's centre is on one side or the other, but for rounding.
TEST_F(PassTest, TheHostsGBufferIsTheDrawnOne) {
    for (const auto* name : {"builtin:atrium", "builtin:still-life", "builtin:cornell"}) {
        const Shot shot(name, "", 96, 64);
        std::map<std::string, Image> drawn;
        const std::vector<std::string> keys{"gbuffer.position", "gbuffer.geometric_normal",
                                            "gbuffer.normal",   "gbuffer.albedo",
                                            "gbuffer.material", "gbuffer.depth",
                                            "gbuffer.velocity", "valid"};
        for (const auto body : {Processor::gl, Processor::host}) {
            auto inputs = shot.inputs();
            inputs.processor = body;
            const auto report = run(inputs, [](graph::GraphBuilder& builder) {
                passes::gbuffer(builder, passes::upload_scene(builder), {.sees_through_glass = false});
            });
            for (const auto& pass : report.passes) {
                if (pass.name != "G-buffer") continue;
                EXPECT_EQ(pass.queue, body == Processor::host ? "cpu" : "gl");
                EXPECT_TRUE(pass.has_two_bodies);
            }
            for (const auto& key : keys) {
                if (body == Processor::gl) {
                    drawn[key] = read(key);
                    continue;
                }
                const auto found = read(key);
                const auto& expected = drawn.at(key);
                std::size_t apart = 0;
                for (std::size_t i = 0; i < found.pixels.size(); ++i)
                    apart += std::abs(found.pixels[i] - expected.pixels[i]) > 0.03f;
                EXPECT_LT(double(apart), 0.005 * double(found.pixels.size())) << name << ' ' << key;
            }
        }
    }
}

TEST_F(PassTest, TheHostDoesNotFillWhatNobodyAsksOfAGBuffer) {
    const Shot shot("builtin:still-life", "", 32, 24);
    auto inputs = shot.inputs();
    inputs.processor = Processor::host;
    graph::Method method;
    method.description.id = "test";
    method.setup = [](graph::GraphBuilder& builder, const Settings&) {
        passes::gbuffer(builder, passes::upload_scene(builder), {.sees_through_glass = false});
    };
    const auto is_culled = [&](const char* other) {
        graph::FrameOptions options;
        options.wanted = {"gbuffer.normal", other};
        for (const auto& pass : run_method(method, {}, inputs, options).passes)
            if (pass.name == "G-buffer, materials") return pass.culled;
        throw std::logic_error("there is no such pass");
    };
    EXPECT_TRUE(is_culled("valid"));
    const auto alone = read("gbuffer.normal");
    EXPECT_FALSE(is_culled("gbuffer.albedo"));
    EXPECT_EQ(read("gbuffer.normal").pixels, alone.pixels);
}

}  // namespace
}  // namespace ir::test
