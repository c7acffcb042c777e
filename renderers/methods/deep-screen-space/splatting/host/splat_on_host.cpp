#include "renderers/methods/deep-screen-space/splatting/host/splat_on_host.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <glm/gtc/packing.hpp>
#include <optional>

#include "renderers/core/error.h"
#include "renderers/core/threads.h"
#include "renderers/graph/image_layers.h"
#include "renderers/methods/deep-screen-space/splatting/host/disc_level.h"
#include "renderers/methods/deep-screen-space/splatting/host/ray_ranges.h"
#include "shaders/methods/deep-screen-space/splatting/places.glsl.h"

namespace ir::methods::deep_screen_space {
namespace {

using graph::PassContext;
using graph::Slice;

/// Pixels, or places of a level, of a side of the squares that a thread does at a time.
constexpr int side = 16;

struct Tiles {
    int across, down;
    std::int64_t count() const { return std::int64_t{across} * down; }
};
Tiles tiles_of(const Hierarchy& hierarchy) {
    return {(hierarchy.width + side - 1) / side, (hierarchy.height + side - 1) / side};
}

struct ReleaseDevice {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};

/// What the rays of a frame are traced through.
class HostSplats {
  public:
    HostSplats(const VisibleSplats& visible, graph::ObjectRef bvh) : visible_(visible), bvh_(bvh) {}

    void begin(const PassContext& p) {
        const auto& splats = visible_.splats;
        surfels_ = stored_surfels(p, splats.surfels);
        seed_ = random_seed(p.inputs(), splats.parameters);
        ranges_.emplace(p.inputs().view, rules_, surfels_, splats.parameters);
        positions_ = p.pixels<const glm::vec4>(visible_.gbuffer.position);
        seen_.emplace(p.inputs().view, positions_, splats.parameters);
        normals_ = p.pixels<const glm::vec4>(visible_.gbuffer.geometric_normal);
        places_ = graph::layers<const std::uint32_t>(p, splats.hierarchy.places);
        layout_ = graph::layers<const std::uint32_t>(p, splats.hierarchy.layout);
        if (bvh_.index >= 0) tree_ = p.object<passes::Bvh>(bvh_);
        width_ = p.inputs().view.width;
        height_ = p.inputs().view.height;
        device_.reset(rtcNewDevice(nullptr));
        if (!device_) throw Error("deep screen space: Embree does not start; --processor gl does without");
    }

    /// Stratified, all samples have the same discs, only in other sub-images.
    void begin_sample(int sample) {
        if (!levels_.empty() && is_stratified()) return;
        const auto& hierarchy = visible_.splats.hierarchy;
        levels_.clear();
        levels_.resize(static_cast<std::size_t>(hierarchy.levels));
        tbb::parallel_for(0, hierarchy.levels, [&](int level) {
            const auto mask = (1u << 2 * level) - 1;
            levels_[static_cast<std::size_t>(level)] = std::make_unique<DiscLevel>(
                device_.get(), surfels_, rules_, level, *seen_, [&](const Surfel& surfel) {
                    return is_stratified() ? surfel.order & mask
                                           : random_sub_image(surfel, static_cast<unsigned>(level),
                                                              static_cast<unsigned>(sample), seed_);
                });
        });
        if (rtcGetDeviceError(device_.get()) != RTC_ERROR_NONE)
            throw Error("deep screen space: Embree has no room for " + std::to_string(surfels_.size()) +
                        " surfels on each level; raise surfel_radius");
    }

    /// Calls `to` with the number and the place of each pixel of the tile.
    template <class To>
    void each_pixel(std::int64_t tile, const To& to) const {
        each_texel(tile, glm::ivec2(width_, height_), [&](glm::uvec2 pixel) { to(number_of(pixel), pixel); });
    }

    /// The same with the pixels that stand in a tile of the level: those of a sub-image meet the same discs.
    template <class To>
    void each_pixel(std::int64_t tile, int level, const To& to) const {
        const auto& hierarchy = visible_.splats.hierarchy;
        const auto width = static_cast<std::size_t>(hierarchy.width);
        each_texel(tile, glm::ivec2(hierarchy.width, hierarchy.height), [&](glm::uvec2 place) {
            const auto word = layout_[static_cast<std::size_t>(level)][place.y * width + place.x];
            if (word == padding) return;
            const glm::uvec2 pixel(word & 0xffff, word >> 16);
            to(number_of(pixel), pixel);
        });
    }

    bool is_ray(std::size_t pixel, const glm::vec4& direction) const {
        return positions_[pixel].w != 0 && direction != glm::vec4(0);
    }

    Receiver receiver(std::size_t pixel) const {
        const auto& parameters = visible_.splats.parameters;
        return {positions_[pixel], normals_[pixel], parameters.discs, parameters.backs == Backs::open,
                tree_.get()};
    }

    /// Where the pixel stands on the level.
    glm::uvec2 place(glm::uvec2 pixel, int level) const {
        const auto width = static_cast<std::size_t>(visible_.splats.hierarchy.width);
        const auto word = places_[static_cast<std::size_t>(level)][pixel.y * width + pixel.x];
        return {word & 0xffff, word >> 16};
    }

    void ask(DiscRay& ray, glm::uvec2 pixel, int level, int sample, RayRanges::Range range) const {
        const auto& hierarchy = visible_.splats.hierarchy;
        const auto sub_image =
            place(pixel, level) / (glm::uvec2(hierarchy.width, hierarchy.height) >> unsigned(level));
        auto cell = sub_image.y << level | sub_image.x;
        if (is_stratified())
            cell = (cell -
                    sub_image_offset(static_cast<unsigned>(level), static_cast<unsigned>(sample), seed_)) &
                   ((1u << 2 * level) - 1);
        ray.winner = 0;
        levels_[static_cast<std::size_t>(level)]->ask(ray, cell, range.near, range.far);
    }

    struct Winner {
        std::uint32_t number = 0;  ///< as in "splats.nearest"
        int level = -1;
        float distance = -1;  ///< m
    };

    /// What triangles decide of a ray on level 0: up to which distance, and what it met there.
    struct Exact {
        float known = 0;  ///< m
        passes::Hit hit = {};
    };
    Exact exact(const Receiver& from, glm::vec3 direction_ws) const {
        const float reach = known_up_to(from.x_ws);
        if (reach == 0) return {};
        return {reach, tree_->closest_hit(passes::offset_origin(from.x_ws, from.geometric_normal_ws),
                                          direction_ws, 0, reach)};
    }

    /// Before discs are asked.
    Winner first_winner(std::size_t index, glm::vec3 direction_ws) const {
        const auto hit = exact(receiver(index), direction_ws).hit;
        if (hit.is_hit()) return {exact_hit | hit.triangle, 0, hit.distance};
        return {};
    }

    /// After the finer levels, as combine.comp chooses.
    Winner winner(Winner finer, std::size_t index, glm::uvec2 pixel, glm::vec3 direction_ws, int level,
                  int sample) const {
        if (finer.number & exact_hit || (finer.number != 0 && !nearest_decides(visible_.splats)))
            return finer;
        const auto from = receiver(index);
        auto range = ranges_->of(level, from.x_ws, direction_ws);
        DiscRay ray(from, direction_ws);
        ray.known = known_up_to(from.x_ws);
        if (finer.number != 0) {
            range.far = std::min(range.far, finer.distance);
            ray.z = splat_z(rules_.influence, finer.distance);
        }
        ask(ray, pixel, level, sample, range);
        if (ray.winner == 0) return finer;
        const auto& winner = surfels_[ray.winner - 1];
        return {ray.winner, level,
                splat_plane_distance(from.x_ws, direction_ws, winner.centre_ws, winner.normal_ws)};
    }

  private:
    template <class To>
    void each_texel(std::int64_t tile, glm::ivec2 size, const To& to) const {
        const int across = tiles_of(visible_.splats.hierarchy).across;
        const int first_x = static_cast<int>(tile % across) * side,
                  first_y = static_cast<int>(tile / across) * side;
        for (int y = first_y; y < std::min(first_y + side, size.y); ++y)
            for (int x = first_x; x < std::min(first_x + side, size.x); ++x) to(glm::uvec2(x, y));
    }
    std::size_t number_of(glm::uvec2 pixel) const {
        return std::size_t{pixel.y} * static_cast<std::size_t>(width_) + pixel.x;
    }
    /// m; 0 where level 0 has discs.
    float known_up_to(glm::vec3 x_ws) const {
        return visible_.splats.parameters.level0 == Level0::triangles ? ranges_->exact_reach(x_ws) : 0;
    }
    bool is_stratified() const { return visible_.splats.parameters.sub_images == SubImages::stratified; }

    VisibleSplats visible_;
    graph::ObjectRef bvh_;
    VisibleLevel rules_ = visible_level(visible_.splats);
    std::span<const Surfel> surfels_;
    unsigned seed_ = 0;
    std::optional<RayRanges> ranges_;
    std::optional<WhatIsSeen> seen_;
    std::span<const glm::vec4> positions_, normals_;
    std::vector<std::span<const std::uint32_t>> places_, layout_;
    std::shared_ptr<passes::Bvh> tree_;
    int width_ = 0, height_ = 0;
    std::unique_ptr<std::remove_pointer_t<RTCDevice>, ReleaseDevice> device_;
    std::vector<std::unique_ptr<DiscLevel>> levels_;
};

/// Calls `run(splats, sample, stage, tile)` for all of them, sample by sample, so that only the discs of one
/// are held, and stage by stage.
template <class Run>
void execute(graph::PassBuilder& pass, const VisibleSplats& visible, graph::ObjectRef bvh, int stages,
             const Run& make_run) {
    const auto& hierarchy = visible.splats.hierarchy;
    const auto tiles = tiles_of(hierarchy).count(), of_sample = tiles * stages;
    const auto splats = std::make_shared<HostSplats>(visible, bvh);
    pass.reads(visible.splats.surfels.records, visible.splats.surfels.stored, hierarchy.places,
               hierarchy.layout, visible.gbuffer.position, visible.gbuffer.geometric_normal,
               visible.directions.directions);
    if (bvh.index >= 0) pass.reads(bvh);
    pass.execute_sliced(of_sample * visible.splats.samples, [=](PassContext& p, Slice slice) {
        const int threads = p.inputs().threads;
        tbb::task_arena arena(arena_size(threads));
        arena.execute([&] {
            if (slice.first) splats->begin(p);
            const auto run = make_run(p, slice);
            for (auto item = slice.begin; item < slice.end;) {
                const auto sample = static_cast<int>(item / of_sample);
                const auto stage = static_cast<int>(item % of_sample / tiles);
                const auto first = item % tiles, end = std::min(tiles, first + slice.end - item);
                if (item % of_sample == 0) splats->begin_sample(sample);
                tbb::parallel_for(first, end, [&](std::int64_t tile) { run(*splats, sample, stage, tile); });
                item += end - first;
            }
        });
    });
}

/// The pass of the picture: only the winners of all levels together are looked for. Triangles first, then
/// level by level the pixels of a sub-image after each other, as they meet the same discs.
void declare_winners(graph::GraphBuilder& builder, const VisibleSplats& visible, graph::ObjectRef bvh,
                     graph::ImageRef distance) {
    auto pass = builder.pass("splat", graph::Queue::cpu);
    pass.has_two_bodies().writes(visible.nearest, visible.hit_level, distance);
    const int stages = 1 + visible.splats.hierarchy.levels;
    execute(pass, visible, bvh, stages, [=](const PassContext& p, Slice) {
        return [directions = graph::layers<const glm::vec4>(p, visible.directions.directions),
                nearest = graph::layers<std::uint32_t>(p, visible.nearest),
                levels = graph::layers<std::uint16_t>(p, visible.hit_level),
                distances = graph::layers<float>(p, distance)](const HostSplats& splats, int sample,
                                                               int stage, std::int64_t tile) {
            const auto layer = static_cast<std::size_t>(sample);
            const auto store = [&](std::size_t index, const HostSplats::Winner& winner) {
                nearest[layer][index] = winner.number;
                levels[layer][index] = glm::packHalf1x16(static_cast<float>(winner.level));
                distances[layer][index] = winner.distance;
            };
            if (stage == 0) {
                splats.each_pixel(tile, [&](std::size_t index, glm::uvec2) {
                    const auto& direction = directions[layer][index];
                    store(index, splats.is_ray(index, direction) ? splats.first_winner(index, direction)
                                                                 : HostSplats::Winner{});
                });
                return;
            }
            splats.each_pixel(tile, stage - 1, [&](std::size_t index, glm::uvec2 pixel) {
                const auto& direction = directions[layer][index];
                if (!splats.is_ray(index, direction)) return;
                const HostSplats::Winner finer{nearest[layer][index],
                                               static_cast<int>(glm::unpackHalf1x16(levels[layer][index])),
                                               distances[layer][index]};
                store(index, splats.winner(finer, index, pixel, direction, stage - 1, sample));
            });
        };
    });
}

/// The winners of each level by itself, as the device has them in any case.
void declare_levels(graph::GraphBuilder& builder, const VisibleSplats& visible, graph::ObjectRef bvh) {
    auto pass = builder.pass("splat level by level", graph::Queue::cpu);
    pass.writes(visible.depth, visible.winner);
    execute(pass, visible, bvh, 1, [=](const PassContext& p, Slice slice) {
        const auto depths = graph::layers<float>(p, visible.depth);
        const auto winners = graph::layers<std::uint32_t>(p, visible.winner);
        if (slice.first) {
            for (const auto layer : depths) std::ranges::fill(layer, 1.0f);
            for (const auto layer : winners) std::ranges::fill(layer, 0u);
        }
        return [=, directions = graph::layers<const glm::vec4>(p, visible.directions.directions)](
                   const HostSplats& splats, int sample, int, std::int64_t tile) {
            const auto& hierarchy = visible.splats.hierarchy;
            splats.each_pixel(tile, [&](std::size_t index, glm::uvec2 pixel) {
                const auto& direction = directions[static_cast<std::size_t>(sample)][index];
                if (!splats.is_ray(index, direction)) return;
                const auto from = splats.receiver(index);
                const auto [known, hit] = splats.exact(from, direction);
                for (int level = 0; level < hierarchy.levels && !hit.is_hit(); ++level) {
                    DiscRay ray(from, direction);
                    ray.known = known;
                    splats.ask(ray, pixel, level, sample, {});
                    if (ray.winner == 0) continue;
                    const auto at = splats.place(pixel, level);
                    const auto texel = at.y * static_cast<std::size_t>(hierarchy.width) + at.x;
                    const auto layer = static_cast<std::size_t>(sample * hierarchy.levels + level);
                    depths[layer][texel] = ray.z;
                    winners[layer][texel] = ray.winner;
                }
            });
        };
    });
}

}  // namespace

graph::ImageRef splat_on_host(graph::GraphBuilder& builder, VisibleSplats& visible) {
    graph::ObjectRef bvh;
    if (needs_triangles(visible.splats.parameters)) bvh = passes::bvh(builder);
    const auto distance = declare_winning(builder, visible, visible.splats.fingerprint);
    declare_winners(builder, visible, bvh, distance);
    declare_levels(builder, visible, bvh);
    return distance;
}

}  // namespace ir::methods::deep_screen_space
