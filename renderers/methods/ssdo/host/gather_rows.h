#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "renderers/methods/ssdo/passes.h"

namespace ir::methods::ssdo {

/// What the samples of all pixels share: uniforms and textures of shaders/methods/ssdo/samples.glsl.
struct Picture {
    SampleConstants constants;
    Parameters parameters;
    int width = 0, height = 0;
    /// What is seen, and what depth peeling finds behind it. Normals of the first are turned to the viewer.
    struct Layer {
        std::span<const glm::vec4> positions{}, normals{}, senders{};
    };
    std::vector<Layer> layers{};
    std::span<const glm::vec4> environment{};
};

/// Point of samples.glsl for a row of pixels, a plane for each part, so that many take samples at once.
struct PointRow {
    using Plane = std::vector<float>;
    using Planes = std::array<Plane, 3>;
    explicit PointRow(int width);

    Plane exists, is_lit;  ///< 1 or 0
    Planes position, normal, geometric_normal, viewer, diffuse, f0;
    Plane specular, alpha, n_dot_v;
    Planes shift;
};

/// What sky.comp and senders.comp write, of a row.
void gather_sky(const Picture& picture, const PointRow& row, std::span<glm::vec4> sky,
                std::span<float> accessibility, std::span<float> cut);
void gather_indirect(const Picture& picture, const PointRow& row, std::span<glm::vec4> indirect);

}  // namespace ir::methods::ssdo
