#pragma once

#include <glm/glm.hpp>

#include "renderers/image/luminance.h"

namespace ir::passes {

/// Of linear RGB with sRGB's primaries (Rec. 709).
inline float luminance(glm::vec3 rgb) {
    return ir::luminance(rgb.r, rgb.g, rgb.b);
}

}  // namespace ir::passes
