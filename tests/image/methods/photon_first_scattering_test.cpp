// Where light arrives first, surfaces scatter as the reference's do: also with shading normals that lean away
// from the surface, and where a part of the light goes through.
#include <cmath>

#include "tests/image/methods/light_of_scene.h"

namespace ir::test {
namespace {

constexpr int sent_width = 48, sent_height = 36;

void add_facing_square(scene::Scene& scene, int material, glm::vec3 centre, float half, float facing,
                       glm::vec3 shading_normal) {
    const float x = facing * half;
    add_quad(scene, material,
             {centre + glm::vec3(-x, -half, 0), centre + glm::vec3(x, -half, 0),
              centre + glm::vec3(x, half, 0), centre + glm::vec3(-x, half, 0)},
             shading_normal);
}

struct FirstSender {
    const char* name;
    float tilt = 0, metallic = 0, transmission = 0, index = 1.5f;
    glm::vec3 colour{0.8f, 0.7f, 0.6f};
};

/// A lit square behind the eye sends its light to a large wall before it.
scene::Scene sender_and_wall(const FirstSender& from) {
    scene::Scene scene;
    scene.name = "sender";
    scene.materials.resize(2);
    auto& sender = scene.materials[0];
    sender.base_colour = glm::vec4(from.colour, 1);
    sender.metallic = from.metallic, sender.roughness = 0.6f;
    sender.transmission = from.transmission, sender.ior = from.index;
    scene.materials[1].base_colour = {0.8f, 0.8f, 0.8f, 1};
    scene.materials[1].metallic = 0, scene.materials[1].roughness = 1;
    add_facing_square(scene, 0, {0, 0, 0}, 0.5f, 1, {std::sin(from.tilt), 0, std::cos(from.tilt)});
    add_facing_square(scene, 1, {0, 0, 2}, 8, -1, {0, 0, -1});
    scene::Light spot;
    spot.type = scene::LightType::spot;
    spot.position = {0.8f, 0.3f, 1.2f};
    spot.direction = glm::normalize(-spot.position);
    spot.inner_angle = 0.2f, spot.outer_angle = 0.25f;
    spot.intensity = 10;
    scene.lights = {spot};
    scene::Camera camera;
    camera.eye = {0, 0, 0.1f};
    camera.target = {0, 0, 2};
    camera.fov_y = 1.8f;
    scene.cameras = {camera};
    return scene;
}

double light_sent(const std::string& method, const scene::Scene& scene, const Settings& settings) {
    const auto picture = once_bounced_light(method, scene, settings, sent_width, sent_height);
    double sum = 0;
    for (int y = 0; y < sent_height; ++y)
        for (int x = 0; x < sent_width; ++x) sum += picture.at(x, y, 1);
    return sum;
}

class FirstScattering : public testing::TestWithParam<FirstSender> {
  protected:
    static void TearDownTestSuite() { machines().clear(); }
};

TEST_P(FirstScattering, OfPhotonsIsTheReferences) {
    const auto scene = sender_and_wall(GetParam());
    const double photons = light_sent("photon-mapping", scene,
                                      {{"photons", std::int64_t{100'000}},
                                       {"filter_passes", std::int64_t{0}},
                                       {"max_radius", 0.02},
                                       {"receiver", std::string("full")}});
    const double reference = light_sent("reference", scene, {{"samples", std::int64_t{512}}});
    RecordProperty("ratio", std::to_string(photons / reference));
    EXPECT_GT(photons / reference, 0.98);
    EXPECT_LT(photons / reference, 1.02);
}

constexpr float degrees_20 = 0.349f, degrees_40 = 0.698f;

INSTANTIATE_TEST_SUITE_P(
    Senders, FirstScattering,
    testing::Values(FirstSender{.name = "upright"}, FirstSender{.name = "tilted_20", .tilt = degrees_20},
                    FirstSender{.name = "tilted_40", .tilt = degrees_40},
                    FirstSender{.name = "tilted_away_40", .tilt = -degrees_40},
                    FirstSender{.name = "metal_tilted_away_40", .tilt = -degrees_40, .metallic = 1},
                    FirstSender{.name = "glass_in_part", .transmission = 0.4f},
                    FirstSender{.name = "black_index_3", .index = 3, .colour = glm::vec3(0)}),
    [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace ir::test
