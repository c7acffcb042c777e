#pragma once

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

#include "renderers/methods/all_methods.h"
#include "tests/unit/passes/pass_fixture.h"
#include "tests/unit/passes/small_world.h"

namespace ir::test {

class SsdoTest : public PassTest {
  protected:
    /// By the method's defaults, but with Lambert's materials: what closed forms know.
    Image render(const Shot& shot, Settings settings, const std::string& key = "ssdo.indirect.raw",
                 Inspection picked = {}, std::uint64_t seed = 1) {
        const auto& all = methods::all_methods();
        const auto method =
            std::find_if(all.begin(), all.end(), [](const auto* m) { return m->description.id == "ssdo"; });
        if (method == all.end()) throw std::runtime_error("ssdo is not registered");
        auto inputs = shot.inputs();
        inputs.inspection = std::move(picked);
        inputs.seed = seed;
        inputs.processor = body;
        graph::FrameOptions options;
        options.wanted = {"*"};
        settings.try_emplace("materials", std::string("lambert"));
        report =
            graph().run(**method, completed((*method)->description.parameters, settings), inputs, options);
        return read(key);
    }
    /// The words of an explaining buffer, as floats.
    std::vector<float> explained(const std::string& key) {
        const auto bytes = graph().read_buffer(key).value();
        std::vector<float> words(bytes.size() / sizeof(float));
        std::memcpy(words.data(), bytes.data(), words.size() * sizeof(float));
        return words;
    }
    FrameReport report;
    Processor body = Processor::gl;  ///< that pictures are gathered by
};

/// The environment's light by directional occlusion: "ssdo.sky".
inline Settings sky_by_occlusion(Settings settings) {
    settings["environment_by"] = std::string("occlusion");
    return settings;
}

inline Settings many_samples(int samples, double radius) {
    return {{"samples", std::int64_t{samples}},
            {"max_distance", radius},
            {"turning", std::string("hash")},
            {"blur", false}};
}

/// A floor of 2 m × 2 m (x from 0 on) before a wall of 1 m × 1 m at x = 0, all white; a sun that shines on
/// both.
inline scene::Scene lit_wall() {
    SmallWorld world;
    world.quad({0, 0, 1}, {2, 0, 1}, {2, 0, -1}, {0, 0, -1});
    world.quad({0, 0, 0.5f}, {0, 0, -0.5f}, {0, 1, -0.5f}, {0, 1, 0.5f});
    auto scene = world.scene();
    for (auto& material : scene.materials) material.base_colour = {0.8f, 0.8f, 0.8f, 1};
    scene::Light sun;
    sun.type = scene::LightType::directional;
    sun.direction = glm::normalize(glm::vec3(-1, -1, 0));
    sun.intensity = 3;
    scene.lights = {sun};
    return scene;
}

/// Form factor from a point of that floor to the part of the wall nearer than `radius`, by the midpoint rule.
inline double wall_form_factor(double x, double z, double radius) {
    constexpr int n = 64;
    double sum = 0;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const double y = (i + 0.5) / n, dz = -0.5 + (j + 0.5) / n - z, d2 = x * x + y * y + dz * dz;
            if (d2 < radius * radius) sum += y * x / (d2 * d2) / (n * n);
        }
    return sum / 3.14159265358979;
}

}  // namespace ir::test
