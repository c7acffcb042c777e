// What a mirror floor shows of a ceiling that a lamp lights: a closed form.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "renderers/methods/all_methods.h"
#include "renderers/passes/reflection/reflection.h"
#include "renderers/passes/scattering/microfacets.h"
#include "tests/unit/passes/pass_fixture.h"
#include "tests/unit/passes/small_world.h"

namespace ir::test {
namespace {

constexpr float intensity = 3, ceiling_albedo = 0.5f;
constexpr glm::vec3 lamp(0.3f, 1, -0.2f), metal(0.9f, 0.6f, 0.4f), eye(0, 1, 3);

/// Floor and ceiling, 8 m wide, 2 m apart.
scene::Scene hall(float roughness) {
    SmallWorld small;
    small.square({0, 0, 0}, {0, 1, 0}, 4, SmallWorld::masked);
    small.square({0, 2, 0}, {0, -1, 0}, 4);
    auto scene = small.scene();
    auto& mirror = scene.materials[SmallWorld::masked];
    mirror = {};
    mirror.base_colour = glm::vec4(metal, 1);
    mirror.metallic = 1;
    mirror.roughness = roughness;
    auto& plaster = scene.materials[SmallWorld::opaque];
    plaster.base_colour = glm::vec4(glm::vec3(ceiling_albedo), 1);
    plaster.metallic = 0;
    scene::Light light;
    light.position = lamp;
    light.intensity = intensity;
    scene.lights = {light};
    return scene;
}

class LdmIndirectMirror : public PassTest {
  protected:
    Image look(const Settings& more, const char* key) {
        for (const auto* method : methods::all_methods()) {
            if (method->description.id != "ldm-indirect") continue;
            Settings settings{
                {"gloss", std::string("mirror")},   {"gloss_tracer", std::string("maps")},
                {"gloss_samples", std::int64_t{1}}, {"materials", std::string("metalness-blend")},
                {"paths", std::string("indirect")}, {"directions", std::int64_t{48}},
                {"resolution", std::int64_t{100}},  {"emission", std::int64_t{4}}};
            for (const auto& [name, value] : more) settings[name] = value;
            auto inputs = shot_.inputs();
            inputs.processor = Processor::host;
            graph::FrameOptions options;
            options.wanted = {key, "gbuffer.position", "gbuffer.geometric_normal"};
            report_ =
                run_method(*method, completed(method->description.parameters, settings), inputs, options);
        }
        return read(key);
    }

    void polish() { shot_ = Shot(hall(0), looking(eye, {0, 0, 0}), 48, 32); }
    static glm::vec3 reflectance(float roughness, float cosine) {
        return roughness > 0 ? passes::directional_albedo(metal, roughness, cosine)
                             : passes::schlick_fresnel(metal, cosine);
    }

    /// Mean of |found - expected| over expected, of pixels that show the floor and the ceiling in it.
    double error(const Settings& more) { return error(look(more, "gloss.radiance"), 0.1f); }
    double error(const Image& found, float roughness) {
        const auto position = read("gbuffer.position"), normal = read("gbuffer.geometric_normal");
        double sum = 0;
        int count = 0;
        for (int y = 0; y < found.height; ++y)
            for (int x = 0; x < found.width; ++x) {
                const glm::vec3 at(position.at(x, y, 0), position.at(x, y, 1), position.at(x, y, 2));
                if (normal.at(x, y, 1) < 0.5f) continue;
                const auto v = glm::normalize(eye - at), l = glm::vec3(-v.x, v.y, -v.z);
                const auto seen = at + 2 / l.y * l;
                if (std::max(std::abs(seen.x), std::abs(seen.z)) > 3.8f) continue;
                const auto to_lamp = lamp - seen;
                const float distance = glm::length(to_lamp);
                const float irradiance = intensity * -to_lamp.y / (distance * distance * distance);
                const auto expected =
                    reflectance(roughness, v.y) * (ceiling_albedo * irradiance / glm::pi<float>());
                for (int c = 0; c < 3; ++c) sum += std::abs(found.at(x, y, c) / expected[c] - 1);
                count += 3;
            }
        EXPECT_GT(count, 900);
        return sum / count;
    }

    std::ptrdiff_t notes(const std::string& text) const {
        return std::ranges::count_if(report_.messages, [&](const Message& message) {
            return message.text.find(text) != std::string::npos;
        });
    }

  private:
    FrameReport report_;
    Shot shot_{hall(0.1f), looking(eye, {0, 0, 0}), 48, 32};
};

// On the plane of what a map's direction hits, the wished direction meets the right place.
TEST_F(LdmIndirectMirror, ShowsTheCeilingWhereItIs) {
    EXPECT_LT(error({{"gloss_tracer", std::string("rays")}}), 1e-3);
    EXPECT_LT(error({}), 1e-3);
    const double coarse = error({{"gloss_landing", std::string("direction")}}),
                 fine =
                     error({{"gloss_landing", std::string("direction")}, {"directions", std::int64_t{768}}});
    EXPECT_GT(coarse, 0.05);
    EXPECT_LT(fine, 0.5 * coarse);
}

// A mirror scatters nothing, as in the reference: what it shows of the ceiling is direct light where the
// ceiling reflects the lamp's, and that alone is missing from indirect light.
TEST_F(LdmIndirectMirror, ThatIsSmoothIsNoBounce) {
    polish();
    Settings settings{{"gloss", std::string("lobe")}, {"paths", std::string("full")}};
    auto direct = look(settings, "gloss.radiance");
    settings["paths"] = std::string("indirect");
    const auto indirect = look(settings, "gloss.radiance");
    for (std::size_t i = 0; i < direct.pixels.size(); ++i) direct.pixels[i] -= indirect.pixels[i];
    EXPECT_LT(error(direct, 0), 1e-3);
}

// A region of 2N is at most 5.5/√(2N) wide, and its direction lies within it. Where that runs below the floor
// another one is taken.
TEST_F(LdmIndirectMirror, AsksTheMapOfANearDirection) {
    for (const std::int64_t directions : {32, 128}) {
        const auto angles = look({{"directions", directions}}, "gloss.error");
        const double widest = glm::degrees(5.5 / std::sqrt(2.0 * double(directions)));
        double sum = 0, most = 0;
        for (const float angle : angles.pixels) sum += angle, most = std::max(most, double(angle));
        EXPECT_GT(sum, 0.05 * widest * double(angles.pixels.size()));
        EXPECT_LT(most, 1.5 * widest) << directions;
    }
    for (const float angle : look({{"gloss_tracer", std::string("rays")}}, "gloss.error").pixels)
        EXPECT_EQ(angle, 0);
}

// Interfaces see surfaces, and no ray meets a lamp without extent.
TEST_F(LdmIndirectMirror, SaysThatDirectPhotonsHaveNoHighlights) {
    const auto count = [&](const char* paths, const char* direct) {
        look({{"paths", std::string(paths)}, {"direct", std::string(direct)}}, "gloss.radiance");
        return notes("direct=photons is diffuse");
    };
    EXPECT_EQ(count("full", "photons"), 1);
    EXPECT_EQ(count("full", "rasterisation"), 0);
    EXPECT_EQ(count("indirect", "photons"), 0);
}

}  // namespace
}  // namespace ir::test
