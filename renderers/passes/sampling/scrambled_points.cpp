// The functions of point_sequence.cpp, whose names are used here, for many points at a time.
#include "renderers/passes/sampling/scrambled_points.h"

#include "renderers/passes/vectors/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "renderers/passes/sampling/scrambled_points.cpp"
#include <hwy/foreach_target.h>

#include "renderers/passes/vectors/floats.inl"

HWY_BEFORE_NAMESPACE();
namespace ir::passes::HWY_NAMESPACE {
namespace {

using namespace vectors::HWY_NAMESPACE;

using BitTag = hn::RebindToUnsigned<FloatTag>;
using Bits = hn::Vec<BitTag>;
constexpr BitTag b;

/// Of each pair of neighbours, `by` bits wide, both change places; `mask` has the lower ones.
template <int by>
HWY_INLINE Bits swapped(Bits x, std::uint32_t mask) {
    const auto lower = hn::Set(b, mask);
    return hn::Or(hn::ShiftLeft<by>(hn::And(x, lower)), hn::And(hn::ShiftRight<by>(x), lower));
}
HWY_INLINE Bits reversed(Bits x) {
    x = hn::Or(hn::ShiftLeft<16>(x), hn::ShiftRight<16>(x));
    x = swapped<8>(x, 0x00ff00ffu);
    x = swapped<4>(x, 0x0f0f0f0fu);
    x = swapped<2>(x, 0x33333333u);
    return swapped<1>(x, 0x55555555u);
}

HWY_INLINE Bits scrambled(Bits x, Bits seed) {
    x = hn::Add(x, seed);
    for (const auto factor : {0x6c50b47cu, 0xb82f1e52u, 0xc7afe638u, 0x8d22f6e6u})
        x = hn::Xor(x, hn::Mul(x, hn::Set(b, factor)));
    return x;
}

HWY_INLINE Bits reversed_sobol_second(Bits index) {
    index = hn::Xor(index, hn::ShiftRight<16>(index));
    index = hn::Xor(index, hn::And(hn::ShiftRight<8>(index), hn::Set(b, 0x00ff00ffu)));
    index = hn::Xor(index, hn::And(hn::ShiftRight<4>(index), hn::Set(b, 0x0f0f0f0fu)));
    index = hn::Xor(index, hn::And(hn::ShiftRight<2>(index), hn::Set(b, 0x33333333u)));
    return hn::Xor(index, hn::And(hn::ShiftRight<1>(index), hn::Set(b, 0x55555555u)));
}

HWY_INLINE Floats unit(Bits bits) {
    const auto upper = hn::BitCast(hn::RebindToSigned<FloatTag>(), hn::ShiftRight<8>(bits));
    return hn::Mul(hn::ConvertTo(f, upper), hn::Set(f, 0x1p-24f));
}

void scramble_with_vectors(const PointSeeds& seeds, Lanes2& points) {
    for (std::size_t i = 0; i < lane_count; i += lanes) {
        const auto load = [&](const PointSeeds::Plane& plane) { return hn::LoadU(b, plane.data() + i); };
        const auto shuffled = reversed(scrambled(reversed(load(seeds.index)), load(seeds.order)));
        hn::StoreU(unit(reversed(scrambled(shuffled, load(seeds.x)))), f, points.x.data() + i);
        const auto second = reversed_sobol_second(shuffled);
        hn::StoreU(unit(reversed(scrambled(second, load(seeds.y)))), f, points.y.data() + i);
    }
}

}  // namespace
}  // namespace ir::passes::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ir::passes {

HWY_EXPORT(scramble_with_vectors);

void scramble_points(const PointSeeds& seeds, Lanes2& points) {
    HWY_DYNAMIC_DISPATCH(scramble_with_vectors)(seeds, points);
}

}  // namespace ir::passes
#endif
