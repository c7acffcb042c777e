// Queries lists of depths, which are in no order, for the 64 pixels of a tile at once.
// Read once for each instruction set, within a source that includes <hwy/foreach_target.h>.
#include <bit>

#include "renderers/passes/ldm/host/question.inl"

#if defined(IR_LDM_HOST_QUERY_LISTS) == defined(HWY_TARGET_TOGGLE)
#ifdef IR_LDM_HOST_QUERY_LISTS
#undef IR_LDM_HOST_QUERY_LISTS
#else
#define IR_LDM_HOST_QUERY_LISTS
#endif

HWY_BEFORE_NAMESPACE();
namespace ir::passes::ldm::HWY_NAMESPACE {
namespace {

using HalfTag = hn::Rebind<std::uint16_t, FloatTag>;  ///< as many lanes
using ShortTag = hn::CappedTag<std::uint16_t, 32>;    ///< full vectors
using SignedTag = hn::RebindToSigned<ShortTag>;
constexpr HalfTag halves;
constexpr ShortTag shorts;
constexpr SignedTag signed_shorts;
constexpr int short_lanes = static_cast<int>(hn::MaxLanes(ShortTag()));

/// Answer where there is no entry.
constexpr std::uint16_t none = 65535;

std::uint64_t bits_of_shorts(hn::Mask<ShortTag> mask) {
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(shorts, mask, bytes);
    const auto bits = static_cast<std::uint64_t>(bytes[0]) | static_cast<std::uint64_t>(bytes[1]) << 8 |
                      static_cast<std::uint64_t>(bytes[2]) << 16 | static_cast<std::uint64_t>(bytes[3]) << 24;
    return bits & ((std::uint64_t{1} << short_lanes) - 1);
}

/// What the 64 pixels of a tile look for in lists.
struct TileQuestion {
    alignas(64) std::uint16_t texel[pixels];
    alignas(64) std::uint16_t mirror[pixels];  ///< all bits where depths are counted backwards
    alignas(64) std::uint16_t key[pixels];
    alignas(
        64) std::uint16_t beyond[pixels];    ///< distance of the first entry beyond the key, less 1; or none
    alignas(64) std::uint16_t upto[pixels];  ///< distance down to the last entry not beyond it; or none
    std::uint64_t queries = 0;               ///< pixels

    // Of sloped lists, with the highest bit of depths turned over, so that they compare as signed numbers:
    alignas(64) std::uint16_t point[pixels];  ///< depth beyond which the surface at the point lies before it
    alignas(64) std::int16_t across[pixels], down[pixels];  ///< from the centre to the point, texels << 14
    int reach = 0;                            ///< quanta: farther beyond the key slopes are not queried
    int first_queried = 0, last_queried = 0;  ///< depths for which some pixel queries slopes
};
constexpr unsigned turned_bit = 0x8000;

void store_halves(Ints values, std::uint16_t* to) {
    hn::StoreU(hn::DemoteTo(halves, values), halves, to);
}
Floats load_halves(const std::uint16_t* from) {
    return hn::ConvertTo(f, hn::PromoteTo(n, hn::LoadU(halves, from)));
}

using Shorts = hn::Vec<ShortTag>;

/// Where a node's surface lies at the own places of the pixels of one vector.
class SlopeTest {
  public:
    SlopeTest(const StreamedMap& map, const TileQuestion& q, int first)
        : map_(map),
          q_(q),
          across_(hn::Load(signed_shorts, q.across + first)),
          down_(hn::Load(signed_shorts, q.down + first)),
          point_(hn::BitCast(signed_shorts, hn::Load(shorts, q.point + first))),
          mirror_(hn::BitCast(signed_shorts, hn::Load(shorts, q.mirror + first))) {}

    /// 0 in place of what lies ahead by its depth at the centre, but not where its slopes say it is at the
    /// point.
    Shorts ahead(Shorts by_depth, std::uint32_t node) const {
        const int depth = map_.depths[node];
        if (depth < q_.first_queried || depth > q_.last_queried) return by_depth;
        const auto zero = hn::Zero(shorts);
        const auto is_near = hn::And(
            hn::Ne(by_depth, zero),
            hn::Eq(hn::SaturatedSub(by_depth, hn::Set(shorts, static_cast<std::uint16_t>(q_.reach))), zero));
        if (hn::AllFalse(shorts, is_near)) return by_depth;
        const auto codes = map_.slopes[node];
        const auto gain = [&](unsigned code, hn::Vec<SignedTag> texels) {
            return hn::MulFixedPoint15(hn::Set(signed_shorts, map_.slope_of[code]), texels);
        };
        const auto centre = hn::BitCast(
            signed_shorts,
            hn::Set(shorts, static_cast<std::uint16_t>(static_cast<unsigned>(depth) ^ turned_bit)));
        const auto here =
            hn::SaturatedAdd(centre, hn::SaturatedAdd(gain(codes & 0xffu, across_), gain(codes >> 8, down_)));
        const auto is_before = hn::RebindMask(shorts, hn::Gt(hn::Xor(here, mirror_), point_));
        return hn::IfThenZeroElse(hn::AndNot(is_before, is_near), by_depth);
    }

  private:
    const StreamedMap& map_;
    const TileQuestion& q_;
    hn::Vec<SignedTag> across_, down_, point_, mirror_;
};

/// Of each pixel the nearest entries of its texel, beyond its key or on both sides: the entries of each texel
/// are looked at once for all pixels in it. They need not be sorted. `sloped`: slopes must agree.
template <bool both, bool sloped>
void find_nearest(const StreamedMap& map, TileQuestion& q) {
    const auto all = hn::Set(shorts, none), one = hn::Set(shorts, 1);
    for (int i = 0; i < pixels; i += short_lanes) {
        hn::Store(all, shorts, q.beyond + i);
        if constexpr (both) hn::Store(all, shorts, q.upto + i);
    }
    const auto* const depths = map.depths.data();
    for (auto left = q.queries; left != 0;) {
        const auto texel = q.texel[std::countr_zero(left)];
        const auto begin = map.begins[texel], end = map.begins[texel + 1u];
        for (int i = 0; i < pixels; i += short_lanes) {
            const auto in_texel = hn::Eq(hn::Load(shorts, q.texel + i), hn::Set(shorts, texel));
            const auto bits = bits_of_shorts(in_texel) << i;
            if ((bits & left) == 0) continue;
            left &= ~bits;
            // Where another texel is queried the key is beyond all entries, and no answer changes.
            const auto key = hn::IfThenElse(in_texel, hn::Load(shorts, q.key + i), all);
            const auto mirror = hn::Load(shorts, q.mirror + i);
            auto beyond = hn::Load(shorts, q.beyond + i);
            if constexpr (sloped) {
                const SlopeTest test(map, q, i);
                for (auto e = begin; e < end; ++e) {
                    const auto depth = hn::Xor(hn::Set(shorts, depths[e]), mirror);
                    beyond = hn::Min(beyond, hn::Sub(test.ahead(hn::SaturatedSub(depth, key), e), one));
                }
            } else if constexpr (both) {
                const auto after =
                    hn::IfThenElse(in_texel, hn::Add(hn::Load(shorts, q.key + i), one), hn::Zero(shorts));
                auto upto = hn::Load(shorts, q.upto + i);
                for (auto e = begin; e < end; ++e) {
                    const auto depth = hn::Xor(hn::Set(shorts, depths[e]), mirror);
                    beyond = hn::Min(beyond, hn::Sub(hn::SaturatedSub(depth, key), one));
                    upto = hn::Min(upto, hn::Sub(hn::SaturatedSub(after, depth), one));
                }
                hn::Store(upto, shorts, q.upto + i);
            } else {
                for (auto e = begin; e < end; ++e) {
                    const auto depth = hn::Xor(hn::Set(shorts, depths[e]), mirror);
                    beyond = hn::Min(beyond, hn::Sub(hn::SaturatedSub(depth, key), one));
                }
            }
            hn::Store(beyond, shorts, q.beyond + i);
        }
    }
}

/// The question of a whole tile, with what the answers are worked out from.
struct TileState {
    TileQuestion q;
    alignas(64) float cosine[pixels], plane[pixels], tolerance[pixels];
    std::uint64_t forward = 0, above = 0, open = 0;  ///< pixels; open: outside of the map
};

Mask lanes_of(std::uint64_t bits, int first) {
    std::uint8_t bytes[8] = {};
    const auto some = bits >> first;
    bytes[0] = static_cast<std::uint8_t>(some);
    bytes[1] = static_cast<std::uint8_t>(some >> 8);
    return hn::LoadMaskBits(f, bytes);
}

void store_key(TileQuestion& q, int first, Ints key, Mask mirrored) {
    store_halves(key, q.key + first);
    const auto bits = hn::IfThenElseZero(hn::RebindMask(n, mirrored), hn::Set(n, 0xffff));
    store_halves(bits, q.mirror + first);
}

/// Fills in what slopes are queried with, a vector of a tile's pixels at a time.
class SlopeQuestion {
  public:
    SlopeQuestion(TileQuestion& q, const QueriedMap& queried, const SelfHitRule& rule)
        : q_(q), queried_(queried), rule_(rule), least_(hn::Set(f, 65535)), most_(hn::Zero(f)) {}

    void add(int first, const Question& q) {
        const auto tolerance = hn::Add(hn::Set(f, rule_.quanta), slope_tolerance(q));
        const auto point =
            hn::Xor(key_of(hn::Add(q.own, tolerance)), hn::Set(n, static_cast<int>(turned_bit)));
        store_halves(point, q_.point + first);
        store_fixed(q.to_u, q_.across + first);
        store_fixed(q.to_v, q_.down + first);
        const auto queries = hn::And(q.above, q.here);
        const auto start = along(q.forward, q.start);
        least_ = hn::Min(least_, hn::IfThenElse(queries, start, least_));
        most_ = hn::Max(most_, hn::IfThenElse(queries, start, most_));
    }
    void finish() {
        q_.reach = slope_reach_quanta(queried_.texel_quanta);
        const auto reach = static_cast<float>(q_.reach + 2);
        q_.first_queried =
            static_cast<int>(std::clamp(hn::GetLane(hn::MinOfLanes(f, least_)) - reach, 0.0f, 65535.0f));
        q_.last_queried =
            static_cast<int>(std::clamp(hn::GetLane(hn::MaxOfLanes(f, most_)) + reach, 0.0f, 65535.0f));
    }

  private:
    /// ldm_slope_tolerance()
    Floats slope_tolerance(const Question& q) const {
        const auto part = [&](Floats slope, Floats place) {
            const auto widening =
                hn::MulAdd(hn::Abs(slope), hn::Set(f, 1 / queried_.texel_quanta), hn::Set(f, 1));
            return hn::Mul(hn::Abs(place), hn::Mul(widening, widening));
        };
        const auto steps = hn::Add(part(q.slant.per_column, q.to_u), part(q.slant.per_row, q.to_v));
        const auto texels = hn::Mul(steps, hn::Set(f, 1 / (2 * ldm_slope_steps)));
        return hn::Mul(hn::Set(f, queried_.texel_quanta), hn::Min(texels, hn::Set(f, 1)));
    }
    /// From the way to the centre.
    static void store_fixed(Floats to_centre, std::int16_t* to) {
        constexpr hn::RebindToSigned<HalfTag> signed_halves;
        const auto fixed = hn::NearestInt(hn::Mul(to_centre, hn::Set(f, -16384.0f)));
        hn::StoreU(hn::DemoteTo(signed_halves, fixed), signed_halves, to);
    }

    TileQuestion& q_;
    const QueriedMap& queried_;
    const SelfHitRule& rule_;
    Floats least_, most_;
};

/// Queries for all pixels of a tile; false: none has a question for this band.
bool query_tile(TileState& state, const PixelTiles& tiles, std::size_t tile, const QueriedMap& queried,
                const SelfHitRule& rule) {
    state.q.queries = state.forward = state.above = state.open = 0;
    const bool is_sloped = queried.map.holds == Holds::sloped_lists;
    SlopeQuestion slopes(state.q, queried, rule);
    for (int i = 0; i < pixels; i += lanes) {
        const auto q = question(tiles, tile * pixels + static_cast<std::size_t>(i), queried, rule);
        state.forward |= std::uint64_t{bits_of(q.forward)} << i;
        state.above |= std::uint64_t{bits_of(q.above)} << i;
        if (queried.map.first_row == 0)
            state.open |= std::uint64_t{bits_of(hn::And(q.above, q.outside))} << i;
        state.q.queries |= std::uint64_t{bits_of(hn::And(q.above, q.here))} << i;
        hn::Store(q.cosine, f, state.cosine + i);
        hn::Store(q.plane, f, state.plane + i);
        hn::Store(q.tolerance, f, state.tolerance + i);
        store_halves(q.texel, state.q.texel + i);
        // Normal offset: entries below ceil(plane) lie before it.
        const auto key =
            rule.tangent_plane ? key_of(q.start) : key_of(hn::Sub(hn::Ceil(q.plane), hn::Set(f, 1)));
        store_key(state.q, i, key, rule.tangent_plane ? hn::Not(q.forward) : hn::Ne(q.cosine, q.cosine));
        if (is_sloped) slopes.add(i, q);
    }
    if (is_sloped) slopes.finish();
    return state.q.queries != 0;
}

/// Normal offset: from the nearest entries before and behind the plane to the first one beyond the nearer of
/// them, along ω. What is found counts from there: `plane` becomes the own entry's depth.
void go_on_from_own(TileState& state, const StreamedMap& map) {
    find_nearest<true, false>(map, state.q);
    std::uint64_t found = 0;
    for (int i = 0; i < pixels; i += lanes) {
        const auto far = hn::Set(f, 1e6f), missing = hn::Set(f, none);
        const auto key = load_halves(state.q.key + i), beyond = load_halves(state.q.beyond + i),
                   upto = load_halves(state.q.upto + i), plane = hn::Load(f, state.plane + i);
        const auto behind =
            hn::IfThenElse(hn::Eq(beyond, missing), far, hn::Add(hn::Add(key, beyond), hn::Set(f, 1)));
        const auto before = hn::IfThenElse(hn::Eq(upto, missing), hn::Neg(far), hn::Sub(key, upto));
        const auto before_is_own = hn::Lt(hn::Sub(plane, before), hn::Sub(behind, plane));
        const auto own = hn::IfThenElse(before_is_own, before, behind);
        const auto has_own = hn::Lt(hn::Abs(own), far);
        found |= std::uint64_t{bits_of(has_own)} << i;
        const auto forward = lanes_of(state.forward, i);
        hn::Store(hn::Sub(hn::IfThenElse(forward, own, hn::Neg(own)),
                          hn::IfThenElse(forward, plane, hn::Neg(plane))),
                  f, state.tolerance + i);  // how far ahead of the plane it is
        const auto depth = along(forward, hn::IfThenElseZero(has_own, own));
        hn::Store(depth, f, state.plane + i);
        store_key(state.q, i, key_of(depth), hn::Not(forward));
    }
    found &= state.q.queries;
    state.open |= state.q.queries & ~found;
    state.q.queries = found;
    find_nearest<false, false>(map, state.q);
}

/// Finds what a tile's pixels look for. False: no pixel has an answer in this band of rows.
bool find_in_lists(TileState& state, const PixelTiles& tiles, std::size_t tile, const QueriedMap& queried,
                   const SelfHitRule& rule) {
    if (query_tile(state, tiles, tile, queried, rule)) {
        if (queried.map.holds == Holds::sloped_lists)
            find_nearest<false, true>(queried.map, state.q);
        else if (rule.tangent_plane)
            find_nearest<false, false>(queried.map, state.q);
        else
            go_on_from_own(state, queried.map);
    }
    return (state.q.queries | state.open) != 0;
}

/// From the plane to what was found, `beyond` the key; quanta along ω.
Floats distance_of(const TileState& state, int first, Floats beyond) {
    const auto key = load_halves(state.q.key + first), plane = hn::Load(f, state.plane + first);
    return hn::Sub(hn::Add(hn::Add(key, beyond), hn::Set(f, 1)), plane);
}

/// Visibility of what was found.
void add_answers(const TileState& state, const QueriedMap& queried, const Visibility& visibility, float scale,
                 std::uint32_t* sums) {
    const auto one = hn::Set(f, 1), zero = hn::Zero(f);
    const auto per_reach =
        hn::Set(f, visibility.smooth && visibility.max_distance > 0 ? 1 / queried.reach : 0.0f);
    for (int i = 0; i < pixels; i += lanes) {
        const auto counts = lanes_of(state.q.queries | state.open, i);
        if (hn::AllFalse(f, counts)) continue;
        const auto beyond = load_halves(state.q.beyond + i), distance = distance_of(state, i, beyond);
        const auto found =
            hn::And(lanes_of(state.q.queries, i),
                    hn::And(hn::Ne(beyond, hn::Set(f, none)), hn::Lt(distance, hn::Set(f, queried.reach))));
        const auto part = hn::Mul(hn::Max(distance, zero), per_reach);
        const auto open = hn::IfThenElse(found, hn::Mul(part, part), one);
        add(sums + i, part_of_sum(open, hn::Load(f, state.cosine + i), scale), counts);
    }
}

void query_lists(const PixelTiles& tiles, std::size_t tile, const QueriedMap& queried,
                 const SelfHitRule& rule, const Visibility& visibility, float scale, TileState& state,
                 std::uint32_t* sums) {
    if (find_in_lists(state, tiles, tile, queried, rule))
        add_answers(state, queried, visibility, scale, sums);
}

}  // namespace
}  // namespace ir::passes::ldm::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
