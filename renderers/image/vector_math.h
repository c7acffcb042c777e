#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

/// Elementary functions that compilers turn into vector code: no branches, no tables, no calls.
/// Relative errors stay below 3e-6 for what colours need.
namespace ir::vector_math {

/// Functions that are worth a second version for wide registers, chosen when the program starts. Without
/// fused multiplication, so that both versions give the same numbers.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(INTERREFLECT_SANITIZED)
#define IR_WIDE_REGISTERS __attribute__((target_clones("avx2", "default")))
#else
#define IR_WIDE_REGISTERS
#endif

/// Binary logarithm of a positive, normal number: the exponent, and for the mantissa m the series
/// ln m = 2 artanh((m - 1) / (m + 1)).
inline float log2(float x) {
    const auto bits = std::bit_cast<std::int32_t>(x);
    constexpr std::int32_t root_half = 0x3f3504f3;  // √½: mantissas lie between √½ and √2
    const std::int32_t exponent = (bits - root_half) >> 23;
    const float m = std::bit_cast<float>(bits - exponent * (1 << 23));
    const float s = (m - 1) / (m + 1), s2 = s * s;
    const float series = s * (2 + s2 * (2.0f / 3 + s2 * (2.0f / 5 + s2 * (2.0f / 7 + s2 * (2.0f / 9)))));
    return static_cast<float>(exponent) + series * std::numbers::log2e_v<float>;
}

/// 2^x for |x| < 126: a power of two, and for the fraction the exponential series.
inline float exp2(float x) {
    const float shifted = x + 12582912.0f;  // 1.5 · 2^23: the sum's last bits are the nearest integer
    const std::int32_t whole = std::bit_cast<std::int32_t>(shifted) - 0x4b400000;
    const float f = (x - static_cast<float>(whole)) * std::numbers::ln2_v<float>;
    const float series =
        1 + f * (1 + f * (1.0f / 2 + f * (1.0f / 6 + f * (1.0f / 24 + f * (1.0f / 120 + f * (1.0f / 720))))));
    return series * std::bit_cast<float>((whole + 127) * (1 << 23));
}

/// x^p for x ≥ 0 and p ≥ 0; what underflows is 0.
inline float power(float x, float p) {
    constexpr float smallest = 1e-30f;
    const float raised = exp2(p * log2(x > smallest ? x : smallest));
    return x > smallest ? raised : (p > 0 ? 0.0f : 1.0f);
}

}  // namespace ir::vector_math
