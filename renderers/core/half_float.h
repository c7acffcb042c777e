#pragma once

#include <bit>
#include <cstdint>
#include <glm/gtc/packing.hpp>

namespace ir {

/// As glm::packHalf1x16, bit by bit, but quick for the values that pictures hold.
inline std::uint16_t half_from_float(float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value), magnitude = bits & 0x7fffffffu;
    constexpr std::uint32_t min_normal = 0x38800000, overflow = 0x47800000, below_all = 0x33000000;
    const std::uint32_t sign = bits >> 16 & 0x8000u;
    // Rounded to the nearest; the carry goes on into the exponent, up to infinity.
    if (magnitude - min_normal < overflow - min_normal)
        return static_cast<std::uint16_t>(sign | ((magnitude - (min_normal - 0x00800000) + 0x1000) >> 13));
    if (magnitude < below_all) return static_cast<std::uint16_t>(sign);
    return glm::packHalf1x16(value);
}

/// As glm::unpackHalf1x16, bit by bit, and without branches, so that compilers do many at once.
inline float float_from_half(std::uint16_t half) {
    constexpr std::uint32_t min_normal = 0x0400, infinite = 0x7c00, least = 0x38800000;  // 2⁻¹⁴
    const std::uint32_t magnitude = half & 0x7fffu, sign = static_cast<std::uint32_t>(half & 0x8000) << 16;
    const std::uint32_t shifted = magnitude << 13, normal = shifted + 0x38000000u;
    const auto small =
        std::bit_cast<std::uint32_t>(std::bit_cast<float>(least + shifted) - std::bit_cast<float>(least));
    const std::uint32_t finite = magnitude < min_normal ? small : normal;
    return std::bit_cast<float>(sign | (magnitude < infinite ? finite : shifted | 0x7f800000u));
}

inline std::uint32_t pack_halves(const glm::vec2& v) {
    return half_from_float(v.x) | static_cast<std::uint32_t>(half_from_float(v.y)) << 16;
}

inline std::uint64_t pack_halves(const glm::vec4& v) {
    return pack_halves(glm::vec2(v.x, v.y)) | static_cast<std::uint64_t>(pack_halves(glm::vec2(v.z, v.w)))
                                                  << 32;
}

inline glm::vec4 unpack_halves(std::uint64_t halves) {
    const auto at = [halves](int i) { return float_from_half(static_cast<std::uint16_t>(halves >> 16 * i)); };
    return {at(0), at(1), at(2), at(3)};
}

}  // namespace ir
