// Adds kernels to the pixels of tiles, many tiles and pixels at a time. [Aalund15 eqs. 5-7]
#include "renderers/methods/ldm-indirect/splatting/host/add_kernels.h"

#include <algorithm>
#include <bit>

#include "renderers/methods/ldm-indirect/looks.h"
#include "renderers/passes/vectors/targets.h"
#include "shaders/methods/ldm-indirect/splatting/footprint.glsl.h"
#include "shaders/methods/ldm-indirect/splatting/kernel.glsl.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "renderers/methods/ldm-indirect/splatting/host/add_kernels.cpp"
#include <hwy/foreach_target.h>

#include "renderers/passes/vectors/floats.inl"

HWY_BEFORE_NAMESPACE();
namespace ir::methods::ldm_indirect::HWY_NAMESPACE {
namespace {

using namespace passes::vectors::HWY_NAMESPACE;

constexpr int pixels = PixelTiles::pixels;
/// Vectors of pixels that are worked on at once, so that what is read of a kernel serves more of them.
constexpr int vectors = lanes < pixels / 2 ? 2 : 1;

struct Vector3 {
    Floats x, y, z;
};

Floats dot(const Vector3& a, const glm::vec3& b) {
    return hn::MulAdd(a.z, hn::Set(f, b.z), hn::MulAdd(a.y, hn::Set(f, b.y), hn::Mul(a.x, hn::Set(f, b.x))));
}
Vector3 minus(const Vector3& a, const glm::vec3& b) {
    return {hn::Sub(a.x, hn::Set(f, b.x)), hn::Sub(a.y, hn::Set(f, b.y)), hn::Sub(a.z, hn::Set(f, b.z))};
}

/// What of a kernel boxes are compared with: more than 1 by more than rounding.
constexpr float beyond = 1.001f;

/// Bit i: the kernel may light something in box first + i, i < 16.
std::uint32_t reached(const SurfaceBoxes& boxes, std::size_t first, const HostKernel& k) {
    std::uint32_t bits = 0;
    for (int i = 0; i < TileGroups::tiles; i += lanes) {
        const auto at = first + static_cast<std::size_t>(i);
        const auto load = [&](const SurfaceBoxes::Axis(&axes)[3],
                              std::vector<float> SurfaceBoxes::Axis::*part) {
            return Vector3{hn::LoadU(f, (axes[0].*part).data() + at),
                           hn::LoadU(f, (axes[1].*part).data() + at),
                           hn::LoadU(f, (axes[2].*part).data() + at)};
        };
        const auto d = minus(load(boxes.position, &SurfaceBoxes::Axis::centre), k.centre_ws);
        const auto half = load(boxes.position, &SurfaceBoxes::Axis::half);
        // In the kernel's coordinates the box lies in one with sides along the axes; its nearest point.
        auto squared = hn::Zero(f);
        const auto add = [&](const glm::vec3& row) {
            const auto gap = hn::Sub(hn::Abs(dot(d, row)), dot(half, glm::abs(row)));
            const auto part = hn::Max(gap, hn::Zero(f));
            squared = hn::MulAdd(part, part, squared);
        };
        add(k.row_p);
        add(k.row_q);
        if (k.distance > 0) {  // as far as it reaches along itself
            const auto way = dot(d, k.to_source_ws), reach = dot(half, glm::abs(k.to_source_ws));
            const auto first = hn::Set(f, (1 - beam_ends) * k.distance),
                       last = hn::Set(f, (1 - beam_begins) * k.distance);
            const auto is_off = hn::Or(hn::Lt(hn::Add(way, reach), first), hn::Gt(hn::Sub(way, reach), last));
            squared = hn::IfThenElse(is_off, hn::Set(f, 2 * beyond), squared);
        } else {
            add(k.row_n);
        }
        const auto facing =
            hn::Add(dot(load(boxes.normal, &SurfaceBoxes::Axis::centre), k.to_source_ws),
                    dot(load(boxes.normal, &SurfaceBoxes::Axis::half), glm::abs(k.to_source_ws)));
        const auto least = hn::Set(f, -1e-5f);  // rounding
        bits |= bits_of(hn::And(hn::Lt(squared, hn::Set(f, beyond)), hn::Gt(facing, least))) << i;
    }
    return bits;
}

/// Some pixels and their sums.
struct Pixels {
    Vector3 position, normal;
    Floats sums[TileSums::channels];
};

Vector3 load3(const std::vector<float> (&axes)[3], std::size_t place) {
    return {hn::LoadU(f, axes[0].data() + place), hn::LoadU(f, axes[1].data() + place),
            hn::LoadU(f, axes[2].data() + place)};
}

/// What pixels see along a beam, in units, from their looks.
Floats unpacked(const std::uint8_t* looks) {
    const hn::Rebind<std::uint8_t, decltype(f)> bytes;
    const hn::Rebind<std::int32_t, decltype(f)> whole;
    const auto look = hn::PromoteTo(whole, hn::LoadU(bytes, looks));
    const auto bits =
        hn::ShiftLeft<look_shift>(hn::Add(look, hn::Set(whole, static_cast<int>(shortest_look))));
    const auto is_open = hn::Eq(look, hn::Set(whole, static_cast<int>(open_look)));
    return hn::IfThenElse(hn::RebindMask(f, is_open), hn::Set(f, 1e30f), hn::BitCast(f, bits));
}

/// As is_lit() of clipping.glsl and the ends of squared_length().
auto is_in_beam(const Vector3& d, const HostKernel& k, const std::uint8_t* looks, float units_per_metre) {
    const auto way = hn::Sub(hn::Set(f, k.distance), dot(d, k.to_source_ws));
    const auto least = hn::Max(hn::Mul(hn::Set(f, part_looked), way),
                               hn::Sub(way, hn::Set(f, (1 - part_looked) * k.distance)));
    const auto is_between = hn::And(hn::Gt(way, hn::Set(f, beam_begins * k.distance)),
                                    hn::Lt(way, hn::Set(f, beam_ends * k.distance)));
    return hn::And(is_between, hn::Ge(unpacked(looks), hn::Mul(least, hn::Set(f, units_per_metre))));
}

HWY_INLINE void add_kernel(Pixels& to, const HostKernel& k, const std::uint8_t* looks,
                           float units_per_metre) {
    const auto d = minus(to.position, k.centre_ws);
    const auto p = dot(d, k.row_p), q = dot(d, k.row_q);
    const auto h = k.distance > 0 ? hn::Zero(f) : dot(d, k.row_n);
    const auto one = hn::Set(f, 1);
    const auto below = hn::Sub(one, hn::MulAdd(h, h, hn::MulAdd(q, q, hn::Mul(p, p))));
    const auto facing = dot(to.normal, k.to_source_ws);
    const auto turned =
        k.per_cosine > 0 ? hn::Min(hn::Mul(facing, hn::Set(f, k.per_cosine)), hn::Set(f, max_turned)) : one;
    auto lit = hn::And(hn::Gt(below, hn::Zero(f)), hn::Gt(facing, hn::Zero(f)));
    if (k.distance > 0) lit = hn::And(lit, is_in_beam(d, k, looks, units_per_metre));
    const auto weight = hn::IfThenElseZero(lit, hn::Mul(hn::Mul(below, below), turned));
    for (int i = 0; i < 3; ++i) {
        to.sums[i] = hn::MulAdd(weight, hn::Set(f, k.peak[i]), to.sums[i]);
        to.sums[4 + i] = hn::MulAdd(weight, hn::Set(f, k.directed[i]), to.sums[4 + i]);
    }
    to.sums[3] = hn::Add(to.sums[3], hn::IfThenElseZero(lit, one));
}

void add_to_tile(const PixelTiles& tiles, const TileLooks& looks, std::size_t tile,
                 std::span<const HostKernel> kernels, std::span<const std::uint16_t> list, TileSums& sums) {
    for (int first = 0; first < pixels; first += vectors * lanes) {
        Pixels part[vectors];
        const auto place = tile * pixels + static_cast<std::size_t>(first);
        for (int v = 0; v < vectors; ++v) {
            const auto at = place + static_cast<std::size_t>(v * lanes);
            part[v].position = load3(tiles.position, at);
            part[v].normal = load3(tiles.geometric_normal, at);
            for (int i = 0; i < TileSums::channels; ++i)
                part[v].sums[i] = hn::LoadU(f, sums.channel[i].data() + at);
        }
        for (const auto number : list) {
            const auto& kernel = kernels[number];
            const auto* seen = kernel.distance > 0 ? looks.of(tile, kernel.map) + first : nullptr;
            for (int v = 0; v < vectors; ++v)
                add_kernel(part[v], kernel, seen + v * lanes, looks.units_per_metre);
        }
        for (int v = 0; v < vectors; ++v) {
            const auto at = place + static_cast<std::size_t>(v * lanes);
            for (int i = 0; i < TileSums::channels; ++i)
                hn::StoreU(part[v].sums[i], f, sums.channel[i].data() + at);
        }
    }
}

}  // namespace

void groups_of_word(const TileGroups& groups, KernelRound& round, std::size_t word) {
    auto* const words = round.reaching.data() + word * groups.count();
    std::fill_n(words, groups.count(), 0);
    const auto first = word * KernelRound::word;
    const auto end = std::min(first + KernelRound::word, round.made.size());
    for (auto i = first; i < end; ++i) {
        const auto& kernel = round.made[i];
        if (!kernel.counts) continue;
        for (std::size_t group = 0; group < groups.count(); group += TileGroups::tiles)
            for (auto bits = reached(groups.groups, group, kernel); bits != 0; bits &= bits - 1)
                words[group + static_cast<std::size_t>(std::countr_zero(bits))] |= std::uint64_t{1}
                                                                                   << (i - first);
    }
}

void group_sums(const PixelTiles& tiles, const TileGroups& groups, const TileLooks& looks,
                const KernelRound& round, std::size_t group, TileSums& sums) {
    constexpr std::size_t most = 1024, words_at_once = most / KernelRound::word;
    const auto members = group * TileGroups::tiles;
    const auto words = (round.made.size() + KernelRound::word - 1) / KernelRound::word;
    std::uint16_t lists[TileGroups::tiles][most];
    for (std::size_t first = 0; first < words; first += words_at_once) {
        std::size_t sizes[TileGroups::tiles] = {};
        for (auto word = first; word < std::min(words, first + words_at_once); ++word)
            for (auto left = round.reaching[word * groups.count() + group]; left != 0; left &= left - 1) {
                const auto number =
                    word * KernelRound::word + static_cast<std::size_t>(std::countr_zero(left));
                for (auto bits = reached(groups.members, members, round.made[number]); bits != 0;
                     bits &= bits - 1) {
                    const auto member = std::countr_zero(bits);
                    lists[member][sizes[member]++] = static_cast<std::uint16_t>(number);
                }
            }
        for (std::size_t i = 0; i < TileGroups::tiles; ++i)
            if (sizes[i] != 0)
                add_to_tile(tiles, looks, static_cast<std::size_t>(groups.places[members + i]), round.made,
                            std::span(lists[i], sizes[i]), sums);
    }
}

}  // namespace ir::methods::ldm_indirect::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ir::methods::ldm_indirect {

HWY_EXPORT(groups_of_word);
HWY_EXPORT(group_sums);

void find_groups(const TileGroups& groups, KernelRound& round, std::size_t word) {
    HWY_DYNAMIC_DISPATCH(groups_of_word)(groups, round, word);
}

void add_to_group(const PixelTiles& tiles, const TileGroups& groups, const TileLooks& looks,
                  const KernelRound& round, std::size_t group, TileSums& sums) {
    HWY_DYNAMIC_DISPATCH(group_sums)(tiles, groups, looks, round, group, sums);
}

}  // namespace ir::methods::ldm_indirect
#endif
