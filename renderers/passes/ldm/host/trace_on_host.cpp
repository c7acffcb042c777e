#include "renderers/passes/ldm/host/trace_on_host.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>

#include "renderers/graph/pass_context.h"
#include "renderers/passes/ldm/host/first_hit.h"
#include "renderers/passes/ldm/host/kept_maps.h"
#include "renderers/passes/ldm/sky.h"

namespace ir::passes::ldm {
namespace {

using Clock = std::chrono::steady_clock;

/// Each pass over the pixels queries so many maps, if they and the pixels' sums leave room in a thread's
/// cache.
constexpr int max_together = 8;
constexpr std::uint64_t cache_bytes = 5 << 18;
/// What the maps of all threads may take which are not kept.
constexpr std::uint64_t memory_bytes = 24 << 20;
/// For choosing how many: a list holds 6 to 8 depths.
constexpr std::uint64_t expected_depths = 8;

/// Maps that a thread holds at once.
int maps_together(int resolution, Holds holds, int threads) {
    const auto texels = static_cast<std::uint64_t>(StreamedMap::band_rows(resolution)) * resolution;
    const auto bytes = texels * (holds == Holds::outermost ? 4
                                 : holds == Holds::lists   ? 4 + 2 * expected_depths
                                                           : 4 + 4 * expected_depths);
    const auto room = std::min(cache_bytes, memory_bytes / static_cast<std::uint64_t>(threads));
    return static_cast<int>(std::clamp<std::uint64_t>(room / bytes, 1, max_together));
}

/// What one thread works with.
struct Worker {
    std::vector<StreamedMap> maps;
    BuildScratch scratch;
    std::vector<std::uint32_t> sums;
    SelfHitCounts counts;
    std::vector<std::uint64_t> sky;  ///< by pixel: V cosθ L in three channels, and cosθ, in whole numbers
    std::uint64_t built = 0;         ///< maps
    double build_ms = 0, query_ms = 0;

    std::uint64_t map_bytes() const {
        auto bytes = scratch.bytes();
        for (const auto& map : maps) bytes += map.bytes();
        return bytes;
    }
};

/// The images of the G-buffer that the maps are queried for.
struct Surfaces {
    graph::ImageRef position, normal, geometric_normal;
};

/// So many tiles are one item of work: a whole number of vectors.
constexpr std::size_t tiles_at_once = 64;

/// Calls `run(first, end)` for ranges of tiles on all threads of the arena.
template <class Run>
void over_tiles(tbb::task_arena& arena, std::size_t count, Run run) {
    arena.execute([&] {
        tbb::parallel_for(std::size_t{0}, (count + tiles_at_once - 1) / tiles_at_once, [&](std::size_t i) {
            run(i * tiles_at_once, std::min((i + 1) * tiles_at_once, count));
        });
    });
}

/// Builds and queries all maps of a frame, slice by slice.
class Stream {
  public:
    /// Queries maps for all pixels, once for each group of maps that a thread has built.
    using Query = std::function<void(const PixelTiles&, Worker&, std::span<const StreamedMap>)>;
    using Prepare = std::function<void(const PixelTiles&, Worker&)>;
    /// Queries maps that are kept for tiles first … end - 1. Their sums are the first worker's.
    using QueryTiles = std::function<void(const PixelTiles&, std::size_t first, std::size_t end,
                                          std::span<const StreamedMap>, Worker&)>;

    Stream(graph::ObjectRef scene, graph::ObjectRef kept, std::shared_ptr<const Maps> maps, Surfaces surfaces,
           Holds holds, int threads)
        : scene_(scene),
          kept_(kept),
          maps_(std::move(maps)),
          surfaces_(surfaces),
          holds_(holds),
          arena_(threads),
          workers_(static_cast<std::size_t>(std::min(threads, maps_->layout.maps))) {
        together_ = maps_together(maps_->layout.resolution, holds, threads);
    }

    std::int64_t first_slice() const { return static_cast<std::int64_t>(workers_.size()) * together_; }
    const PixelTiles& tiles() const { return tiles_; }
    std::vector<Worker>& workers() { return workers_; }
    tbb::task_arena& arena() { return arena_; }

    void begin(const graph::PassContext& context, const Prepare& prepare) {
        const auto shape = context.shape(surfaces_.position);
        arena_.execute([&] {
            fill_pixel_tiles(
                tiles_, {.width = shape.width,
                         .height = shape.height,
                         .position = context.pixels<const glm::vec4>(surfaces_.position),
                         .normal = context.pixels<const std::uint64_t>(surfaces_.normal),
                         .geometric_normal = context.pixels<const glm::vec4>(surfaces_.geometric_normal)});
        });
        for (auto& worker : workers_) {
            while (static_cast<int>(worker.maps.size()) < together_)
                worker.maps.emplace_back(maps_->layout.resolution, holds_);
            prepare(tiles_, worker);
        }
    }

    /// Maps begin … end - 1.
    void run(const graph::PassContext& context, std::int64_t begin, std::int64_t end, const Query& query,
             const QueryTiles& query_tiles) {
        const auto scene = context.object<HostScene>(scene_);
        const auto kept = is_kept() ? context.object<KeptMaps>(kept_) : nullptr;
        const auto kept_end = std::clamp(kept ? kept->count() : 0, begin, end);
        if (begin < kept_end) run_kept(context, *scene, *kept, begin, kept_end, query_tiles);
        if (kept_end < end) run_streamed(context, *scene, kept_end, end, query);
        context.cancel().check();
    }

    void report(const graph::PassContext& context, const HostCounters& counters,
                graph::CounterRef built_maps) const {
        std::vector<HostWork> work;
        std::uint64_t built = 0;
        for (const auto& worker : workers_) {
            work.push_back(
                {worker.scratch.fragments_made, worker.map_bytes(), worker.build_ms, worker.query_ms});
            built += worker.built;
        }
        if (is_kept()) work.front().bytes += context.object<KeptMaps>(kept_)->bytes();
        counters.report(context, maps_->layout, work);
        context.add(built_maps, static_cast<std::uint32_t>(built));
    }

  private:
    bool is_kept() const { return kept_.index >= 0; }

    static double ms_between(Clock::time_point start, Clock::time_point end) {
        return std::chrono::duration<double, std::milli>(end - start).count();
    }

    /// Calls `work(worker, first, end)` for groups of so many maps in all threads.
    template <class Work>
    void by_workers(const graph::PassContext& context, std::int64_t begin, std::int64_t end,
                    std::int64_t group, Work work) {
        std::atomic<std::int64_t> next{begin};
        arena_.execute([&] {
            tbb::parallel_for(
                std::size_t{0}, workers_.size(),
                [&](std::size_t i) {
                    while (!context.cancel().is_cancelled()) {
                        const auto first = next.fetch_add(group);
                        if (first >= end) return;
                        work(workers_[i], first, std::min(first + group, end));
                    }
                },
                tbb::simple_partitioner());
        });
    }

    /// Builds all maps, one at a time, and then queries all of them for tiles, few at a time: no thread waits
    /// for long, and what is known of a tile is read once.
    void run_kept(const graph::PassContext& context, const HostScene& scene, KeptMaps& kept,
                  std::int64_t begin, std::int64_t end, const QueryTiles& query) {
        const int resolution = maps_->layout.resolution, rows = StreamedMap::band_rows(resolution);
        for (int row = 0; row < resolution; row += rows) {
            const auto start = Clock::now();
            by_workers(context, begin, end, 1, [&](Worker& worker, std::int64_t map, std::int64_t) {
                kept.build(scene, *maps_, map, row, worker.scratch, worker.built);
            });
            if (context.cancel().is_cancelled()) return;
            const auto built = Clock::now();
            const auto maps = kept.bands(begin, end, row);
            over_tiles(arena_, tiles_.count(), [&](std::size_t first, std::size_t end_tile) {
                if (!context.cancel().is_cancelled()) query(tiles_, first, end_tile, maps, workers_.front());
            });
            const auto queried = Clock::now();
            for (auto& worker : workers_) {
                worker.build_ms += ms_between(start, built);
                worker.query_ms += ms_between(built, queried);
            }
        }
    }

    void run_streamed(const graph::PassContext& context, const HostScene& scene, std::int64_t begin,
                      std::int64_t end, const Query& query) {
        // Groups of one size, as many for each thread, so that none waits for long.
        const auto count = static_cast<std::int64_t>(workers_.size());
        const auto rounds = (end - begin + count * together_ - 1) / (count * together_);
        const auto group = (end - begin + rounds * count - 1) / (rounds * count);
        by_workers(context, begin, end, group, [&](Worker& worker, std::int64_t first, std::int64_t last) {
            stream(scene, worker, first, last, query);
        });
    }
    /// Maps first … end - 1.
    void stream(const HostScene& scene, Worker& worker, std::int64_t first, std::int64_t end,
                const Query& query) {
        const int resolution = maps_->layout.resolution, rows = StreamedMap::band_rows(resolution);
        worker.built += static_cast<std::uint64_t>(end - first);
        for (int row = 0; row < resolution; row += rows) {
            const auto start = Clock::now();
            for (auto map = first; map < end; ++map)
                build_map(scene.meshlets, scene.masks, maps_->frames[static_cast<std::size_t>(map)], row,
                          std::min(rows, resolution - row),
                          worker.maps[static_cast<std::size_t>(map - first)], worker.scratch);
            const auto built = Clock::now();
            query(tiles_, worker,
                  std::span<const StreamedMap>(worker.maps).first(static_cast<std::size_t>(end - first)));
            worker.build_ms += ms_between(start, built);
            worker.query_ms += ms_between(built, Clock::now());
        }
    }

    graph::ObjectRef scene_, kept_;  ///< kept_: may be absent
    std::shared_ptr<const Maps> maps_;
    Surfaces surfaces_;
    Holds holds_;
    tbb::task_arena arena_;
    std::vector<Worker> workers_;
    PixelTiles tiles_;
    int together_ = 1;
};

Holds lists_of(const Maps& maps) {
    return maps.layout.keeps_slopes() ? Holds::sloped_lists : Holds::lists;
}

/// Declares a pass that streams all maps.
struct StreamPass {
    std::string name;
    Holds holds;
    graph::ObjectRef kept;            ///< KeptMaps; absent: no map is kept
    graph::ObjectRef also_read = {};  ///< may be absent
    std::function<void(const graph::PassContext&)> begin = [](const auto&) {};  ///< of each frame
    Stream::Prepare prepare;
    Stream::Query query;
    Stream::QueryTiles query_tiles = {};  ///< where there are kept maps
    std::function<void(const graph::PassContext&, Stream&)> finish;
};

void declare(graph::GraphBuilder& builder, const GBuffer& gbuffer, graph::ObjectRef meshlets,
             const std::shared_ptr<const Maps>& maps, graph::ImageRef target, const StreamPass& what) {
    const auto counters = declare_host_counters(builder);
    const auto built_maps = builder.counter({.key = "ldm.maps_built",
                                             .label = "Maps built",
                                             .doc = "In this frame: the others are kept from earlier ones."});
    const auto stream = std::make_shared<Stream>(
        meshlets, what.kept, maps, Surfaces{gbuffer.position, gbuffer.normal, gbuffer.geometric_normal},
        what.holds, host_threads(builder.inputs()));
    auto pass = builder.pass(what.name, graph::Queue::cpu);
    if (what.kept.index >= 0) pass.reads(what.kept);
    if (what.also_read.index >= 0) pass.reads(what.also_read);
    pass.has_two_bodies()
        .reads(meshlets, gbuffer.position, gbuffer.normal, gbuffer.geometric_normal)
        .writes(target)
        .counts(counters.fragments)
        .counts(counters.texels)
        .counts(built_maps)
        .counts(counters.bytes)
        .execute_sliced(
            maps->layout.maps,
            [=](graph::PassContext& context, graph::Slice slice) {
                if (slice.first) {
                    what.begin(context);
                    stream->begin(context, what.prepare);
                }
                stream->run(context, slice.begin, slice.end, what.query, what.query_tiles);
                if (!slice.last) return;
                what.finish(context, *stream);
                stream->report(context, counters, built_maps);
            },
            stream->first_slice());
}

/// Calls `put(pixel, place)` for all pixels of the picture, row by row.
template <class Put>
void for_each_pixel(const PixelTiles& tiles, Put put) {
    tbb::parallel_for(0, tiles.height, [&](int y) {
        for (int x = 0; x < tiles.width; ++x)
            put(static_cast<std::size_t>(y) * tiles.width + x, tiles.place(x, y));
    });
}

void write_sums(const graph::PassContext& context, Stream& stream, const Maps& maps, float scale,
                graph::ImageRef target) {
    constexpr std::size_t pixels = PixelTiles::pixels;
    const auto& tiles = stream.tiles();
    auto& sums = stream.workers().front().sums;
    const auto out = context.pixels<glm::vec2>(target);
    const auto write = [&](std::size_t tile, const std::uint32_t* cosines) {
        const auto corner = tiles.corner(tile);
        for (int y = 0; y < std::min(PixelTiles::side, tiles.height - corner.y); ++y)
            for (int x = 0; x < std::min(PixelTiles::side, tiles.width - corner.x); ++x) {
                const auto within = static_cast<std::size_t>(y * PixelTiles::side + x);
                out[static_cast<std::size_t>(corner.y + y) * tiles.width + corner.x + x] =
                    glm::vec2(static_cast<float>(sums[tile * pixels + within]),
                              static_cast<float>(cosines[within])) /
                    scale;
            }
    };
    over_tiles(stream.arena(), tiles.count(), [&](std::size_t first, std::size_t end) {
        std::uint32_t cosines[tiles_at_once * pixels];
        sum_cosines(tiles, first, end, maps.frames, scale, cosines);
        for (std::size_t i = 1; i < stream.workers().size(); ++i)
            for (auto p = first * pixels; p < end * pixels; ++p) sums[p] += stream.workers()[i].sums[p];
        for (auto tile = first; tile < end; ++tile) write(tile, cosines + (tile - first) * pixels);
    });
}

void write_counts(const graph::PassContext& context, Stream& stream, graph::ImageRef target) {
    auto& counts = stream.workers().front().counts;
    for (std::size_t i = 1; i < stream.workers().size(); ++i) counts.add(stream.workers()[i].counts);
    const auto out = context.pixels<glm::vec4>(target);
    for_each_pixel(stream.tiles(), [&](std::size_t pixel, std::size_t place) {
        const float own = counts.own[place], queried = counts.queried[place];
        out[pixel] = {own, queried, queried - own, counts.rejected[place]};
    });
}

/// What the environment's light is measured in: the order of sums does not matter then.
constexpr double sky_scale = double(std::uint64_t{1} << 40);

/// Adds to a pixel's sums what maps say of the environment.
class SkyQuery {
  public:
    SkyQuery(const Maps& maps, const std::vector<glm::vec3>& regions, const SelfHitRule& rule,
             const Visibility& visibility)
        : maps_(maps), regions_(regions), rule_(rule), visibility_(visibility) {
        for (const auto& light : regions) brightest_ = std::max({brightest_, light.r, light.g, light.b});
    }
    float unit() const { return brightest_; }

    void query(const PixelTiles& tiles, const StreamedMap& map, std::vector<std::uint64_t>& sums) const {
        const PointTracer tracer(map, rule_);
        const auto same = [&](const MapFrame& f) { return f.direction == map.frame.direction; };
        const auto number =
            static_cast<std::size_t>(std::ranges::find_if(maps_.frames, same) - maps_.frames.begin());
        const glm::vec3 v(map.frame.direction);
        for (std::size_t place = 0; place < tiles.count() * PixelTiles::pixels; ++place) {
            if (!(tiles.valid[place / PixelTiles::pixels] >> place % PixelTiles::pixels & 1)) continue;
            const auto at = [&](const PixelTiles::Values(&values)[3]) {
                return glm::vec3(values[0][place], values[1][place], values[2][place]);
            };
            const float cosine = glm::dot(at(tiles.normal), v);
            auto* sum = &sums[4 * place];
            if (map.first_row == 0) sum[3] += whole(std::abs(cosine));
            const bool forward = cosine > 0;
            const auto& light = regions_[2 * number + (forward ? 0 : 1)];
            const auto normal = at(tiles.geometric_normal);
            if (cosine == 0 || light == glm::vec3(0) || (glm::dot(normal, v) > 0) != forward) continue;
            const auto hit = tracer.trace(at(tiles.position), normal, forward);
            if (!hit.is_here) continue;
            const float seen = open(hit, map.frame.direction.w) * std::abs(cosine) / brightest_;
            for (int c = 0; c < 3; ++c) sum[c] += whole(seen * light[c]);
        }
    }

  private:
    static std::uint64_t whole(float value) { return static_cast<std::uint64_t>(value * sky_scale + 0.5); }
    float open(const FirstHit& hit, float metres_per_quantum) const {
        if (!hit.is_found) return 1;
        if (visibility_.max_distance == 0) return 0;
        const float part = std::max(hit.distance, 0.0f) * metres_per_quantum / visibility_.max_distance;
        return part >= 1 ? 1.0f : visibility_.smooth ? part * part : 0.0f;
    }

    const Maps& maps_;
    const std::vector<glm::vec3>& regions_;
    SelfHitRule rule_;
    Visibility visibility_;
    float brightest_ = 0;
};

}  // namespace

SelfHitRule self_hit_rule(const MapParameters& parameters, NodeKind nodes) {
    return {.tangent_plane = parameters.self_hit == SelfHit::tangent_plane,
            .quanta = parameters.self_hit_tolerance,
            .slope = parameters.slope_tolerance * (nodes == NodeKind::sloped ? sloped_tolerance : 1),
            .offset = parameters.normal_offset,
            .max_dip = parameters.max_dip};
}

void trace_on_host(graph::GraphBuilder& builder, const GBuffer& gbuffer, graph::ObjectRef meshlets,
                   const std::shared_ptr<const Maps>& maps, const SelfHitRule& rule,
                   const Visibility& visibility, bool stands_still, graph::ImageRef sums) {
    const float scale = sum_scale(maps->layout.maps);
    StreamPass pass;
    pass.name = "build and trace maps";
    // Without a limit of distance a ray is open where nothing of its texel lies beyond. The nearest entry,
    // which the rule normal-offset asks for, takes a list.
    pass.holds = visibility.max_distance == 0 && rule.tangent_plane ? Holds::outermost : lists_of(*maps);
    if (stands_still && pass.holds == Holds::outermost) pass.kept = declare_kept(builder, maps);
    pass.prepare = [](const PixelTiles& tiles, Worker& worker) {
        worker.sums.assign(tiles.count() * PixelTiles::pixels, 0);
    };
    pass.query = [=](const PixelTiles& tiles, Worker& worker, std::span<const StreamedMap> some) {
        add_visibility(tiles, 0, tiles.count(), some, rule, visibility, scale, worker.sums);
    };
    pass.query_tiles = [=](const PixelTiles& tiles, std::size_t first, std::size_t end,
                           std::span<const StreamedMap> some, Worker& worker) {
        add_visibility(tiles, first, end, some, rule, visibility, scale, worker.sums);
    };
    pass.finish = [=](const graph::PassContext& context, Stream& stream) {
        write_sums(context, stream, *maps, scale, sums);
    };
    declare(builder, gbuffer, meshlets, maps, sums, pass);
}

void count_self_hits_on_host(graph::GraphBuilder& builder, const GBuffer& gbuffer, graph::ObjectRef meshlets,
                             const std::shared_ptr<const Maps>& maps, const SelfHitRule& rule,
                             graph::ImageRef counts) {
    StreamPass pass;
    pass.name = "build and trace maps for self-hits";
    pass.holds = lists_of(*maps);
    pass.prepare = [](const PixelTiles& tiles, Worker& worker) {
        worker.counts.resize(tiles.count() * PixelTiles::pixels);
    };
    pass.query = [=](const PixelTiles& tiles, Worker& worker, std::span<const StreamedMap> some) {
        count_self_hits(tiles, some, rule, worker.counts);
    };
    pass.finish = [=](const graph::PassContext& context, Stream& stream) {
        write_counts(context, stream, counts);
    };
    declare(builder, gbuffer, meshlets, maps, counts, pass);
}

void trace_sky_on_host(graph::GraphBuilder& builder, const GBuffer& gbuffer, graph::ObjectRef meshlets,
                       const MapsPointer& maps, const Sky& sky, const SelfHitRule& rule) {
    const auto regions = std::make_shared<std::shared_ptr<std::vector<glm::vec3>>>();
    StreamPass pass;
    pass.name = "build and trace maps for the sky";
    pass.holds = lists_of(*maps);
    pass.also_read = sky.regions;
    pass.begin = [=](const graph::PassContext& context) {
        *regions = context.object<std::vector<glm::vec3>>(sky.regions);
    };
    pass.prepare = [](const PixelTiles& tiles, Worker& worker) {
        worker.sky.assign(4 * tiles.count() * PixelTiles::pixels, 0);
    };
    pass.query = [=](const PixelTiles& tiles, Worker& worker, std::span<const StreamedMap> some) {
        const SkyQuery sky_query(*maps, **regions, rule, sky.visibility);
        for (const auto& map : some) sky_query.query(tiles, map, worker.sky);
    };
    pass.finish = [=](const graph::PassContext& context, Stream& stream) {
        const SkyQuery sky_query(*maps, **regions, rule, sky.visibility);
        auto& sums = stream.workers().front().sky;
        for (std::size_t i = 1; i < stream.workers().size(); ++i)
            for (std::size_t p = 0; p < sums.size(); ++p) sums[p] += stream.workers()[i].sky[p];
        const auto out = context.pixels<glm::vec4>(sky.sums);
        for_each_pixel(stream.tiles(), [&](std::size_t pixel, std::size_t place) {
            const auto* sum = &sums[4 * place];
            const auto part = [&](int c) { return static_cast<float>(double(sum[c]) / sky_scale); };
            out[pixel] = glm::vec4(sky_query.unit() * glm::vec3(part(0), part(1), part(2)), part(3));
        });
    };
    declare(builder, gbuffer, meshlets, maps, sky.sums, pass);
}

}  // namespace ir::passes::ldm
