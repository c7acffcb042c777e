#include "renderers/methods/deep-screen-space/splatting/visible.h"

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

/// Levels of the hierarchical framebuffer.
struct Levels {
    int first, end;
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
        if (splats.open_glass) glass_.emplace(*p.inputs().scene, *p.inputs().world);
        width_ = p.inputs().view.width;
        height_ = p.inputs().view.height;
        device_.reset(rtcNewDevice(nullptr));
        if (!device_) throw Error("deep screen space: Embree does not start; --processor gl does without");
    }

    /// Builds the discs of these levels, and forgets those of others. Stratified, all samples have the same,
    /// only in other sub-images: `sample` is then the first one.
    void build(Levels levels, int sample) {
        levels_.clear();
        levels_.resize(static_cast<std::size_t>(visible_.splats.hierarchy.levels));
        tbb::parallel_for(levels.first, levels.end, [&](int level) {
            const auto mask = (1u << 2 * level) - 1;
            levels_[static_cast<std::size_t>(level)] = std::make_unique<DiscLevel>(
                device_.get(), surfels_, rules_, level, *seen_, [&](const Surfel& surfel) {
                    return is_stratified()
                               ? surfel.order & mask
                               : random_sub_image(
                                     surfel, static_cast<unsigned>(level),
                                     static_cast<unsigned>(visible_.splats.first_sample + sample), seed_);
                });
        });
        if (rtcGetDeviceError(device_.get()) != RTC_ERROR_NONE)
            throw Error("deep screen space: Embree has no room for the discs of " +
                        std::to_string(surfels_.size()) + " surfels; raise surfel_radius");
    }

    /// Calls `to` with the number and the place of each pixel of the tile.
    template <class To>
    void each_pixel(std::int64_t tile, const To& to) const {
        each_texel(tile, glm::ivec2(width_, height_), [&](glm::uvec2 pixel) { to(number_of(pixel), pixel); });
    }

    /// The same with the pixels that stand in a tile of the level, and their places there: those of a
    /// sub-image meet the same discs.
    template <class To>
    void each_pixel(std::int64_t tile, int level, const To& to) const {
        const auto& hierarchy = visible_.splats.hierarchy;
        const auto width = static_cast<std::size_t>(hierarchy.width);
        each_texel(tile, glm::ivec2(hierarchy.width, hierarchy.height), [&](glm::uvec2 place) {
            const auto word = layout_[static_cast<std::size_t>(level)][place.y * width + place.x];
            if (word != padding) to(number_of({word & 0xffff, word >> 16}), place);
        });
    }

    bool is_surface(std::size_t pixel) const { return positions_[pixel].w != 0; }

    /// What all rays of a pixel share.
    struct Origin {
        Receiver receiver;
        RayRanges::Start start;
        float known;  ///< m, up to which triangles decide; 0 where level 0 has discs
    };
    Origin origin(std::size_t pixel) const {
        const auto& parameters = visible_.splats.parameters;
        const auto start = ranges_->start(positions_[pixel]);
        return {{positions_[pixel], normals_[pixel], parameters.discs, parameters.borders == Borders::clipped,
                 parameters.backs == Backs::open, tree_.get(), glass_ ? &*glass_ : nullptr},
                start,
                parameters.level0 == Level0::triangles ? start.exact_reach : 0};
    }

    /// Where the pixel stands on the level.
    glm::uvec2 place(glm::uvec2 pixel, int level) const {
        const auto width = static_cast<std::size_t>(visible_.splats.hierarchy.width);
        const auto word = places_[static_cast<std::size_t>(level)][pixel.y * width + pixel.x];
        return {word & 0xffff, word >> 16};
    }

    /// Which sub-image of the level that is, and for each sample the cell of its discs.
    std::uint32_t sub_image(glm::uvec2 place, int level) const {
        const auto& hierarchy = visible_.splats.hierarchy;
        const auto at = place / (glm::uvec2(hierarchy.width, hierarchy.height) >> unsigned(level));
        return at.y << level | at.x;
    }
    std::uint32_t cell(std::uint32_t sub_image, int level, int sample) const {
        if (!is_stratified()) return sub_image;
        const auto offset =
            sub_image_offset(static_cast<unsigned>(level),
                             static_cast<unsigned>(visible_.splats.first_sample + sample), seed_);
        return (sub_image - offset) & ((1u << 2 * level) - 1);
    }

    void query(DiscRay& ray, std::uint32_t cell, int level, RayRanges::Range range) const {
        ray.winner = 0;
        levels_[static_cast<std::size_t>(level)]->query(ray, cell, range.near, range.far);
    }

    struct Winner {
        std::uint32_t number = 0;  ///< as in "splats.nearest"
        int level = -1;
        float distance = -1;  ///< m
    };

    /// What the ray met among the triangles that decide on level 0.
    passes::Hit exact_hit_of(const Origin& from, glm::vec3 direction_ws) const {
        if (from.known == 0) return {};
        const auto& receiver = from.receiver;
        const auto origin = passes::offset_origin(receiver.x_ws, receiver.geometric_normal_ws);
        if (!glass_) return tree_->closest_hit(origin, direction_ws, 0, from.known);
        return HostGlass::first_hit(*tree_, origin, direction_ws, from.known, [&](std::uint32_t triangle) {
            return glass_->passes_glass(triangle, glass_->slope(triangle, direction_ws), direction_ws);
        });
    }

    /// Before discs are queried.
    Winner first_winner(const Origin& from, glm::vec3 direction_ws) const {
        const auto hit = exact_hit_of(from, direction_ws);
        if (hit.is_hit()) return {exact_hit | hit.triangle, 0, hit.distance};
        return {};
    }

    /// Whether coarser levels may have another winner.
    bool is_open(std::uint32_t finer) const {
        return finer == 0 || (!(finer & exact_hit) && nearest_decides(visible_.splats));
    }

    /// After the finer levels, as combine.comp chooses.
    Winner winner(Winner finer, const Origin& from, glm::vec3 direction_ws, int level,
                  std::uint32_t cell) const {
        auto range = ranges_->of(level, from.start, direction_ws);
        DiscRay ray(from.receiver, direction_ws);
        ray.known = from.known;
        if (finer.number != 0) {
            range.far = std::min(range.far, finer.distance);
            ray.z = splat_z(rules_.influence, finer.distance);
        }
        query(ray, cell, level, range);
        if (ray.winner == 0) return finer;
        const auto& winner = surfels_[ray.winner - 1];
        return {ray.winner, level,
                splat_plane_distance(from.receiver.x_ws, direction_ws, winner.centre_ws, winner.normal_ws)};
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
    std::optional<HostGlass> glass_;
    int width_ = 0, height_ = 0;
    std::unique_ptr<std::remove_pointer_t<RTCDevice>, ReleaseDevice> device_;
    std::vector<std::unique_ptr<DiscLevel>> levels_;
};

/// Samples that meet the same discs.
struct Samples {
    int first, end;
};

/// Calls `run(splats, samples, stage, tile)` for all of them, stage by stage. Only the discs that one stage
/// of one sample needs are held, of `stages[i]`.
template <class Run>
void execute(graph::PassBuilder& pass, const VisibleSplats& visible, graph::ObjectRef bvh,
             const std::vector<Levels>& stages, const Run& make_run) {
    const auto& hierarchy = visible.splats.hierarchy;
    const bool shared = visible.splats.parameters.sub_images == SubImages::stratified;
    const int together = shared ? visible.splats.samples : 1;
    const auto tiles = tiles_of(hierarchy).count();
    const auto of_samples = tiles * static_cast<std::int64_t>(stages.size());
    const auto splats = std::make_shared<HostSplats>(visible, bvh);
    pass.reads(visible.splats.surfels.records, visible.splats.surfels.stored, hierarchy.places,
               hierarchy.layout, visible.gbuffer.position, visible.gbuffer.geometric_normal,
               visible.directions.directions);
    if (bvh.index >= 0) pass.reads(bvh);
    pass.execute_sliced(of_samples * visible.splats.samples / together, [=](PassContext& p, Slice slice) {
        const int threads = p.inputs().threads;
        tbb::task_arena arena(arena_size(threads));
        arena.execute([&] {
            if (slice.first) splats->begin(p);
            const auto run = make_run(p, slice);
            for (auto item = slice.begin; item < slice.end;) {
                const int sample = static_cast<int>(item / of_samples) * together;
                const auto stage = static_cast<int>(item % of_samples / tiles);
                const auto first = item % tiles, end = std::min(tiles, first + slice.end - item);
                if (first == 0) splats->build(stages[static_cast<std::size_t>(stage)], sample);
                tbb::parallel_for(first, end, [&](std::int64_t tile) {
                    run(*splats, Samples{sample, sample + together}, stage, tile);
                });
                item += end - first;
            }
        });
    });
}

/// The pass of the picture: only the winners of all levels together are looked for. Triangles first, then
/// level by level the pixels of a sub-image after each other, as they meet the same discs. Only the discs of
/// one level are held, which are most of what a large picture needs.
void declare_winners(graph::GraphBuilder& builder, const VisibleSplats& visible, graph::ObjectRef bvh,
                     const std::string& batch) {
    const auto distance = visible.samples.distance;
    auto pass = builder.pass("splat" + batch, graph::Queue::cpu);
    pass.has_two_bodies().writes(visible.nearest, visible.hit_level, distance);
    std::vector<Levels> stages{{0, 0}};
    for (int level = 0; level < visible.splats.hierarchy.levels; ++level)
        stages.push_back({level, level + 1});
    execute(pass, visible, bvh, stages, [=](const PassContext& p, Slice) {
        return [directions = graph::layers<const glm::vec4>(p, visible.directions.directions),
                nearest = graph::layers<std::uint32_t>(p, visible.nearest),
                levels = graph::layers<std::uint16_t>(p, visible.hit_level),
                distances = graph::layers<float>(p, distance)](const HostSplats& splats, Samples samples,
                                                               int stage, std::int64_t tile) {
            const auto store = [&](std::size_t layer, std::size_t index, const HostSplats::Winner& winner) {
                nearest[layer][index] = winner.number;
                levels[layer][index] = glm::packHalf1x16(static_cast<float>(winner.level));
                distances[layer][index] = winner.distance;
            };
            const auto each_ray = [&](std::size_t index, const auto& to) {
                for (int sample = samples.first; sample < samples.end; ++sample) {
                    const auto& direction = directions[static_cast<std::size_t>(sample)][index];
                    to(static_cast<std::size_t>(sample), direction, direction != glm::vec4(0));
                }
            };
            if (stage == 0) {
                splats.each_pixel(tile, [&](std::size_t index, glm::uvec2) {
                    const bool is_surface = splats.is_surface(index);
                    const auto from = splats.origin(index);
                    each_ray(index, [&](std::size_t layer, glm::vec3 direction, bool is_ray) {
                        store(layer, index,
                              is_surface && is_ray ? splats.first_winner(from, direction)
                                                   : HostSplats::Winner{});
                    });
                });
                return;
            }
            const int level = stage - 1;
            splats.each_pixel(tile, level, [&](std::size_t index, glm::uvec2 place) {
                if (!splats.is_surface(index)) return;
                const auto from = splats.origin(index);
                const auto sub_image = splats.sub_image(place, level);
                each_ray(index, [&](std::size_t layer, glm::vec3 direction, bool is_ray) {
                    const auto finer = nearest[layer][index];
                    if (!is_ray || !splats.is_open(finer)) return;
                    const HostSplats::Winner known{
                        finer, static_cast<int>(glm::unpackHalf1x16(levels[layer][index])),
                        distances[layer][index]};
                    const auto cell = splats.cell(sub_image, level, static_cast<int>(layer));
                    const auto found = splats.winner(known, from, direction, level, cell);
                    if (found.number != finer) store(layer, index, found);
                });
            });
        };
    });
}

/// The winners of each level by itself, as the device has them in any case.
void declare_levels(graph::GraphBuilder& builder, const VisibleSplats& visible, graph::ObjectRef bvh,
                    const std::string& batch) {
    auto pass = builder.pass("splat level by level" + batch, graph::Queue::cpu);
    pass.writes(visible.depth, visible.winner);
    const std::vector<Levels> all{{0, visible.splats.hierarchy.levels}};
    execute(pass, visible, bvh, all, [=](const PassContext& p, Slice slice) {
        const auto depths = graph::layers<float>(p, visible.depth);
        const auto winners = graph::layers<std::uint32_t>(p, visible.winner);
        if (slice.first) {
            for (const auto layer : depths) std::ranges::fill(layer, 1.0f);
            for (const auto layer : winners) std::ranges::fill(layer, 0u);
        }
        return [=, directions = graph::layers<const glm::vec4>(p, visible.directions.directions)](
                   const HostSplats& splats, Samples samples, int, std::int64_t tile) {
            const auto& hierarchy = visible.splats.hierarchy;
            const auto fill = [&](const HostSplats::Origin& from, std::size_t index, glm::uvec2 pixel,
                                  int sample) {
                const auto& direction = directions[static_cast<std::size_t>(sample)][index];
                if (direction == glm::vec4(0)) return;
                const auto hit = splats.exact_hit_of(from, direction);
                for (int level = 0; level < hierarchy.levels && !hit.is_hit(); ++level) {
                    DiscRay ray(from.receiver, direction);
                    ray.known = from.known;
                    const auto at = splats.place(pixel, level);
                    splats.query(ray, splats.cell(splats.sub_image(at, level), level, sample), level, {});
                    if (ray.winner == 0) continue;
                    const auto texel = at.y * static_cast<std::size_t>(hierarchy.width) + at.x;
                    const auto layer = static_cast<std::size_t>(sample * hierarchy.levels + level);
                    depths[layer][texel] = ray.z;
                    winners[layer][texel] = ray.winner;
                }
            };
            splats.each_pixel(tile, [&](std::size_t index, glm::uvec2 pixel) {
                if (!splats.is_surface(index)) return;
                const auto from = splats.origin(index);
                for (int sample = samples.first; sample < samples.end; ++sample)
                    fill(from, index, pixel, sample);
            });
        };
    });
}

}  // namespace

void splat_on_host(graph::GraphBuilder& builder, const VisibleSplats& visible, const std::string& batch) {
    graph::ObjectRef bvh;
    if (needs_triangles(visible.splats.parameters)) bvh = passes::bvh(builder);
    declare_winners(builder, visible, bvh, batch);
    declare_levels(builder, visible, bvh, batch);
}

}  // namespace ir::methods::deep_screen_space
