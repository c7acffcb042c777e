#pragma once

#include <cstdint>
#include <limits>
#include <string>

#include "renderers/core/changed_shaders.h"
#include "renderers/core/inspection.h"
#include "renderers/core/processor.h"
#include "renderers/core/shard.h"
#include "renderers/scene/view.h"
#include "renderers/scene/world.h"

namespace ir::graph {

/// What a frame is made from. The pointers outlive the frame.
struct FrameInputs {
    const scene::Scene* scene = nullptr;
    const scene::World* world = nullptr;
    std::string world_fingerprint;     ///< equal exactly while the world is (scene hash, time and lights)
    std::string geometry_fingerprint;  ///< likewise of all but the world's lights and environment
    scene::View view, previous_view;
    std::uint64_t seed = 0;
    int frame = 0;                        ///< 0 for the first after an empty history
    double time = 0;                      ///< seconds
    int threads = 0;                      ///< for cpu passes; 0 = all
    Processor processor = Processor::gl;  ///< of passes with two bodies
    /// What the frame may add at most to its history, where a parameter accumulates (core/parameter.h): less
    /// than that parameter asks for when a stored history is continued or a frame should not take long, 0
    /// when the history is only shown. At least 1 where there is none.
    std::uint64_t sample_limit = std::numeric_limits<std::uint64_t>::max();
    /// Of the picture, where the method can be divided (Method::join): other pixels get no samples.
    Shard shard = {};
    ShaderChanges shader_changes = {};  ///< in place of the shaders as they are in their folder
    Inspection inspection;
    /// The pixel of the view that a person picked; (-1, -1): none.
    glm::ivec2 picked_pixel() const {
        const auto& p = inspection;
        const bool inside = p.has_pixel() && p.x < view.width && p.y < view.height;
        return inside ? glm::ivec2(p.x, p.y) : glm::ivec2(-1);
    }
};

}  // namespace ir::graph
