#pragma once

#include <glm/glm.hpp>

#include "renderers/image/luminance.h"

namespace ir::passes {

/// Of linear RGB with sRGB's primaries (Rec. 709).
inline float luminance(glm::vec3 rgb) {
    return ir::luminance(rgb.r, rgb.g, rgb.b);
}

/// What power and flux are counted by: all channels alike.
inline float channel_mean(glm::vec3 rgb) {
    return (rgb.r + rgb.g + rgb.b) / 3;
}

}  // namespace ir::passes
