#include "renderers/core/half_float.h"

#include <gtest/gtest.h>

#include <glm/packing.hpp>

namespace ir {
namespace {

TEST(HalfFloat, AreThoseOfGlmBitByBit) {
    // Each exponent and sign, with mantissas on both sides of every tie, and many others.
    for (std::uint64_t bits = 0; bits < 1ull << 32; bits += 0x1000 - 1) {
        const auto value = std::bit_cast<float>(static_cast<std::uint32_t>(bits));
        ASSERT_EQ(half_from_float(value), glm::packHalf1x16(value)) << bits;
    }
    for (std::uint64_t bits = 0; bits < 1ull << 32; bits += 0x1000) {
        const auto value = std::bit_cast<float>(static_cast<std::uint32_t>(bits));
        ASSERT_EQ(half_from_float(value), glm::packHalf1x16(value)) << bits;
    }
    for (std::uint32_t half = 0; half < 1u << 16; ++half) {
        const auto bits = static_cast<std::uint16_t>(half);
        ASSERT_EQ(std::bit_cast<std::uint32_t>(float_from_half(bits)),
                  std::bit_cast<std::uint32_t>(glm::unpackHalf1x16(bits)))
            << half;
    }
    const glm::vec4 four(0.1f, -2048, 0, 1e-6f);
    EXPECT_EQ(pack_halves(four), glm::packHalf4x16(four));
    EXPECT_EQ(unpack_halves(pack_halves(four)), glm::unpackHalf4x16(pack_halves(four)));
    EXPECT_EQ(pack_halves(glm::vec2(0.1f, -3)), glm::packHalf2x16({0.1f, -3}));
}

}  // namespace
}  // namespace ir
