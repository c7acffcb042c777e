#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "renderers/methods/hbao/parameters.h"
#include "renderers/methods/hbao/passes.h"

namespace ir::methods::hbao {

struct MarchRules {
    MarchConstants constants;
    Parameters parameters;
    int width = 0, height = 0;
};

/// What is marched through, a plane for each part, so that many pixels are looked at at once. Where there is
/// no surface the position is no number and the geometric normal 0.
struct MarchedSurfaces {
    using Planes = std::array<std::vector<float>, 3>;
    MarchedSurfaces(int width, int height);
    void set(std::size_t pixel, const glm::vec4& position, glm::vec3 normal, glm::vec3 geometric_normal);

    Planes position, normal, geometric_normal;
};

/// Sums over all directions of a row of pixels: shaders/methods/hbao/march.comp, many pixels at a time.
void march_row(const MarchRules& rules, const MarchedSurfaces& surfaces, int y, std::span<glm::vec4> sums);

}  // namespace ir::methods::hbao
