// Adds kernels to the pixels of tiles, many tiles and pixels at a time. [Aalund15 eqs. 5-7]
#include "renderers/methods/ldm-indirect/splatting/host/add_kernels.h"

#include <algorithm>
#include <bit>

#include "renderers/methods/ldm-indirect/looks.h"
#include "renderers/passes/vectors/targets.h"
#include "shaders/methods/ldm-indirect/beam.glsl.h"
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

/// Of looks. All from an open one on are the same.
Floats unpacked(const std::uint8_t* looks) {
    const hn::Rebind<std::uint8_t, decltype(f)> bytes;
    const hn::Rebind<std::int32_t, decltype(f)> whole;
    const auto look = hn::PromoteTo(whole, hn::LoadU(bytes, looks));
    return hn::BitCast(
        f, hn::ShiftLeft<look_shift>(hn::Add(look, hn::Set(whole, static_cast<int>(shortest_look)))));
}
const float open_units = std::bit_cast<float>((open_look + shortest_look) << look_shift);

/// The least look that is lit so far from a beam's sender, in units: min_look() of kernel.glsl.
Floats min_look(Floats way, const HostKernel& k, float units_per_metre) {
    const auto least = hn::Max(hn::Mul(hn::Set(f, part_looked), way),
                               hn::Sub(way, hn::Set(f, (1 - part_looked) * k.distance)));
    return hn::Min(hn::Mul(least, hn::Set(f, units_per_metre)), hn::Set(f, open_units));
}

/// Of some boxes, bit i for box i < 16: those in which the kernel may light something, and those in which it
/// is a beam that no look stops.
struct Reached {
    std::uint32_t bits = 0, open = 0;
};

Reached reached(const SurfaceBoxes& boxes, std::size_t first, const HostKernel& k, const LookRanges& looks,
                float units_per_metre) {
    Reached result;
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
        const auto facing =
            hn::Add(dot(load(boxes.normal, &SurfaceBoxes::Axis::centre), k.to_source_ws),
                    dot(load(boxes.normal, &SurfaceBoxes::Axis::half), glm::abs(k.to_source_ws)));
        auto is_reached = hn::Gt(facing, hn::Set(f, -1e-5f));
        if (k.distance > 0) {  // as far as it reaches along itself, and as pixels see
            constexpr float rounding = 1e-4f;
            const auto way = hn::Sub(hn::Set(f, k.distance), dot(d, k.to_source_ws)),
                       reach = dot(half, glm::abs(k.to_source_ws));
            const auto begins = hn::Set(f, beam_begins * k.distance),
                       ends = hn::Set(f, beam_ends * k.distance);
            const auto nearest = hn::Sub(way, reach), farthest = hn::Add(way, reach);
            const auto least = min_look(hn::Max(nearest, begins), k, (1 - rounding) * units_per_metre),
                       most = min_look(farthest, k, (1 + rounding) * units_per_metre);
            is_reached = hn::And(is_reached, hn::And(hn::Ge(farthest, begins), hn::Le(nearest, ends)));
            is_reached = hn::And(is_reached, hn::Ge(unpacked(looks.longest + i), least));
            const auto is_within = hn::And(hn::Gt(nearest, hn::Mul(begins, hn::Set(f, 1 + rounding))),
                                           hn::Lt(farthest, hn::Mul(ends, hn::Set(f, 1 - rounding))));
            result.open |= bits_of(hn::And(is_within, hn::Ge(unpacked(looks.shortest + i), most))) << i;
        } else {
            add(k.row_n);
        }
        result.bits |= bits_of(hn::And(hn::Lt(squared, hn::Set(f, beyond)), is_reached)) << i;
    }
    return result;
}

/// Some pixels and their sums.
struct Pixels {
    Vector3 position, normal;
    Floats sums[TileSums::channels];
};

template <class Values>
Vector3 load3(const Values (&axes)[3], std::size_t place) {
    return {hn::LoadU(f, axes[0].data() + place), hn::LoadU(f, axes[1].data() + place),
            hn::LoadU(f, axes[2].data() + place)};
}

/// As is_lit() of clipping.glsl and the ends of squared_length().
Mask is_in_beam(const Vector3& d, const HostKernel& k, const std::uint8_t* looks, float units_per_metre) {
    const auto way = hn::Sub(hn::Set(f, k.distance), dot(d, k.to_source_ws));
    const auto is_between = hn::And(hn::Gt(way, hn::Set(f, beam_begins * k.distance)),
                                    hn::Lt(way, hn::Set(f, beam_ends * k.distance)));
    return hn::And(is_between, hn::Ge(unpacked(looks), min_look(way, k, units_per_metre)));
}

/// What a kernel lights of a tile.
enum class Lights {
    ellipsoid,
    beam,      ///< what lies between its ends and sees far enough
    open_beam  ///< of which pixels of the tile see enough
};

template <Lights lights>
HWY_INLINE void add_kernel(Pixels& to, const HostKernel& k, const std::uint8_t* looks,
                           float units_per_metre) {
    const auto d = minus(to.position, k.centre_ws);
    const auto p = dot(d, k.row_p), q = dot(d, k.row_q);
    const auto one = hn::Set(f, 1);
    auto squared = hn::MulAdd(q, q, hn::Mul(p, p));
    if constexpr (lights == Lights::ellipsoid) {
        const auto h = dot(d, k.row_n);
        squared = hn::MulAdd(h, h, squared);
    }
    const auto below = hn::Sub(one, squared);
    const auto facing = dot(to.normal, k.to_source_ws);
    auto lit = hn::And(hn::Gt(below, hn::Zero(f)), hn::Gt(facing, hn::Zero(f)));
    auto turned = facing;  // the plane of a beam lies across it
    if constexpr (lights == Lights::ellipsoid)
        turned = k.per_cosine > 0 ? hn::Min(hn::Mul(facing, hn::Set(f, k.per_cosine)), hn::Set(f, max_turned))
                                  : one;
    if constexpr (lights == Lights::beam) {
        if (hn::AllFalse(f, lit)) return;
        lit = hn::And(lit, is_in_beam(d, k, looks, units_per_metre));
    }
    const auto weight = hn::IfThenElseZero(lit, hn::Mul(hn::Mul(below, below), turned));
    for (int i = 0; i < 3; ++i) {
        to.sums[i] = hn::MulAdd(weight, hn::Set(f, k.peak[i]), to.sums[i]);
        to.sums[4 + i] = hn::MulAdd(weight, hn::Set(f, k.directed[i]), to.sums[4 + i]);
    }
    to.sums[3] = hn::Add(to.sums[3], hn::IfThenElseZero(lit, one));
}

template <Lights lights>
void add_to_tile(const PixelTiles& tiles, const TileLooks& looks, std::size_t tile,
                 std::span<const HostKernel> kernels, std::span<const std::uint16_t> list, TileSums& sums) {
    if (list.empty()) return;
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
            const auto* const seen = lights == Lights::beam ? looks.of(tile, kernel.map) + first : nullptr;
            for (int v = 0; v < vectors; ++v)
                add_kernel<lights>(part[v], kernel, seen + v * lanes, looks.units_per_metre);
        }
        for (int v = 0; v < vectors; ++v) {
            const auto at = place + static_cast<std::size_t>(v * lanes);
            for (int i = 0; i < TileSums::channels; ++i)
                hn::StoreU(part[v].sums[i], f, sums.channel[i].data() + at);
        }
    }
}

/// Numbers of kernels that may light pixels of a tile, by what they light there.
struct TileList {
    static constexpr std::size_t most = 1024, kinds = 3;
    std::uint16_t numbers[kinds][most];
    std::size_t sizes[kinds] = {};
    void add(Lights kind, std::size_t number) {
        const auto i = static_cast<std::size_t>(kind);
        numbers[i][sizes[i]++] = static_cast<std::uint16_t>(number);
    }
    std::span<const std::uint16_t> of(Lights kind) const {
        const auto i = static_cast<std::size_t>(kind);
        return {numbers[i], sizes[i]};
    }
};

}  // namespace

void groups_of_word(const TileGroups& groups, const TileLooks& looks, KernelRound& round, std::size_t word) {
    auto* const words = round.reaching.data() + word * groups.count();
    std::fill_n(words, groups.count(), 0);
    const auto first = word * KernelRound::word;
    const auto end = std::min(first + KernelRound::word, round.made.size());
    for (auto i = first; i < end; ++i) {
        const auto& kernel = round.made[i];
        if (!kernel.counts) continue;
        for (std::size_t group = 0; group < groups.count(); group += TileGroups::tiles) {
            const auto ranges = kernel.distance > 0 ? looks.of_groups.at(kernel.map, group) : LookRanges{};
            for (auto bits = reached(groups.groups, group, kernel, ranges, looks.units_per_metre).bits;
                 bits != 0; bits &= bits - 1)
                words[group + static_cast<std::size_t>(std::countr_zero(bits))] |= std::uint64_t{1}
                                                                                   << (i - first);
        }
    }
}

void group_sums(const PixelTiles& tiles, const TileGroups& groups, const TileLooks& looks,
                const KernelRound& round, std::size_t group, TileSums& sums) {
    constexpr std::size_t words_at_once = TileList::most / KernelRound::word;
    const auto members = group * TileGroups::tiles;
    const auto words = (round.made.size() + KernelRound::word - 1) / KernelRound::word;
    TileList lists[TileGroups::tiles];
    for (std::size_t first = 0; first < words; first += words_at_once) {
        for (auto& list : lists) std::fill(std::begin(list.sizes), std::end(list.sizes), 0);
        for (auto word = first; word < std::min(words, first + words_at_once); ++word)
            for (auto left = round.reaching[word * groups.count() + group]; left != 0; left &= left - 1) {
                const auto number =
                    word * KernelRound::word + static_cast<std::size_t>(std::countr_zero(left));
                const auto& kernel = round.made[number];
                const bool is_beam = kernel.distance > 0;
                const auto ranges = is_beam ? looks.of_members.at(kernel.map, members) : LookRanges{};
                const auto lit = reached(groups.members, members, kernel, ranges, looks.units_per_metre);
                for (auto bits = lit.bits; bits != 0; bits &= bits - 1) {
                    const auto member = std::countr_zero(bits);
                    const bool is_open = (lit.open >> member & 1) != 0;
                    lists[member].add(is_open   ? Lights::open_beam
                                      : is_beam ? Lights::beam
                                                : Lights::ellipsoid,
                                      number);
                }
            }
        for (std::size_t i = 0; i < TileGroups::tiles; ++i) {
            const auto tile = static_cast<std::size_t>(groups.places[members + i]);
            const auto& list = lists[i];
            add_to_tile<Lights::ellipsoid>(tiles, looks, tile, round.made, list.of(Lights::ellipsoid), sums);
            add_to_tile<Lights::open_beam>(tiles, looks, tile, round.made, list.of(Lights::open_beam), sums);
            add_to_tile<Lights::beam>(tiles, looks, tile, round.made, list.of(Lights::beam), sums);
        }
    }
}

}  // namespace ir::methods::ldm_indirect::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ir::methods::ldm_indirect {

HWY_EXPORT(groups_of_word);
HWY_EXPORT(group_sums);

void find_groups(const TileGroups& groups, const TileLooks& looks, KernelRound& round, std::size_t word) {
    HWY_DYNAMIC_DISPATCH(groups_of_word)(groups, looks, round, word);
}

void add_to_group(const PixelTiles& tiles, const TileGroups& groups, const TileLooks& looks,
                  const KernelRound& round, std::size_t group, TileSums& sums) {
    HWY_DYNAMIC_DISPATCH(group_sums)(tiles, groups, looks, round, group, sums);
}

}  // namespace ir::methods::ldm_indirect
#endif
