#pragma once

#include <glm/glm.hpp>

namespace ir::passes {

/// Of linear RGB with sRGB's primaries (Rec. 709).
inline float luminance(glm::vec3 rgb) {
    return glm::dot(rgb, glm::vec3(0.2126f, 0.7152f, 0.0722f));
}

}  // namespace ir::passes
