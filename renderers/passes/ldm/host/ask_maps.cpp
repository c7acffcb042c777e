// Asks maps that are in memory for the pixels of a picture, many pixels at a time. The same questions and
// rules as shaders/passes/ldm/trace.glsl, whose names are used here. [Aalund15 §3.1]
#include <algorithm>
#include <bit>
#include <cmath>

#include "renderers/passes/ldm/host/streamed_map.h"
#include "renderers/passes/ldm/host/vectors.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "renderers/passes/ldm/host/ask_maps.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace ir::passes::ldm::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using FloatTag = hn::CappedTag<float, 16>;
using IntTag = hn::RebindToSigned<FloatTag>;
using HalfTag = hn::Rebind<std::uint16_t, FloatTag>;  ///< as many lanes
using ShortTag = hn::CappedTag<std::uint16_t, 32>;    ///< full vectors
using Floats = hn::Vec<FloatTag>;
using Ints = hn::Vec<IntTag>;
using Mask = hn::Mask<FloatTag>;

constexpr FloatTag f;
constexpr IntTag n;
constexpr HalfTag halves;
constexpr ShortTag shorts;
constexpr int lanes = static_cast<int>(hn::MaxLanes(FloatTag()));
constexpr int short_lanes = static_cast<int>(hn::MaxLanes(ShortTag()));
constexpr int pixels = PixelTiles::pixels;

/// As in trace.glsl.
constexpr float least_facing = 0.02f, most_tolerance = 1.5f, near_plane = 1.5f;
/// Beyond all entries, which are less.
constexpr int last_key = 65534;
/// Answer where there is no entry.
constexpr std::uint16_t none = 65535;

struct Vector3 {
    Floats x, y, z;
};

Floats dot(const Vector3& a, const glm::vec4& b) {
    return hn::MulAdd(a.z, hn::Set(f, b.z), hn::MulAdd(a.y, hn::Set(f, b.y), hn::Mul(a.x, hn::Set(f, b.x))));
}
/// dot(a, b.xyz) + b.w
Floats project(const Vector3& a, const glm::vec4& b) {
    return hn::MulAdd(a.z, hn::Set(f, b.z),
                      hn::MulAdd(a.y, hn::Set(f, b.y), hn::MulAdd(a.x, hn::Set(f, b.x), hn::Set(f, b.w))));
}

Vector3 load(const std::vector<float> (&axes)[3], std::size_t place) {
    return {hn::LoadU(f, axes[0].data() + place), hn::LoadU(f, axes[1].data() + place),
            hn::LoadU(f, axes[2].data() + place)};
}

std::uint64_t bits_of(Mask mask) {
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(f, mask, bytes);
    const auto bits = static_cast<std::uint64_t>(bytes[0] | bytes[1] << 8);
    return bits & ((std::uint64_t{1} << lanes) - 1);
}
std::uint64_t bits_of_shorts(hn::Mask<ShortTag> mask) {
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(shorts, mask, bytes);
    const auto bits = static_cast<std::uint64_t>(bytes[0]) | static_cast<std::uint64_t>(bytes[1]) << 8 |
                      static_cast<std::uint64_t>(bytes[2]) << 16 | static_cast<std::uint64_t>(bytes[3]) << 24;
    return bits & ((std::uint64_t{1} << short_lanes) - 1);
}

/// What does not change within a map.
struct Asked {
    const StreamedMap& map;
    glm::vec4 slope_u, slope_v;  ///< step / metres per quantum
    float texel_quanta, texel_size, reach;
    explicit Asked(const StreamedMap& of, const Visibility& visibility) : map(of) {
        const auto& frame = of.frame;
        slope_u = frame.step_u / frame.direction.w;
        slope_v = frame.step_v / frame.direction.w;
        texel_size = std::max(glm::length(glm::vec3(frame.step_u)), glm::length(glm::vec3(frame.step_v)));
        texel_quanta = texel_size / frame.direction.w;
        reach = visibility.max_distance > 0 ? visibility.max_distance / frame.direction.w
                                            : std::numeric_limits<float>::infinity();
    }
};

/// What some pixels ask a map. Depths are counted along ω, from 65535 backwards for -v.
struct Question {
    Floats cosine;        ///< |cosθ| of the shading normal
    Mask forward, above;  ///< ω = v; ω is above the surface
    Mask outside;         ///< of the map: open
    Mask here;            ///< the texel is of this band
    Ints texel;           ///< of the band, where `here`
    Floats plane, start;  ///< depth from which distances count; depth beyond which entries are hits
    Floats tolerance;
};

Floats along(Mask forward, Floats depth) {
    return hn::IfThenElse(forward, depth, hn::Sub(hn::Set(f, 65535), depth));
}

/// Whether column and row are not texels of the map.
Mask is_outside(Floats column, Floats row, float resolution) {
    const auto zero = hn::Zero(f), end = hn::Set(f, resolution);
    return hn::Or(hn::Or(hn::Lt(column, zero), hn::Ge(column, end)),
                  hn::Or(hn::Lt(row, zero), hn::Ge(row, end)));
}

void set_texel(Question& q, const Asked& asked, Floats column, Floats row) {
    const auto resolution = static_cast<float>(asked.map.resolution);
    const auto first = hn::Set(f, static_cast<float>(asked.map.first_row)),
               end = hn::Set(f, static_cast<float>(asked.map.first_row + asked.map.rows));
    q.outside = is_outside(column, row, resolution);
    q.here = hn::AndNot(q.outside, hn::And(hn::Ge(row, first), hn::Lt(row, end)));
    const auto texel = hn::MulAdd(hn::Sub(row, first), hn::Set(f, resolution), column);
    q.texel = hn::ConvertTo(n, hn::IfThenElseZero(q.here, texel));
}

/// ldm_question_tangent
void ask_tangent(Question& q, const Asked& asked, const SelfHitRule& rule, const Vector3& position,
                 const Vector3& normal, Floats facing) {
    const auto& frame = asked.map.frame;
    const auto zero = hn::Zero(f), one = hn::Set(f, 1), half = hn::Set(f, 0.5f);
    const auto u = project(position, frame.u), v = project(position, frame.v),
               depth = project(position, frame.depth);
    auto column = hn::Floor(u), row = hn::Floor(v);
    const auto resolution = static_cast<float>(asked.map.resolution);
    const auto begins_outside = is_outside(column, row, resolution);
    const auto per_facing = hn::Div(hn::Set(f, -1), hn::Max(hn::Abs(facing), hn::Set(f, least_facing)));
    const auto slope_u = hn::Mul(dot(normal, asked.slope_u), per_facing),
               slope_v = hn::Mul(dot(normal, asked.slope_v), per_facing);
    auto to_u = hn::Sub(hn::Add(column, half), u), to_v = hn::Sub(hn::Add(row, half), v);
    auto gain = hn::MulAdd(slope_u, to_u, hn::Mul(slope_v, to_v));
    const auto dips = hn::AndNot(begins_outside, hn::Gt(gain, hn::Set(f, rule.max_dip * asked.texel_quanta)));
    if (!hn::AllFalse(f, dips)) {
        const auto along_u = hn::Gt(hn::Abs(slope_u), hn::Abs(slope_v));
        const auto back_u =
            hn::IfThenElseZero(along_u, hn::IfThenElse(hn::Gt(slope_u, zero), hn::Neg(one), one));
        const auto back_v =
            hn::IfThenZeroElse(along_u, hn::IfThenElse(hn::Gt(slope_v, zero), hn::Neg(one), one));
        const auto moves =
            hn::AndNot(is_outside(hn::Add(column, back_u), hn::Add(row, back_v), resolution), dips);
        column = hn::Add(column, hn::IfThenElseZero(moves, back_u));
        row = hn::Add(row, hn::IfThenElseZero(moves, back_v));
        to_u = hn::Add(to_u, hn::IfThenElseZero(moves, back_u));
        to_v = hn::Add(to_v, hn::IfThenElseZero(moves, back_v));
        gain = hn::IfThenElse(moves, hn::MulAdd(slope_u, to_u, hn::Mul(slope_v, to_v)), gain);
    }
    const auto slope = hn::Add(hn::Abs(slope_u), hn::Abs(slope_v));
    q.tolerance = hn::Add(hn::Set(f, rule.quanta), hn::Min(hn::Mul(hn::Set(f, rule.slope), slope),
                                                           hn::Set(f, most_tolerance * asked.texel_quanta)));
    const auto own = along(q.forward, depth);
    q.plane = hn::Add(own, gain);
    q.start = hn::Add(own, hn::Max(hn::Add(gain, q.tolerance), zero));
    set_texel(q, asked, column, row);
}

/// ldm_question_offset
void ask_offset(Question& q, const Asked& asked, const SelfHitRule& rule, const Vector3& position,
                const Vector3& normal, Floats facing) {
    const auto& frame = asked.map.frame;
    const auto sine = hn::Sqrt(hn::Max(hn::Zero(f), hn::NegMulAdd(facing, facing, hn::Set(f, 1))));
    const auto distance = hn::Mul(hn::Set(f, rule.offset * asked.texel_size), sine);
    const Vector3 moved{hn::MulAdd(distance, normal.x, position.x),
                        hn::MulAdd(distance, normal.y, position.y),
                        hn::MulAdd(distance, normal.z, position.z)};
    q.tolerance = hn::Zero(f);
    q.plane = q.start = project(moved, frame.depth);  // along v: the rule looks both ways
    set_texel(q, asked, hn::Floor(project(moved, frame.u)), hn::Floor(project(moved, frame.v)));
}

Question question(const PixelTiles& tiles, std::size_t place, const Asked& asked, const SelfHitRule& rule) {
    Question q;
    const auto zero = hn::Zero(f);
    const auto geometric_normal = load(tiles.geometric_normal, place);
    const auto cosine = dot(load(tiles.normal, place), asked.map.frame.direction);
    const auto facing = dot(geometric_normal, asked.map.frame.direction);
    q.cosine = hn::Abs(cosine);
    q.forward = hn::Gt(cosine, zero);
    q.above =
        hn::Or(hn::And(q.forward, hn::Gt(facing, zero)), hn::And(hn::Lt(cosine, zero), hn::Lt(facing, zero)));
    const auto position = load(tiles.position, place);
    if (rule.tangent_plane)
        ask_tangent(q, asked, rule, position, geometric_normal, facing);
    else
        ask_offset(q, asked, rule, position, geometric_normal, facing);
    return q;
}

/// The part of a whole sum that V cosθ is.
Ints part_of_sum(Floats open, Floats cosine, float scale) {
    return hn::NearestInt(hn::Mul(hn::Mul(open, cosine), hn::Set(f, scale)));
}

void add(std::uint32_t* sums, Ints part, Mask which) {
    auto* to = reinterpret_cast<std::int32_t*>(sums);
    hn::StoreU(hn::Add(hn::LoadU(n, to), hn::IfThenElseZero(hn::RebindMask(n, which), part)), n, to);
}

/// floor(depth), as a key: entries beyond it are hits.
Ints key_of(Floats depth) {
    return hn::ConvertTo(n, hn::Floor(hn::Min(hn::Max(depth, hn::Zero(f)), hn::Set(f, last_key))));
}

/// Whether anything lies beyond the start, from the outermost depths.
void ask_outermost(const PixelTiles& tiles, std::size_t tile, const Asked& asked, const SelfHitRule& rule,
                   float scale, std::uint32_t* sums) {
    const auto* const map = reinterpret_cast<const std::int32_t*>(asked.map.outermost.data());
    const auto low_half = hn::Set(n, 0xffff);
    for (int i = 0; i < pixels; i += lanes) {
        const auto q = question(tiles, tile * pixels + static_cast<std::size_t>(i), asked, rule);
        const auto asks = hn::And(q.above, q.here);
        auto open = hn::And(q.above, q.outside);
        if (asked.map.first_row > 0) open = hn::And(open, hn::Ne(q.cosine, q.cosine));
        const auto texel = hn::GatherIndex(n, map, q.texel);
        const hn::RebindToUnsigned<IntTag> unsigned_tag;
        const auto far = hn::BitCast(n, hn::ShiftRight<16>(hn::BitCast(unsigned_tag, texel)));
        const auto outermost = hn::IfThenElse(hn::RebindMask(n, q.forward), far, hn::And(texel, low_half));
        const auto hit = hn::RebindMask(f, hn::Gt(outermost, key_of(q.start)));
        open = hn::Or(open, hn::AndNot(hit, asks));
        if (hn::AllFalse(f, open)) continue;
        add(sums + i, part_of_sum(hn::Set(f, 1), q.cosine, scale), open);
    }
}

/// Least and largest dot product with the vectors in boxes of tiles first … first + lanes - 1.
struct Range {
    Floats least, most;
};
Range range_of(const PixelTiles::Boxes& boxes, std::size_t first, const glm::vec4& row, float added) {
    auto middle = hn::Set(f, added), reach = hn::Zero(f);
    for (int axis = 0; axis < 3; ++axis) {
        middle = hn::MulAdd(hn::LoadU(f, boxes.centre[axis].data() + first), hn::Set(f, row[axis]), middle);
        reach =
            hn::MulAdd(hn::LoadU(f, boxes.half[axis].data() + first), hn::Set(f, std::abs(row[axis])), reach);
    }
    return {hn::Sub(middle, reach), hn::Add(middle, reach)};
}
Floats largest(const Range& range) {
    return hn::Max(hn::Abs(range.least), hn::Abs(range.most));
}

/// What is known of tiles of pixels without asking any of them, as bits.
struct Verdict {
    std::uint32_t nothing = 0;  ///< no pixel gets light from this band
    std::uint32_t open = 0;     ///< all pixels are open
};

/// Judges tiles first … first + lanes - 1 by the outermost depths of all texels that they may ask: no depth
/// reaches beyond what is largest, and all reach beyond what is least. Rounding is covered by margins.
Verdict judge(const PixelTiles& tiles, std::size_t first, const Asked& asked, const SelfHitRule& rule) {
    constexpr float texel_margin = 0.01f;
    constexpr int most_texels = 6;  // a side
    const auto& map = asked.map;
    const auto& frame = map.frame;
    const auto zero = hn::Zero(f), one = hn::Set(f, 1);
    const auto cosine = range_of(tiles.normal_boxes, first, frame.direction, 0),
               facing = range_of(tiles.geometric_normal_boxes, first, frame.direction, 0);
    const auto forward = hn::And(hn::Gt(cosine.least, zero), hn::Gt(facing.least, zero)),
               backward = hn::And(hn::Lt(cosine.most, zero), hn::Lt(facing.most, zero));
    const auto below = hn::Or(hn::And(hn::Gt(cosine.least, zero), hn::Le(facing.most, zero)),
                              hn::And(hn::Lt(cosine.most, zero), hn::Ge(facing.least, zero)));
    const auto u = range_of(tiles.position_boxes, first, frame.u, frame.u.w),
               v = range_of(tiles.position_boxes, first, frame.v, frame.v.w),
               depth = range_of(tiles.position_boxes, first, frame.depth, frame.depth.w);
    // The largest gain and tolerance of ask_tangent.
    const auto least_abs_facing =
        hn::Max(hn::Set(f, least_facing), hn::IfThenElse(forward, facing.least, hn::Neg(facing.most)));
    const auto slope =
        hn::Div(hn::Add(largest(range_of(tiles.geometric_normal_boxes, first, asked.slope_u, 0)),
                        largest(range_of(tiles.geometric_normal_boxes, first, asked.slope_v, 0))),
                least_abs_facing);
    const auto dip = hn::Set(f, rule.max_dip * asked.texel_quanta),
               half_slope = hn::Mul(slope, hn::Set(f, 0.505f));
    const auto tolerance = hn::Add(
        hn::Set(f, rule.quanta),
        hn::Min(hn::Mul(hn::Set(f, rule.slope), slope), hn::Set(f, most_tolerance * asked.texel_quanta)));
    const auto gain = hn::Add(hn::Min(half_slope, dip), tolerance);
    // The texels that may be asked: where rays may dip, neighbours too.
    const auto margin = hn::Add(hn::Set(f, texel_margin), hn::IfThenElseZero(hn::Gt(half_slope, dip), one));
    const auto left = hn::Floor(hn::Sub(u.least, margin)), right = hn::Floor(hn::Add(u.most, margin)),
               top = hn::Floor(hn::Sub(v.least, margin)), bottom = hn::Floor(hn::Add(v.most, margin));
    const auto first_row = hn::Set(f, static_cast<float>(map.first_row)),
               end_row = hn::Set(f, static_cast<float>(map.first_row + map.rows)),
               end = hn::Set(f, static_cast<float>(map.resolution));
    Verdict verdict;
    auto nothing = below;
    // Pixels outside of the map count with its first band.
    if (map.first_row > 0 || map.rows < map.resolution) {
        const auto inside = hn::And(hn::And(hn::Ge(left, one), hn::Lt(right, hn::Sub(end, one))),
                                    hn::And(hn::Ge(top, one), hn::Lt(bottom, hn::Sub(end, one))));
        nothing = hn::Or(nothing, hn::And(inside, hn::Or(hn::Lt(hn::Add(bottom, one), first_row),
                                                         hn::Gt(hn::Sub(top, one), end_row))));
    }
    const auto columns = hn::Sub(right, left), rows = hn::Sub(bottom, top);
    auto known = hn::And(hn::Or(forward, backward), hn::Lt(hn::Max(columns, rows), hn::Set(f, most_texels)));
    known = hn::And(known, hn::And(hn::And(hn::Ge(left, zero), hn::Lt(right, end)),
                                   hn::And(hn::Ge(top, first_row), hn::Lt(bottom, end_row))));
    if (!hn::AllFalse(f, known)) {
        const auto* const texels = reinterpret_cast<const std::int32_t*>(map.outermost.data());
        const auto base =
            hn::ConvertTo(n, hn::IfThenElseZero(known, hn::MulAdd(hn::Sub(top, first_row), end, left)));
        const auto low_half = hn::Set(n, 0xffff);
        const hn::RebindToUnsigned<IntTag> unsigned_tag;
        auto least = hn::Set(n, 0xffff), most = hn::Zero(n);
        for (int y = 0; y < most_texels; ++y) {
            const auto in_rows = hn::And(known, hn::Ge(rows, hn::Set(f, static_cast<float>(y))));
            if (hn::AllFalse(f, in_rows)) break;
            for (int x = 0; x < most_texels; ++x) {
                const auto in_both = hn::And(in_rows, hn::Ge(columns, hn::Set(f, static_cast<float>(x))));
                if (hn::AllFalse(f, in_both)) break;
                const auto which = hn::RebindMask(n, in_both);
                const auto place =
                    hn::Add(base, hn::IfThenElseZero(which, hn::Set(n, y * map.resolution + x)));
                const auto texel = hn::GatherIndex(n, texels, place);
                const auto far = hn::BitCast(n, hn::ShiftRight<16>(hn::BitCast(unsigned_tag, texel)));
                const auto outermost =
                    hn::IfThenElse(hn::RebindMask(n, forward), far, hn::And(texel, low_half));
                least = hn::Min(least, hn::IfThenElse(which, outermost, low_half));
                most = hn::Max(most, hn::IfThenElseZero(which, outermost));
            }
        }
        const auto own_least = hn::IfThenElse(forward, depth.least, hn::Sub(hn::Set(f, 65535), depth.most)),
                   own_most = hn::IfThenElse(forward, depth.most, hn::Sub(hn::Set(f, 65535), depth.least));
        const auto start = hn::Add(hn::Add(own_most, hn::Max(gain, zero)), one);
        nothing = hn::Or(nothing, hn::And(known, hn::Gt(hn::ConvertTo(f, least), start)));
        const auto open = hn::And(known, hn::Lt(hn::ConvertTo(f, most), hn::Sub(own_least, one)));
        verdict.open = static_cast<std::uint32_t>(bits_of(open));
    }
    verdict.nothing = static_cast<std::uint32_t>(bits_of(nothing));
    return verdict;
}

/// All of a tile's pixels are open.
void add_open(const PixelTiles& tiles, std::size_t tile, const Asked& asked, float scale,
              std::uint32_t* sums) {
    for (int i = 0; i < pixels; i += lanes) {
        const auto cosine = hn::Abs(
            dot(load(tiles.normal, tile * pixels + static_cast<std::size_t>(i)), asked.map.frame.direction));
        auto* to = reinterpret_cast<std::int32_t*>(sums) + i;
        hn::StoreU(hn::Add(hn::LoadU(n, to), part_of_sum(hn::Set(f, 1), cosine, scale)), n, to);
    }
}

/// What the 64 pixels of a tile ask of lists, and what they are told.
struct TileQuestion {
    alignas(64) std::uint16_t texel[pixels];
    alignas(64) std::uint16_t mirror[pixels];  ///< all bits where depths are counted backwards
    alignas(64) std::uint16_t key[pixels];
    alignas(
        64) std::uint16_t beyond[pixels];    ///< distance of the first entry beyond the key, less 1; or none
    alignas(64) std::uint16_t upto[pixels];  ///< distance down to the last entry not beyond it; or none
    std::uint64_t asks = 0;                  ///< pixels
};

void store_halves(Ints values, std::uint16_t* to) {
    const hn::RebindToUnsigned<IntTag> unsigned_tag;
    (void)unsigned_tag;
    hn::StoreU(hn::DemoteTo(halves, values), halves, to);
}
Floats load_halves(const std::uint16_t* from) {
    return hn::ConvertTo(f, hn::PromoteTo(n, hn::LoadU(halves, from)));
}

/// Of each pixel the nearest entries of its texel, on one side or on both: the entries of each texel are
/// looked at once for all pixels in it. They need not be sorted.
template <bool both>
void find_nearest(const StreamedMap& map, TileQuestion& q) {
    const auto all = hn::Set(shorts, none), one = hn::Set(shorts, 1);
    for (int i = 0; i < pixels; i += short_lanes) {
        hn::Store(all, shorts, q.beyond + i);
        if constexpr (both) hn::Store(all, shorts, q.upto + i);
    }
    const auto* const depths = map.depths.data();
    for (auto left = q.asks; left != 0;) {
        const auto texel = q.texel[std::countr_zero(left)];
        const auto begin = map.begins[texel], end = map.begins[texel + 1u];
        for (int i = 0; i < pixels; i += short_lanes) {
            const auto in_texel = hn::Eq(hn::Load(shorts, q.texel + i), hn::Set(shorts, texel));
            const auto bits = bits_of_shorts(in_texel) << i;
            if ((bits & left) == 0) continue;
            left &= ~bits;
            // Where another texel is asked the key is beyond all entries, and no answer changes.
            const auto key = hn::IfThenElse(in_texel, hn::Load(shorts, q.key + i), all);
            const auto mirror = hn::Load(shorts, q.mirror + i);
            auto beyond = hn::Load(shorts, q.beyond + i);
            if constexpr (both) {
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

/// Asks for all pixels of a tile; false: none has a question for this band.
bool ask_tile(TileState& state, const PixelTiles& tiles, std::size_t tile, const Asked& asked,
              const SelfHitRule& rule) {
    state.q.asks = state.forward = state.above = state.open = 0;
    for (int i = 0; i < pixels; i += lanes) {
        const auto q = question(tiles, tile * pixels + static_cast<std::size_t>(i), asked, rule);
        state.forward |= bits_of(q.forward) << i;
        state.above |= bits_of(q.above) << i;
        if (asked.map.first_row == 0) state.open |= bits_of(hn::And(q.above, q.outside)) << i;
        state.q.asks |= bits_of(hn::And(q.above, q.here)) << i;
        hn::Store(q.cosine, f, state.cosine + i);
        hn::Store(q.plane, f, state.plane + i);
        hn::Store(q.tolerance, f, state.tolerance + i);
        store_halves(q.texel, state.q.texel + i);
        // Normal offset: entries below ceil(plane) lie before it.
        const auto key =
            rule.tangent_plane ? key_of(q.start) : key_of(hn::Sub(hn::Ceil(q.plane), hn::Set(f, 1)));
        store_key(state.q, i, key, rule.tangent_plane ? hn::Not(q.forward) : hn::Ne(q.cosine, q.cosine));
    }
    return state.q.asks != 0;
}

/// Normal offset: from the nearest entries before and behind the plane to the first one beyond the nearer of
/// them, along ω. What is found counts from there: `plane` becomes the own entry's depth. Returns the pixels
/// that have an own entry.
std::uint64_t go_on_from_own(TileState& state, const StreamedMap& map) {
    find_nearest<true>(map, state.q);
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
        found |= bits_of(has_own) << i;
        const auto forward = lanes_of(state.forward, i);
        hn::Store(hn::Sub(hn::IfThenElse(forward, own, hn::Neg(own)),
                          hn::IfThenElse(forward, plane, hn::Neg(plane))),
                  f, state.tolerance + i);  // how far ahead of the plane it is
        const auto depth = along(forward, hn::IfThenElseZero(has_own, own));
        hn::Store(depth, f, state.plane + i);
        store_key(state.q, i, key_of(depth), hn::Not(forward));
    }
    found &= state.q.asks;
    state.open |= state.q.asks & ~found;
    state.q.asks = found;
    find_nearest<false>(map, state.q);
    return found;
}

/// Visibility of what was found.
void add_answers(const TileState& state, const Asked& asked, const Visibility& visibility, float scale,
                 std::uint32_t* sums) {
    const auto one = hn::Set(f, 1), zero = hn::Zero(f);
    const auto per_reach =
        hn::Set(f, visibility.smooth && visibility.max_distance > 0 ? 1 / asked.reach : 0.0f);
    for (int i = 0; i < pixels; i += lanes) {
        const auto counts = lanes_of(state.q.asks | state.open, i);
        if (hn::AllFalse(f, counts)) continue;
        const auto beyond = load_halves(state.q.beyond + i), key = load_halves(state.q.key + i);
        const auto distance = hn::Sub(hn::Add(hn::Add(key, beyond), one), hn::Load(f, state.plane + i));
        const auto found =
            hn::And(lanes_of(state.q.asks, i),
                    hn::And(hn::Ne(beyond, hn::Set(f, none)), hn::Lt(distance, hn::Set(f, asked.reach))));
        const auto part = hn::Mul(hn::Max(distance, zero), per_reach);
        const auto open = hn::IfThenElse(found, hn::Mul(part, part), one);
        add(sums + i, part_of_sum(open, hn::Load(f, state.cosine + i), scale), counts);
    }
}

void ask_lists(const PixelTiles& tiles, std::size_t tile, const Asked& asked, const SelfHitRule& rule,
               const Visibility& visibility, float scale, TileState& state, std::uint32_t* sums) {
    const bool asks = ask_tile(state, tiles, tile, asked, rule);
    if (asks && rule.tangent_plane)
        find_nearest<false>(asked.map, state.q);
    else if (asks)
        go_on_from_own(state, asked.map);
    if (asks || state.open != 0) add_answers(state, asked, visibility, scale, sums);
}

}  // namespace

void visibility_sums(const PixelTiles& tiles, std::size_t first, std::size_t end,
                     std::span<const StreamedMap> maps, const SelfHitRule& rule, const Visibility& visibility,
                     float scale, std::uint32_t* sums) {
    TileState state;
    std::vector<Asked> all;
    for (const auto& map : maps) all.emplace_back(map, visibility);
    for (auto group = first; group < end; group += lanes) {
        const auto group_end = std::min(end, group + lanes);
        for (const auto& asked : all) {
            const bool keeps_outermost = asked.map.holds == Holds::outermost;
            const auto verdict = keeps_outermost ? judge(tiles, group, asked, rule) : Verdict{};
            for (auto tile = group; tile < group_end; ++tile) {
                const auto bit = tile - group;
                if (tiles.valid[tile] == 0 || (verdict.nothing >> bit & 1) != 0) continue;
                auto* const to = sums + tile * pixels;
                if ((verdict.open >> bit & 1) != 0)
                    add_open(tiles, tile, asked, scale, to);
                else if (keeps_outermost)
                    ask_outermost(tiles, tile, asked, rule, scale, to);
                else
                    ask_lists(tiles, tile, asked, rule, visibility, scale, state, to);
            }
        }
    }
}

void self_hits(const PixelTiles& tiles, std::span<const StreamedMap> maps, const SelfHitRule& rule,
               SelfHitCounts& counts) {
    TileState state;
    for (const auto& map : maps) {
        const Asked asked(map, {});
        for (std::size_t tile = 0; tile < tiles.count(); ++tile) {
            if (tiles.valid[tile] == 0 || !ask_tile(state, tiles, tile, asked, rule)) continue;
            const auto asks = state.q.asks;
            if (rule.tangent_plane)
                find_nearest<true>(map, state.q);
            else
                go_on_from_own(state, map);
            for (int i = 0; i < pixels; ++i) {
                if ((asks >> i & 1) == 0) continue;
                bool own = (state.q.asks >> i & 1) != 0;
                float ahead = state.tolerance[i];
                if (rule.tangent_plane) {
                    const int before = state.q.key[i] - state.q.upto[i];
                    ahead = static_cast<float>(before) - state.plane[i];
                    own = state.q.upto[i] != none && ahead >= -state.tolerance[i];
                }
                const auto place = tile * pixels + static_cast<std::size_t>(i);
                ++counts.asked[place];
                counts.own[place] += own;
                counts.rejected[place] += own && ahead > near_plane;
            }
        }
    }
}

void cosine_sums(const PixelTiles& tiles, std::size_t first, std::size_t end,
                 std::span<const MapFrame> frames, float scale, std::uint32_t* sums) {
    for (auto place = first * pixels; place < end * pixels; place += lanes) {
        if (tiles.valid[place / pixels] == 0) continue;
        const auto normal = load(tiles.normal, place);
        auto sum = hn::Zero(n);
        for (const auto& frame : frames)
            sum = hn::Add(sum, part_of_sum(hn::Set(f, 1), hn::Abs(dot(normal, frame.direction)), scale));
        hn::StoreU(sum, n, reinterpret_cast<std::int32_t*>(sums) + place);
    }
}

}  // namespace ir::passes::ldm::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ir::passes::ldm {

HWY_EXPORT(visibility_sums);
HWY_EXPORT(self_hits);
HWY_EXPORT(cosine_sums);

void add_visibility(const PixelTiles& tiles, std::size_t first, std::size_t end,
                    std::span<const StreamedMap> maps, const SelfHitRule& rule, const Visibility& visibility,
                    float scale, std::span<std::uint32_t> sums) {
    HWY_DYNAMIC_DISPATCH(visibility_sums)(tiles, first, end, maps, rule, visibility, scale, sums.data());
}

void count_self_hits(const PixelTiles& tiles, std::span<const StreamedMap> maps, const SelfHitRule& rule,
                     SelfHitCounts& counts) {
    HWY_DYNAMIC_DISPATCH(self_hits)(tiles, maps, rule, counts);
}

void sum_cosines(const PixelTiles& tiles, std::size_t first, std::size_t end,
                 std::span<const MapFrame> frames, float scale, std::span<std::uint32_t> sums) {
    HWY_DYNAMIC_DISPATCH(cosine_sums)(tiles, first, end, frames, scale, sums.data());
}

float sum_scale(int maps) {
    // One part in 2^23 is what a float resolves near 1; sums have 32 bits, of which one is spare.
    const auto bits = std::bit_width(static_cast<unsigned>(std::max(1, maps - 1)));
    return std::ldexp(1.0f, std::min(23, 31 - static_cast<int>(bits)));
}

void SelfHitCounts::resize(std::size_t pixels) {
    for (auto* counts : {&own, &asked, &rejected}) counts->assign(pixels, 0);
}

void SelfHitCounts::add(const SelfHitCounts& other) {
    for (const auto counts : {&SelfHitCounts::own, &SelfHitCounts::asked, &SelfHitCounts::rejected})
        for (std::size_t i = 0; i < (this->*counts).size(); ++i) (this->*counts)[i] += (other.*counts)[i];
}

std::string instruction_set() {
    const auto sets = instruction_sets();
    return sets.empty() ? "" : hwy::TargetName(sets.front());
}

std::vector<std::int64_t> instruction_sets() {
    std::vector<std::int64_t> sets;  // better ones have lower bits
    for (auto left = hwy::SupportedTargets() & HWY_TARGETS; left != 0; left &= left - 1)
        sets.push_back(left & -left);
    return sets;
}

void force_instruction_set(std::int64_t set) {
    hwy::SetSupportedTargetsForTest(set);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace ir::passes::ldm
#endif
