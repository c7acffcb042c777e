#include "renderers/passes/ldm/host/trace_on_host.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <chrono>
#include <functional>

#include "renderers/graph/pass_context.h"
#include "renderers/passes/raytracing/alpha_masks.h"

namespace ir::passes::ldm {
namespace {

using Clock = std::chrono::steady_clock;

/// Each pass over the pixels asks so many maps, if they and the pixels' sums leave room in a thread's cache.
constexpr int most_together = 8;
constexpr std::uint64_t cache_bytes = 5 << 18;
/// What the maps of all threads may take.
constexpr std::uint64_t memory_bytes = 48 << 20;
/// For choosing how many: a list holds 6 to 8 depths.
constexpr std::uint64_t expected_depths = 8;

/// Maps that a thread holds at once.
int maps_together(int resolution, Holds holds, int threads) {
    const auto texels = static_cast<std::uint64_t>(StreamedMap::band_rows(resolution)) * resolution;
    const auto bytes = texels * (holds == Holds::outermost ? 4 : 4 + 2 * expected_depths);
    const auto room = std::min(cache_bytes, memory_bytes / static_cast<std::uint64_t>(threads));
    return static_cast<int>(std::clamp<std::uint64_t>(room / bytes, 1, most_together));
}

/// What one thread works with.
struct Worker {
    std::vector<StreamedMap> maps;
    BuildScratch scratch;
    std::vector<std::uint32_t> sums;
    SelfHitCounts counts;
    double build_ms = 0, ask_ms = 0;

    std::uint64_t map_bytes() const {
        auto bytes = scratch.bytes();
        for (const auto& map : maps) bytes += map.bytes();
        return bytes;
    }
};

/// The images of the G-buffer that the maps are asked for.
struct Surfaces {
    graph::ImageRef position, normal, geometric_normal;
};

/// Builds and asks all maps of a frame, slice by slice.
class Stream {
  public:
    /// Asks maps for all pixels, once for each group of maps that a thread has built.
    using Ask = std::function<void(const PixelTiles&, Worker&, std::size_t maps)>;
    using Prepare = std::function<void(const PixelTiles&, Worker&)>;

    Stream(graph::ObjectRef scene, std::shared_ptr<const Maps> maps, Surfaces surfaces, Holds holds,
           int threads)
        : scene_(scene),
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
            tiles_ = make_pixel_tiles(shape.width, shape.height,
                                      context.pixels<const glm::vec4>(surfaces_.position),
                                      context.pixels<const std::uint64_t>(surfaces_.normal),
                                      context.pixels<const glm::vec4>(surfaces_.geometric_normal));
        });
        for (auto& worker : workers_) {
            while (static_cast<int>(worker.maps.size()) < together_)
                worker.maps.emplace_back(maps_->layout.resolution, holds_);
            prepare(tiles_, worker);
        }
    }

    /// Maps begin … end - 1.
    void run(const graph::PassContext& context, std::int64_t begin, std::int64_t end, const Ask& ask) {
        const auto scene = context.object<HostScene>(scene_);
        const auto count = static_cast<std::int64_t>(workers_.size());
        // Groups of one size, as many for each thread, so that none waits for long.
        const auto rounds = (end - begin + count * together_ - 1) / (count * together_);
        const auto group = (end - begin + rounds * count - 1) / (rounds * count);
        std::atomic<std::int64_t> next{begin};
        arena_.execute([&] {
            tbb::parallel_for(
                std::size_t{0}, workers_.size(),
                [&](std::size_t i) {
                    while (!context.cancel().is_cancelled()) {
                        const auto first = next.fetch_add(group);
                        if (first >= end) return;
                        work(*scene, workers_[i], first, std::min(first + group, end), ask);
                    }
                },
                tbb::simple_partitioner());
        });
        context.cancel().check();
    }

    void report(const graph::PassContext& context, const HostCounters& counters) const {
        std::uint64_t made = 0, held = 0;
        double build_ms = 0, ask_ms = 0;
        for (const auto& worker : workers_) {
            made += worker.scratch.fragments_made;
            held += worker.map_bytes();
            build_ms += worker.build_ms;
            ask_ms += worker.ask_ms;
        }
        context.add(counters.fragments, static_cast<std::uint32_t>(made));
        context.add(counters.texels,
                    static_cast<std::uint32_t>(maps_->layout.map_texels() * maps_->layout.maps));
        context.add(counters.bytes, static_cast<std::uint32_t>(held));
        const auto threads = static_cast<double>(workers_.size());
        context.notes().set_figure("ldm.build_ms", build_ms / threads);
        context.notes().set_figure("ldm.ask_ms", ask_ms / threads);
    }

  private:
    void work(const HostScene& scene, Worker& worker, std::int64_t first, std::int64_t end, const Ask& ask) {
        const int resolution = maps_->layout.resolution, rows = StreamedMap::band_rows(resolution);
        for (int row = 0; row < resolution; row += rows) {
            const auto start = Clock::now();
            for (auto map = first; map < end; ++map)
                build_map(scene.meshlets, scene.masks, maps_->frames[static_cast<std::size_t>(map)], row,
                          std::min(rows, resolution - row),
                          worker.maps[static_cast<std::size_t>(map - first)], worker.scratch);
            const auto built = Clock::now();
            ask(tiles_, worker, static_cast<std::size_t>(end - first));
            worker.build_ms += std::chrono::duration<double, std::milli>(built - start).count();
            worker.ask_ms += std::chrono::duration<double, std::milli>(Clock::now() - built).count();
        }
    }

    graph::ObjectRef scene_;
    std::shared_ptr<const Maps> maps_;
    Surfaces surfaces_;
    Holds holds_;
    tbb::task_arena arena_;
    std::vector<Worker> workers_;
    PixelTiles tiles_;
    int together_ = 1;
};

/// Declares a pass that streams all maps.
struct StreamPass {
    std::string name;
    Holds holds;
    Stream::Prepare prepare;
    Stream::Ask ask;
    std::function<void(const graph::PassContext&, Stream&)> finish;
};

void declare(graph::GraphBuilder& builder, const GBuffer& gbuffer, graph::ObjectRef meshlets,
             const std::shared_ptr<const Maps>& maps, graph::ImageRef target, const StreamPass& what) {
    const auto counters = declare_host_counters(builder);
    const auto stream = std::make_shared<Stream>(
        meshlets, maps, Surfaces{gbuffer.position, gbuffer.normal, gbuffer.geometric_normal}, what.holds,
        host_threads(builder.inputs()));
    builder.pass(what.name, graph::Queue::cpu)
        .has_two_bodies()
        .reads(meshlets, gbuffer.position, gbuffer.normal, gbuffer.geometric_normal)
        .writes(target)
        .counts(counters.fragments)
        .counts(counters.texels)
        .counts(counters.bytes)
        .execute_sliced(
            maps->layout.maps,
            [=](graph::PassContext& context, graph::Slice slice) {
                if (slice.first) stream->begin(context, what.prepare);
                stream->run(context, slice.begin, slice.end, what.ask);
                if (!slice.last) return;
                what.finish(context, *stream);
                stream->report(context, counters);
            },
            stream->first_slice());
}

/// Calls `run` for ranges of tiles on all threads.
void over_tiles(Stream& stream, const std::function<void(std::size_t, std::size_t)>& run) {
    constexpr std::size_t grain = 64;
    stream.arena().execute([&] {
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, stream.tiles().count(), grain),
                          [&](const auto& range) { run(range.begin(), range.end()); });
    });
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
    const auto& tiles = stream.tiles();
    std::vector<std::uint32_t> cosines(tiles.count() * PixelTiles::pixels, 0);
    auto& sums = stream.workers().front().sums;
    over_tiles(stream, [&](std::size_t first, std::size_t end) {
        sum_cosines(tiles, first, end, maps.frames, scale, cosines);
        for (std::size_t i = 1; i < stream.workers().size(); ++i)
            for (auto p = first * PixelTiles::pixels; p < end * PixelTiles::pixels; ++p)
                sums[p] += stream.workers()[i].sums[p];
    });
    const auto out = context.pixels<glm::vec2>(target);
    stream.arena().execute([&] {
        for_each_pixel(tiles, [&](std::size_t pixel, std::size_t place) {
            out[pixel] =
                glm::vec2(static_cast<float>(sums[place]), static_cast<float>(cosines[place])) / scale;
        });
    });
}

void write_counts(const graph::PassContext& context, Stream& stream, graph::ImageRef target) {
    auto& counts = stream.workers().front().counts;
    for (std::size_t i = 1; i < stream.workers().size(); ++i) counts.add(stream.workers()[i].counts);
    const auto out = context.pixels<glm::vec4>(target);
    for_each_pixel(stream.tiles(), [&](std::size_t pixel, std::size_t place) {
        const float own = counts.own[place], asked = counts.asked[place];
        out[pixel] = {own, asked, asked - own, counts.rejected[place]};
    });
}

}  // namespace

SelfHitRule self_hit_rule(const MapParameters& parameters) {
    return {.tangent_plane = parameters.self_hit == SelfHit::tangent_plane,
            .quanta = parameters.self_hit_tolerance,
            .slope = parameters.slope_tolerance,
            .offset = parameters.normal_offset,
            .max_dip = parameters.max_dip};
}

int host_threads(const graph::FrameInputs& inputs) {
    return inputs.threads > 0 ? inputs.threads : tbb::info::default_concurrency();
}

HostCounters declare_host_counters(graph::GraphBuilder& builder) {
    return {builder.counter({.key = "ldm.fragments",
                             .label = "Fragments",
                             .doc = "Made by rasterising the scene into all maps."}),
            builder.counter({.key = "ldm.texels", .label = "Texels", .doc = "Of all maps."}),
            builder.counter({.key = "ldm.bytes",
                             .label = "Memory of maps",
                             .doc = "Bytes that the maps take which are in memory at once, and "
                                    "building them."})};
}

graph::ObjectRef declare_meshlets(graph::GraphBuilder& builder) {
    graph::ObjectDesc desc;
    desc.text.key = "ldm.meshlets";
    desc.text.label = "Meshlets";
    desc.text.doc = "The scene's triangles in groups that lie together, for maps that are built on the host.";
    desc.fingerprint = builder.inputs().geometry_fingerprint;
    const auto result = builder.object(desc);
    builder.pass("meshlets", graph::Queue::cpu).writes(result).execute([result](graph::PassContext& context) {
        const auto& inputs = context.inputs();
        const auto made = std::make_shared<HostScene>(HostScene{make_meshlets(*inputs.world, inputs.threads),
                                                                AlphaMasks(*inputs.scene, *inputs.world)});
        context.store(result, made, made->meshlets.bytes() + made->masks.bytes());
    });
    return result;
}

void trace_on_host(graph::GraphBuilder& builder, const GBuffer& gbuffer, graph::ObjectRef meshlets,
                   const std::shared_ptr<const Maps>& maps, const SelfHitRule& rule,
                   const Visibility& visibility, graph::ImageRef sums) {
    const float scale = sum_scale(maps->layout.maps);
    StreamPass pass;
    pass.name = "build and trace maps";
    // Without a limit of distance a ray is open where nothing of its texel lies beyond. The nearest entry,
    // which the rule normal-offset asks for, takes a list.
    pass.holds = visibility.max_distance == 0 && rule.tangent_plane ? Holds::outermost : Holds::lists;
    pass.prepare = [](const PixelTiles& tiles, Worker& worker) {
        worker.sums.assign(tiles.count() * PixelTiles::pixels, 0);
    };
    pass.ask = [=](const PixelTiles& tiles, Worker& worker, std::size_t count) {
        add_visibility(tiles, 0, tiles.count(), std::span(worker.maps).first(count), rule, visibility, scale,
                       worker.sums);
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
    pass.holds = Holds::lists;
    pass.prepare = [](const PixelTiles& tiles, Worker& worker) {
        worker.counts.resize(tiles.count() * PixelTiles::pixels);
    };
    pass.ask = [=](const PixelTiles& tiles, Worker& worker, std::size_t count) {
        count_self_hits(tiles, std::span(worker.maps).first(count), rule, worker.counts);
    };
    pass.finish = [=](const graph::PassContext& context, Stream& stream) {
        write_counts(context, stream, counts);
    };
    declare(builder, gbuffer, meshlets, maps, counts, pass);
}

}  // namespace ir::passes::ldm
