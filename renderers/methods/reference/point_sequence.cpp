#include "renderers/methods/reference/point_sequence.h"

namespace ir::methods::reference {
namespace {

std::uint32_t reversed(std::uint32_t x) {
    x = (x >> 16) | (x << 16);
    x = ((x & 0x00ff00ffu) << 8) | ((x & 0xff00ff00u) >> 8);
    x = ((x & 0x0f0f0f0fu) << 4) | ((x & 0xf0f0f0f0u) >> 4);
    x = ((x & 0x33333333u) << 2) | ((x & 0xccccccccu) >> 2);
    return ((x & 0x55555555u) << 1) | ((x & 0xaaaaaaaau) >> 1);
}

/// Nested permutation of reversed bits: each bit is flipped depending on those below it [Laine11 §3.3].
std::uint32_t scrambled(std::uint32_t x, std::uint32_t seed) {
    x += seed;
    x ^= x * 0x6c50b47cu;
    x ^= x * 0xb82f1e52u;
    x ^= x * 0xc7afe638u;
    x ^= x * 0x8d22f6e6u;
    return x;
}

/// Second dimension of Sobol's sequence: the generator matrix is Pascal's triangle modulo 2, each column the
/// one before xor itself shifted.
std::uint32_t sobol_second(std::uint32_t index) {
    std::uint32_t result = 0;
    for (std::uint32_t column = 1u << 31; index != 0; index >>= 1, column ^= column >> 1) {
        if (index & 1) result ^= column;
    }
    return result;
}

/// The upper 24 bits: what a float holds without rounding up to 1.
float unit(std::uint32_t bits) {
    return static_cast<float>(bits >> 8) * 0x1p-24f;
}

}  // namespace

PointSequence::PointSequence(std::uint64_t key) {
    const auto seeds = mixed(key);
    seed_x_ = static_cast<std::uint32_t>(seeds);
    seed_y_ = static_cast<std::uint32_t>(seeds >> 32);
}

glm::vec2 PointSequence::point(std::uint32_t index) const {
    // The first dimension is the reversed index, which the scramble wants reversed again.
    const auto x = reversed(scrambled(index, seed_x_));
    const auto y = reversed(scrambled(reversed(sobol_second(index)), seed_y_));
    return {unit(x), unit(y)};
}

}  // namespace ir::methods::reference
