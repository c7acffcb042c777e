#include <array>

#include "renderers/gl/device.h"

namespace ir::gl {

const FormatInfo& info(Format format) {
    // name, internal format, format, type, channels, bytes, integer, depth; in the order of Format
    static constexpr std::array<FormatInfo, 12> table{{
        {"r8", GL_R8, GL_RED, GL_UNSIGNED_BYTE, 1, 1, false, false},
        {"rgba8", GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, 4, 4, false, false},
        {"r16f", GL_R16F, GL_RED, GL_HALF_FLOAT, 1, 2, false, false},
        {"rg16f", GL_RG16F, GL_RG, GL_HALF_FLOAT, 2, 4, false, false},
        {"rgba16f", GL_RGBA16F, GL_RGBA, GL_HALF_FLOAT, 4, 8, false, false},
        {"r32f", GL_R32F, GL_RED, GL_FLOAT, 1, 4, false, false},
        {"rg32f", GL_RG32F, GL_RG, GL_FLOAT, 2, 8, false, false},
        {"rgba32f", GL_RGBA32F, GL_RGBA, GL_FLOAT, 4, 16, false, false},
        {"r32ui", GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, 1, 4, true, false},
        {"rg32ui", GL_RG32UI, GL_RG_INTEGER, GL_UNSIGNED_INT, 2, 8, true, false},
        {"depth32f", GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT, 1, 4, false, true},
        {"srgba8", GL_SRGB8_ALPHA8, GL_RGBA, GL_UNSIGNED_BYTE, 4, 4, false, false},
    }};
    return table.at(static_cast<std::size_t>(format));
}

std::uint64_t ImageShape::bytes() const {
    std::uint64_t texels = 0;
    for (int level = 0; level < levels; ++level)
        texels +=
            static_cast<std::uint64_t>(level_width(level)) * static_cast<std::uint64_t>(level_height(level));
    return texels * static_cast<std::uint64_t>(std::max(1, layers)) *
           static_cast<std::uint64_t>(info(format).bytes);
}

}  // namespace ir::gl
