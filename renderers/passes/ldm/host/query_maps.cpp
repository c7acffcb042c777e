// Queries maps that are in memory for the pixels of a picture.
#include <vector>

#include "renderers/passes/ldm/host/streamed_map.h"
#include "renderers/passes/vectors/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "renderers/passes/ldm/host/query_maps.cpp"
#include <hwy/foreach_target.h>

#include "renderers/passes/ldm/host/judge.inl"
#include "renderers/passes/ldm/host/query_lists.inl"
#include "renderers/passes/ldm/host/query_outermost.inl"

HWY_BEFORE_NAMESPACE();
namespace ir::passes::ldm::HWY_NAMESPACE {

void visibility_sums(const PixelTiles& tiles, std::size_t first, std::size_t end,
                     std::span<const StreamedMap> maps, const SelfHitRule& rule, const Visibility& visibility,
                     float scale, std::uint32_t* sums) {
    TileState state;
    std::vector<QueriedMap> all;
    for (const auto& map : maps) all.emplace_back(map, visibility);
    for (auto group = first; group < end; group += lanes) {
        const auto group_end = std::min(end, group + lanes);
        for (const auto& queried : all) {
            const bool keeps_outermost = queried.map.holds == Holds::outermost;
            const auto verdict = keeps_outermost ? Judge(tiles, group, queried, rule).verdict() : Verdict{};
            for (auto tile = group; tile < group_end; ++tile) {
                const auto bit = tile - group;
                if (tiles.valid[tile] == 0 || (verdict.nothing >> bit & 1) != 0) continue;
                auto* const to = sums + tile * pixels;
                const bool is_whole = tiles.valid[tile] == ~std::uint64_t{0};
                if ((verdict.open >> bit & 1) != 0)
                    add_open(tiles, tile, queried, scale, to);
                else if (is_whole && (verdict.forward >> bit & 1) != 0)
                    query_inside<Along::v>(tiles, tile, queried, rule, scale, to);
                else if (is_whole && (verdict.backward >> bit & 1) != 0)
                    query_inside<Along::minus_v>(tiles, tile, queried, rule, scale, to);
                else if (is_whole && (verdict.inside >> bit & 1) != 0)
                    query_inside<Along::either>(tiles, tile, queried, rule, scale, to);
                else if (keeps_outermost)
                    query_outermost(tiles, tile, queried, rule, scale, to);
                else
                    query_lists(tiles, tile, queried, rule, visibility, scale, state, to);
            }
        }
    }
}

void seen_distances(const PixelTiles& tiles, std::size_t first, std::size_t end, const StreamedMap& map,
                    const SelfHitRule& rule, float* distances) {
    TileState state;
    const QueriedMap queried(map, {});
    for (auto tile = first; tile < end; ++tile, distances += pixels) {
        if (tiles.valid[tile] == 0) {
            std::fill_n(distances, pixels, -1.0f);
            continue;
        }
        find_in_lists(state, tiles, tile, queried, rule);
        const auto found = tiles.valid[tile] & state.q.queries, open = tiles.valid[tile] & state.open;
        for (int i = 0; i < pixels; i += lanes) {
            const auto beyond = load_halves(state.q.beyond + i);
            const auto distance = hn::Max(distance_of(state, i, beyond), hn::Zero(f));
            const auto far = hn::Set(f, std::numeric_limits<float>::infinity());
            const auto is_hit = hn::And(lanes_of(found, i), hn::Ne(beyond, hn::Set(f, none)));
            const auto seen = hn::IfThenElse(lanes_of(found | open, i), far, hn::Set(f, -1));
            hn::StoreU(hn::IfThenElse(is_hit, distance, seen), f, distances + i);
        }
    }
}

void self_hits(const PixelTiles& tiles, std::span<const StreamedMap> maps, const SelfHitRule& rule,
               SelfHitCounts& counts) {
    TileState state;
    for (const auto& map : maps) {
        const QueriedMap queried(map, {});
        for (std::size_t tile = 0; tile < tiles.count(); ++tile) {
            if (tiles.valid[tile] == 0 || !query_tile(state, tiles, tile, queried, rule)) continue;
            const auto queries = state.q.queries;
            std::uint64_t passed_over = 0;  // by their slopes
            if (rule.tangent_plane)
                find_nearest<true, false>(map, state.q);
            else
                go_on_from_own(state, map);
            if (map.holds == Holds::sloped_lists) {
                std::uint16_t beyond[pixels];
                std::copy_n(state.q.beyond, pixels, beyond);
                find_nearest<false, true>(map, state.q);
                for (int i = 0; i < pixels; ++i)
                    passed_over |= std::uint64_t{state.q.beyond[i] != beyond[i]} << i;
            }
            for (int i = 0; i < pixels; ++i) {
                if ((queries >> i & 1) == 0) continue;
                bool own = (state.q.queries >> i & 1) != 0;
                float ahead = state.tolerance[i];
                if (rule.tangent_plane) {
                    const int before = state.q.key[i] - state.q.upto[i];
                    ahead = static_cast<float>(before) - state.plane[i];
                    own = state.q.upto[i] != none && ahead >= -state.tolerance[i];
                }
                const bool passes = (passed_over >> i & 1) != 0;
                const auto place = tile * pixels + static_cast<std::size_t>(i);
                ++counts.queried[place];
                counts.own[place] += own || passes;
                counts.rejected[place] += passes || (own && ahead > near_plane);
            }
        }
    }
}

/// One vector of normals.
Ints cosines_of(const Vector3& normal, std::span<const MapFrame> frames, float scale) {
    auto sum = hn::Zero(n);
    for (const auto& frame : frames)
        sum = hn::Add(sum, part_of_sum(hn::Set(f, 1), hn::Abs(dot(normal, frame.direction)), scale));
    return sum;
}

void cosine_sums(const PixelTiles& tiles, std::size_t first, std::size_t end,
                 std::span<const MapFrame> frames, float scale, std::uint32_t* sums) {
    for (auto tile = first; tile < end; ++tile, sums += pixels) {
        const bool is_even = tiles.valid[tile] == ~std::uint64_t{0} && tiles.normal_boxes.is_point(tile);
        auto sum = hn::Zero(n);
        for (int i = 0; i < pixels; i += lanes) {
            if (tiles.valid[tile] != 0 && (i == 0 || !is_even))
                sum = cosines_of(load(tiles.normal, tile * pixels + static_cast<std::size_t>(i)), frames,
                                 scale);
            hn::StoreU(sum, n, reinterpret_cast<std::int32_t*>(sums) + i);
        }
    }
}

}  // namespace ir::passes::ldm::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ir::passes::ldm {

HWY_EXPORT(visibility_sums);
HWY_EXPORT(seen_distances);
HWY_EXPORT(self_hits);
HWY_EXPORT(cosine_sums);

void add_visibility(const PixelTiles& tiles, std::size_t first, std::size_t end,
                    std::span<const StreamedMap> maps, const SelfHitRule& rule, const Visibility& visibility,
                    float scale, std::span<std::uint32_t> sums) {
    HWY_DYNAMIC_DISPATCH(visibility_sums)(tiles, first, end, maps, rule, visibility, scale, sums.data());
}

void see_along(const PixelTiles& tiles, std::size_t first, std::size_t end, const StreamedMap& map,
               const SelfHitRule& rule, std::span<float> distances) {
    HWY_DYNAMIC_DISPATCH(seen_distances)(tiles, first, end, map, rule, distances.data());
}

void count_self_hits(const PixelTiles& tiles, std::span<const StreamedMap> maps, const SelfHitRule& rule,
                     SelfHitCounts& counts) {
    HWY_DYNAMIC_DISPATCH(self_hits)(tiles, maps, rule, counts);
}

void sum_cosines(const PixelTiles& tiles, std::size_t first, std::size_t end,
                 std::span<const MapFrame> frames, float scale, std::span<std::uint32_t> sums) {
    HWY_DYNAMIC_DISPATCH(cosine_sums)(tiles, first, end, frames, scale, sums.data());
}

}  // namespace ir::passes::ldm
#endif
