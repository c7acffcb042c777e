#include "renderers/passes/surface/surface.h"

#include <cmath>

#include "renderers/passes/surface/host_texture.h"
#include "tests/unit/passes/pass_fixture.h"
#include "tests/unit/passes/small_world.h"

namespace ir::test {
namespace {

using passes::Surface;
using passes::SurfaceLookup;
using scene::Filter;
using scene::Wrap;

/// Finest level and one filter for all distances, so that rasterisation looks up what SurfaceLookup does.
void leave_out_mipmaps(scene::Scene& scene) {
    for (auto& texture : scene.textures) {
        texture.sampler.mipmaps = false;
        texture.sampler.min = texture.sampler.mag;
    }
}

/// How the rays through the pixels' centres and the G-buffer compare.
struct Comparison {
    int pixels = 0, other_triangle = 0;  ///< another place, plane or material: at edges
    double base_colour = 0, metallic_roughness = 0, emission = 0, transmission = 0;  ///< largest differences
    double normal = 0, position = 0;
    int textured_apart = 0;  ///< pixels whose texels differ by more than a filter's rounding
};

class SurfaceTest : public PassTest {
  protected:
    Comparison compare(const Shot& shot, bool normal_maps = true) {
        run_gbuffer(shot, {.normal_maps = normal_maps});
        const auto position = read("gbuffer.position"), normal = read("gbuffer.normal");
        const auto geometric = read("gbuffer.geometric_normal"), albedo = read("gbuffer.albedo");
        const auto material = read("gbuffer.material"), emission = read("gbuffer.emission");
        const passes::Bvh bvh(shot.scene, shot.world);
        const SurfaceLookup lookup(shot.scene, shot.world, normal_maps);
        Comparison result;
        for (int y = 0; y < shot.view.height; ++y)
            for (int x = 0; x < shot.view.width; ++x) {
                const auto ray = scene::pixel_ray(shot.view, {x + 0.5f, y + 0.5f});
                const auto hit = bvh.closest_hit(ray.origin_ws, ray.direction_ws, 0, 1e9f);
                if (!hit.is_hit() && position.at(x, y, 3) == 0) continue;
                const auto s = hit.is_hit() ? lookup.at(hit, ray.direction_ws) : Surface{};
                const bool same = hit.is_hit() && glm::distance(s.position_ws, rgb(position, x, y)) < 1e-3f &&
                                  glm::distance(s.geometric_normal_ws, rgb(geometric, x, y)) < 1e-4f &&
                                  s.material == static_cast<int>(material.at(x, y, 3));
                ++result.pixels;
                if (!same) {
                    ++result.other_triangle;
                    continue;
                }
                const auto raise = [](double& most, double x) { most = std::max(most, x); };
                raise(result.position, glm::distance(s.position_ws, rgb(position, x, y)));
                const double colour = glm::distance(s.base_colour, rgb(albedo, x, y));
                const double rough =
                    glm::distance(glm::vec2(s.metallic, s.roughness), glm::vec2(rgb(material, x, y)));
                const double light = glm::distance(s.emission, rgb(emission, x, y));
                const double glass = std::abs(s.transmission - albedo.at(x, y, 3));
                const double lean = glm::distance(s.shading_normal_ws, rgb(normal, x, y));
                EXPECT_EQ(s.is_unlit, material.at(x, y, 2) > 0.5f);
                if (std::max({colour, rough, light, glass, lean}) > apart) {
                    ++result.textured_apart;
                    continue;
                }
                raise(result.base_colour, colour);
                raise(result.metallic_roughness, rough);
                raise(result.emission, light);
                raise(result.transmission, glass);
                raise(result.normal, lean);
            }
        return result;
    }

    /// Above what the device's filter (8-bit weights) and half floats may lose.
    static constexpr double apart = 0.02;
};

scene::Texture noise(int width, int height, unsigned seed, bool is_normal_map = false) {
    std::mt19937 random(seed);
    scene::Texture texture;
    texture.width = width, texture.height = height;
    texture.rgba.resize(static_cast<std::size_t>(4 * width * height));
    for (auto& byte : texture.rgba) byte = static_cast<std::uint8_t>(random() % 256);
    if (is_normal_map)
        for (std::size_t i = 2; i < texture.rgba.size(); i += 4) texture.rgba[i] |= 192;  // none collapses
    return texture;
}

/// Two facing quads with every kind of texture, coordinates of both sets, colours and a mirrored instance.
scene::Scene textured(Wrap wrap, Filter filter) {
    SmallWorld small;
    small.quad({-1, -1, 0}, {1, -1, 0.2f}, {1, 1, 0.4f}, {-1, 1, 0.2f});
    small.quad({-1, -1, -1}, {-1, 1, -1}, {1.5f, 1, -1.5f}, {1.5f, -1, -1.5f});
    auto scene = small.scene();
    for (unsigned i = 0; i < 5; ++i) {
        auto texture = noise(5 + static_cast<int>(i), 7, i, i == 2);
        texture.srgb = i == 0 || i == 3;
        texture.sampler.wrap_s = texture.sampler.wrap_t = wrap;
        texture.sampler.mag = filter;
        scene.textures.push_back(texture);
    }
    auto& m = scene.materials[0];
    m.base_colour = {0.9f, 0.8f, 0.7f, 1};
    m.metallic = 0.8f;
    m.roughness = 0.9f;
    m.transmission = 0.4f;
    m.normal_scale = 0.6f;
    m.emission = {0.5f, 0.4f, 0.8f};
    scene::TextureSlot* slots[] = {&m.base_colour_texture, &m.metallic_roughness_texture, &m.normal_texture,
                                   &m.emission_texture, &m.transmission_texture};
    for (int i = 0; i < 5; ++i)
        *slots[i] = {i + 1, i % 2, {0.3f * i - 1, 0.17f * i}, {1.3f - 0.5f * i, 0.7f}, 0.5f * i};
    for (auto& mesh : scene.meshes) {
        mesh.uv1 = {{0.1f, 1.4f}, {-0.7f, 0.2f}, {2, 0.3f}, {1, -1}};
        mesh.colours = {{1, 0.5f, 0.2f, 1}, {0.3f, 1, 1, 1}, {1, 1, 1, 1}, {0.2f, 0.9f, 0.4f, 1}};
        scene::generate_tangents(mesh);
    }
    scene.nodes[0].scale = {-0.8f, 0.8f, 0.8f};
    leave_out_mipmaps(scene);
    return scene;
}

scene::Camera in_front() {
    scene::Camera camera;
    camera.eye = {0.4f, 0.6f, 3};
    return camera;
}

TEST_F(SurfaceTest, EqualsTheGBufferForEveryWrapAndFilter) {
    for (const auto filter : {Filter::linear, Filter::nearest})
        for (const auto wrap : {Wrap::repeat, Wrap::mirrored_repeat, Wrap::clamp_to_edge}) {
            const Shot shot(textured(wrap, filter), in_front(), 64, 64);
            const auto c = compare(shot);
            EXPECT_GT(c.pixels, 1500);
            EXPECT_LT(c.other_triangle, 25);
            EXPECT_LT(c.textured_apart, filter == Filter::linear ? 3 : c.pixels / 50)
                << "at the borders of texels roundings decide";
            EXPECT_LT(c.position, 1e-5);
        }
}

TEST_F(SurfaceTest, EqualsTheGBufferOfTheAtrium) {
    for (const bool normal_maps : {true, false}) {
        auto scene = scene::load_scene("builtin:atrium");
        leave_out_mipmaps(scene);
        const auto world = scene::flatten(scene, 0, 0);
        const Shot shot(scene, world.cameras.at(0), 128, 80);
        const auto c = compare(shot, normal_maps);
        EXPECT_GT(c.pixels, 9000);
        EXPECT_LT(c.other_triangle, c.pixels / 50);
        EXPECT_LT(c.textured_apart, c.pixels / (device().software() ? 100 : 50));
        EXPECT_LT(c.metallic_roughness, 1e-3);
        EXPECT_EQ(c.transmission, 0);
    }
}

TEST_F(SurfaceTest, ReportsTheSideOfTheWinding) {
    SmallWorld small;
    small.square({0, 0, 0}, {0, 0, 1}, 1);
    const auto world = small.world();
    const SurfaceLookup lookup(small.scene(), world, true);
    const passes::Hit hit{1, 0, 0.25f, 0.25f};
    const auto front = lookup.at(hit, {0, 0, -1}), back = lookup.at(hit, {0, 0, 1});
    EXPECT_TRUE(front.is_front);
    EXPECT_FALSE(back.is_front);
    for (const auto* s : {&front, &back}) {
        const float side = s->is_front ? 1.0f : -1.0f;
        EXPECT_LT(glm::distance(s->geometric_normal_ws, {0, 0, side}), 1e-6f);
        EXPECT_LT(glm::distance(s->shading_normal_ws, {0, 0, side}), 1e-6f);
    }
}

TEST_F(SurfaceTest, SurvivesTrianglesWithoutAreaAndNormals) {
    SmallWorld small;
    scene::Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
    mesh.normals.assign(3, {0, 1, 0});
    mesh.indices = {0, 1, 2, 0, 0, 0};
    small.add(mesh);
    const auto world = small.world();
    const SurfaceLookup lookup(small.scene(), world, true);
    for (const std::uint32_t triangle : {0u, 1u}) {
        const auto s = lookup.at({1, triangle, 0.2f, 0.3f}, {0, 0, -1});
        EXPECT_NEAR(glm::length(s.geometric_normal_ws), 1, 1e-6f);
        EXPECT_NEAR(glm::length(s.shading_normal_ws), 1, 1e-6f);
        EXPECT_GE(glm::dot(s.geometric_normal_ws, {0, 0, 1}), 0);
    }
}

TEST_F(SurfaceTest, EmissionIsTheOneOfTheWholeLookup) {
    const auto scene = textured(Wrap::repeat, Filter::linear);
    const auto world = scene::flatten(scene, 0, 0);
    const SurfaceLookup lookup(scene, world, true);
    for (std::uint32_t triangle = 0; triangle < world.triangles(); ++triangle)
        for (const float u : {0.1f, 0.5f}) {
            const auto whole = lookup.at({1, triangle, u, 0.3f}, {0, 0, -1}).emission;
            EXPECT_EQ(lookup.emission(triangle, u, 0.3f), whole);
            EXPECT_GT(glm::length(whole), 0);
        }
}

TEST_F(SurfaceTest, WildTextureCoordinatesStayInTheTexture) {
    for (const auto wrap : {Wrap::repeat, Wrap::mirrored_repeat, Wrap::clamp_to_edge})
        for (const auto filter : {Filter::linear, Filter::nearest}) {
            auto texture = noise(3, 1, 5);
            texture.sampler.wrap_s = texture.sampler.wrap_t = wrap;
            texture.sampler.mag = filter;
            const passes::HostTexture host(texture);
            for (const float x : {0.0f, 1.0f, -1.0f, 1 - 6e-8f, -1e-9f, 1e9f, -3e38f, INFINITY, NAN}) {
                const auto colour = host.at({x, -x});
                EXPECT_TRUE(colour.x >= 0 && colour.x <= 1) << x;
            }
        }
}

}  // namespace
}  // namespace ir::test
