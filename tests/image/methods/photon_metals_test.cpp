// Metals that are seen reflect what photons bring as the reference says, where photons are reflected one by
// one.
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <utility>

#include "tests/image/methods/light_of_scene.h"

namespace ir::test {
namespace {

constexpr int ball_pixels = 48;
constexpr float ball_radius = 0.7f, ball_distance = 1.9f, ball_fov_y = 0.85f;

/// Points of a grid on the unit sphere, and the triangles between them.
scene::Mesh metal_ball(int material) {
    constexpr int rows = 24, columns = 48;
    scene::Mesh mesh;
    mesh.material = material;
    for (int i = 0; i <= rows; ++i)
        for (int j = 0; j <= columns; ++j) {
            const float theta = glm::pi<float>() * static_cast<float>(i) / rows,
                        phi = glm::two_pi<float>() * static_cast<float>(j) / columns;
            mesh.normals.emplace_back(std::sin(theta) * std::cos(phi), std::cos(theta),
                                      std::sin(theta) * std::sin(phi));
            mesh.positions.push_back(ball_radius * mesh.normals.back());
            mesh.uv0.emplace_back(0, 0);
        }
    for (std::uint32_t i = 0; i < rows; ++i)
        for (std::uint32_t j = 0; j < columns; ++j) {
            const std::uint32_t a = i * (columns + 1) + j, b = a + columns + 1;
            for (const auto corner : {a, a + 1, b, b, a + 1, b + 1}) mesh.indices.push_back(corner);
        }
    return mesh;
}

/// A room of 4 m with a wall at each end of each axis.
void add_room(scene::Scene& scene, int material) {
    for (int axis = 0; axis < 3; ++axis)
        for (const float side : {-2.0f, 2.0f}) {
            glm::vec3 normal(0);
            normal[axis] = side < 0 ? 1.0f : -1.0f;
            std::vector<glm::vec3> corners;
            for (const auto& [u, v] : {std::pair{-2.0f, -2.0f}, {2.0f, -2.0f}, {2.0f, 2.0f}, {-2.0f, 2.0f}}) {
                corners.emplace_back(0);
                corners.back()[axis] = side;
                corners.back()[(axis + 1) % 3] = u, corners.back()[(axis + 2) % 3] = v;
            }
            add_quad(scene, material, corners, normal);
        }
}

scene::Scene ball_in_a_room(float roughness) {
    scene::Scene scene;
    scene.name = "ball";
    scene.materials.resize(2);
    scene.materials[0].base_colour = {0.8f, 0.8f, 0.8f, 1};
    scene.materials[0].metallic = 1, scene.materials[0].roughness = roughness;
    scene.materials[1].base_colour = {0.7f, 0.7f, 0.7f, 1};
    scene.materials[1].metallic = 0, scene.materials[1].roughness = 1;
    scene::Node node;
    node.meshes = {0};
    scene.meshes.push_back(metal_ball(0));
    scene.nodes.push_back(node);
    add_room(scene, 1);
    scene::Light lamp;
    lamp.position = {0.4f, 1.4f, 1.6f};
    lamp.intensity = 10;
    scene.lights = {lamp};
    scene::Camera camera;
    camera.eye = {0, 0, ball_distance};
    camera.target = {0, 0, 0};
    camera.fov_y = ball_fov_y;
    scene.cameras = {camera};
    return scene;
}

/// Whether the ball is seen in the pixel's middle.
bool shows_the_ball(int x, int y) {
    const float half = std::tan(ball_fov_y / 2) * 2 / ball_pixels;
    const float across = half * std::hypot(static_cast<float>(x) + 0.5f - ball_pixels / 2.0f,
                                           static_cast<float>(y) + 0.5f - ball_pixels / 2.0f);
    return ball_distance * across / std::sqrt(1 + across * across) < ball_radius;
}

double light_of_the_ball(const std::string& method, const scene::Scene& scene, const Settings& settings) {
    const auto picture = once_bounced_light(method, scene, settings, ball_pixels, ball_pixels);
    double sum = 0;
    for (int y = 0; y < ball_pixels; ++y)
        for (int x = 0; x < ball_pixels; ++x)
            if (shows_the_ball(x, y)) sum += picture.at(x, y, 1);
    return sum;
}

class PhotonsOnMetals : public testing::TestWithParam<float> {
  protected:
    static void TearDownTestSuite() { machines().clear(); }
};

TEST_P(PhotonsOnMetals, AreReflectedWithinATenthOfTheReference) {
    const auto scene = ball_in_a_room(GetParam());
    const double photons = light_of_the_ball("photon-mapping", scene,
                                             {{"photons", std::int64_t{400'000}},
                                              {"photons_per_point", std::int64_t{4}},
                                              {"filter_passes", std::int64_t{0}},
                                              {"receiver", std::string("full")}});
    const double reference = light_of_the_ball("reference", scene, {{"samples", std::int64_t{256}}});
    RecordProperty("ratio", std::to_string(photons / reference));
    EXPECT_NEAR(photons / reference, 1, 0.1);
}

INSTANTIATE_TEST_SUITE_P(Balls, PhotonsOnMetals, testing::Values(0.1f, 0.3f, 0.6f), [](const auto& info) {
    return "roughness_" + std::to_string(int(100 * info.param + 0.5f));
});

}  // namespace
}  // namespace ir::test
