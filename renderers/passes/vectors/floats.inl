// Vectors of floats of one instruction set, as wide as it has them.
// Read once for each instruction set, within a source that includes <hwy/foreach_target.h>.
#include <cstdint>

#include <hwy/highway.h>

#if defined(IR_VECTORS_FLOATS) == defined(HWY_TARGET_TOGGLE)
#ifdef IR_VECTORS_FLOATS
#undef IR_VECTORS_FLOATS
#else
#define IR_VECTORS_FLOATS
#endif

HWY_BEFORE_NAMESPACE();
namespace ir::passes::vectors::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using FloatTag = hn::CappedTag<float, 16>;
using Floats = hn::Vec<FloatTag>;
using Mask = hn::Mask<FloatTag>;

constexpr FloatTag f;
constexpr int lanes = static_cast<int>(hn::MaxLanes(FloatTag()));

[[maybe_unused]] std::uint32_t bits_of(Mask mask) {
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(f, mask, bytes);
    const auto bits = static_cast<std::uint32_t>(bytes[0] | bytes[1] << 8);
    return bits & ((1u << lanes) - 1);
}

}  // namespace
}  // namespace ir::passes::vectors::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
