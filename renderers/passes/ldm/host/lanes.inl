// Vectors of floats and whole numbers of one instruction set.
// Read once for each instruction set, within a source that includes <hwy/foreach_target.h>.
#include <algorithm>
#include <cstdint>
#include <iterator>

#include "renderers/passes/vectors/floats.inl"

#if defined(IR_LDM_HOST_LANES) == defined(HWY_TARGET_TOGGLE)
#ifdef IR_LDM_HOST_LANES
#undef IR_LDM_HOST_LANES
#else
#define IR_LDM_HOST_LANES
#endif

HWY_BEFORE_NAMESPACE();
namespace ir::passes::ldm::HWY_NAMESPACE {
namespace {

using namespace vectors::HWY_NAMESPACE;

using IntTag = hn::RebindToSigned<FloatTag>;
using UintTag = hn::RebindToUnsigned<FloatTag>;
using Ints = hn::Vec<IntTag>;

constexpr IntTag n;

/// Numbers of the lanes that each mask has, first ones first.
struct PackedLanes {
    alignas(64) std::uint8_t lane[1 << std::min(lanes, 8)][std::min(lanes, 8)] = {};
    constexpr PackedLanes() {
        for (unsigned mask = 0; mask < std::size(lane); ++mask)
            for (unsigned from = 0, to = 0; from < std::size(lane[0]); ++from)
                if ((mask >> from & 1) != 0) lane[mask][to++] = static_cast<std::uint8_t>(from);
    }
};
[[maybe_unused]] constexpr PackedLanes packed_lanes;

/// Stores some lanes of vectors, packed, with anything behind them: up to a whole vector is written. (Stores
/// that compress are many times as slow on some processors, and so is Highway's Compress with GCC for AVX2.)
class Packing {
  public:
    explicit Packing(Mask which) : which_(which), bits_(bits_of(which)) {
        if constexpr (lanes <= 8)
            from_ = hn::PromoteTo(n, hn::LoadU(hn::Rebind<std::uint8_t, IntTag>(), packed_lanes.lane[bits_]));
    }
    int count() const { return static_cast<int>(hwy::PopCount(bits_)); }
    void store(Floats values, float* to) const {
        if constexpr (lanes <= 8)
            hn::StoreU(hn::TableLookupLanes(values, hn::IndicesFromVec(f, from_)), f, to);
        else
            hn::StoreU(hn::Compress(values, which_), f, to);
    }
    void store(Ints values, std::uint32_t* to) const {
        store(hn::BitCast(f, values), reinterpret_cast<float*>(to));
    }

  private:
    Mask which_;
    std::uint32_t bits_;
    Ints from_ = hn::Zero(n);
};

/// Of texels that hold two depths, packed, those of the upper half and those of the lower half.
[[maybe_unused]] Ints upper_half(Ints packed) {
    return hn::BitCast(n, hn::ShiftRight<16>(hn::BitCast(UintTag(), packed)));
}
[[maybe_unused]] Ints lower_half(Ints packed) {
    return hn::And(packed, hn::Set(n, 0xffff));
}
/// The larger halves of each, and the smaller ones.
#if HWY_TARGET == HWY_SCALAR
[[maybe_unused]] Ints max_of_halves(Ints a, Ints b) {
    return hn::Or(hn::ShiftLeft<16>(hn::Max(upper_half(a), upper_half(b))),
                  hn::Max(lower_half(a), lower_half(b)));
}
[[maybe_unused]] Ints min_of_halves(Ints a, Ints b) {
    return hn::Or(hn::ShiftLeft<16>(hn::Min(upper_half(a), upper_half(b))),
                  hn::Min(lower_half(a), lower_half(b)));
}
#else
constexpr hn::Repartition<std::uint16_t, IntTag> both_halves;
[[maybe_unused]] Ints max_of_halves(Ints a, Ints b) {
    return hn::BitCast(n, hn::Max(hn::BitCast(both_halves, a), hn::BitCast(both_halves, b)));
}
[[maybe_unused]] Ints min_of_halves(Ints a, Ints b) {
    return hn::BitCast(n, hn::Min(hn::BitCast(both_halves, a), hn::BitCast(both_halves, b)));
}
#endif
/// What a texel holds whose only depth this is.
[[maybe_unused]] Ints both_depths(Ints depth) {
    return hn::Or(hn::ShiftLeft<16>(depth), hn::Sub(hn::Set(n, 0xffff), depth));
}

}  // namespace
}  // namespace ir::passes::ldm::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
