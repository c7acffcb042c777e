#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "renderers/methods/all_methods.h"
#include "tests/unit/passes/pass_fixture.h"

namespace ir::test {

/// Renders ambient-occlusion-volumes.
class VolumesTest : public PassTest {
  protected:
    Image render(const Shot& shot, const Settings& settings, const std::string& key = "accessibility",
                 std::uint64_t seed = 7, Inspection picked = {}) {
        const auto& all = methods::all_methods();
        const auto method = std::find_if(all.begin(), all.end(), [](const auto* m) {
            return m->description.id == "ambient-occlusion-volumes";
        });
        if (method == all.end()) throw std::runtime_error("ambient-occlusion-volumes is not registered");
        auto inputs = shot.inputs();
        inputs.seed = seed;
        inputs.processor = on;
        inputs.inspection = std::move(picked);
        graph::FrameOptions options;
        options.wanted = wanted;
        options.wanted.push_back(key);
        report =
            graph().run(**method, completed((*method)->description.parameters, settings), inputs, options);
        return read(key);
    }
    FrameReport report;
    std::vector<std::string> wanted{"gbuffer.*", "bounce.*", "volumes.*"};
    Processor on = Processor::gl;
};

inline scene::Camera volumes_camera(glm::vec3 eye, glm::vec3 target, float orthographic_height = 0) {
    return looking_at(eye, target, orthographic_height > 0, orthographic_height, {0, 0, 1});
}

inline Settings additive_volumes(double reach, const char* sides = "both", const char* falloff = "hard") {
    return {{"visibility", false},
            {"blur", false},
            {"max_distance", reach},
            {"falloff", std::string(falloff)},
            {"sides", std::string(sides)}};
}

inline Settings bounced_volumes(double reach, int samples, const char* falloff = "hard") {
    return {{"samples", std::int64_t{samples}},
            {"blur", false},
            {"max_distance", reach},
            {"falloff", std::string(falloff)}};
}

}  // namespace ir::test
