#include "renderers/methods/ldm-indirect/tracing/host/split_on_host.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <optional>
#include <span>

#include "renderers/graph/pass_context.h"
#include "renderers/methods/ldm-indirect/looks.h"
#include "renderers/methods/ldm-indirect/tracing/first_hits.h"
#include "renderers/methods/ldm-indirect/tracing/host/children.h"
#include "renderers/methods/ldm-indirect/tracing/host/landings.h"
#include "renderers/methods/ldm-indirect/tracing/host/overhang.h"
#include "renderers/passes/ldm/host/first_hit.h"
#include "renderers/passes/ldm/host/trace_on_host.h"
#include "renderers/passes/surface/triangle_plane.h"

namespace ir::methods::ldm_indirect {
namespace {

namespace ldm = passes::ldm;
using Clock = std::chrono::steady_clock;

/// A primary photon that splits, as tracing needs it.
struct Source {
    glm::vec3 position_ws, normal_ws, shading_ws;
    std::uint32_t primary;
    float per_cosine;  ///< 1 / Σ|cosθ|
    Spread spread;
};

/// A child that is stored.
struct Hit {
    std::uint32_t source;  ///< place among the sources
    float distance;
    std::uint32_t normal, beyond;
};

/// Of each source and cause: photons, and their part of the flux as a whole number. Any thread may add, and
/// sums are the same in any order.
class WholeShares {
  public:
    void assign(std::size_t sources) { sums_.assign(sources * causes, 0); }
    void add(std::size_t source, Cause cause, float part) {
        const auto place = source * causes + static_cast<std::size_t>(cause);
        const auto amount = one_photon + static_cast<std::uint64_t>(part * scale + 0.5f);
        std::atomic_ref(sums_[place]).fetch_add(amount, std::memory_order_relaxed);
    }
    Shares of(std::size_t source) const {
        Shares result;
        for (std::size_t cause = 0; cause < causes; ++cause) {
            const auto sum = sums_[source * causes + cause];
            result.photons[cause] = static_cast<std::uint32_t>(sum / one_photon);
            result.part[cause] = static_cast<float>(sum % one_photon) / scale;
        }
        return result;
    }

  private:
    /// All parts of a source add up to 1, and there are at most 65,536 maps.
    static constexpr float scale = float(1u << 30);
    static constexpr std::uint64_t one_photon = std::uint64_t{1} << 40;
    std::vector<std::uint64_t> sums_;
};

/// What one thread works with.
struct Worker {
    explicit Worker(int resolution) : map(resolution, ldm::Holds::lists) {}
    ldm::StreamedMap map;
    ldm::BuildScratch scratch;
    double build_ms = 0, query_ms = 0;
};

/// Traces and stores the photons of a frame.
class HostSplit {
  public:
    HostSplit(ldm::MapsPointer maps, const Parameters& parameters, int threads)
        : maps_(std::move(maps)),
          parameters_(parameters),
          rule_(ldm::self_hit_rule(parameters.maps)),
          half_turn_(parameters.footprint == Footprint::widened
                         ? std::sqrt(2 / static_cast<float>(parameters.maps.directions))
                         : 0.0f),
          arena_(threads),
          workers_(static_cast<std::size_t>(std::min(threads, maps_->layout.maps)),
                   Worker(maps_->layout.resolution)) {}

    std::int64_t first_slice() const { return static_cast<std::int64_t>(workers_.size()); }

    void begin(const graph::FrameInputs& inputs, std::span<const Primary> primaries) {
        ellipses_.emplace(ellipses(inputs, parameters_));
        sources_.clear();
        for (std::size_t i = 0; i < primaries.size(); ++i)
            if (splits(primaries[i])) sources_.push_back(source_of(primaries[i], i));
        shares_.assign(sources_.size());
        for (auto& worker : workers_) {  // a frame begins anew where a buffer has to grow
            worker.scratch.fragments_made = 0;
            worker.build_ms = worker.query_ms = 0;
        }
        hits_.assign(maps_->frames.size(), {});
    }

    /// What looks start from. They are asked for on the side of the geometric normal.
    void take_pixels(const ldm::SurfaceImages& images) {
        arena_.execute([&] { ldm::fill_pixel_tiles(tiles_, images); });
        for (int axis = 0; axis < 3; ++axis) tiles_.normal[axis] = tiles_.geometric_normal[axis];
    }
    /// Where looks are written.
    struct Looks {
        std::span<std::uint8_t> looks;  ///< empty: nobody asks
        float units_per_metre = 0;
    };

    struct Task {
        const ldm::HostScene& scene;
        const scene::World& world;
        const LandingView& view;
        Looks looks;
        FirstHits::Find first_hit;  ///< in place of the maps; empty: they answer
        std::span<const Primary> primaries;
    };

    /// Maps begin … end - 1.
    void trace(const graph::PassContext& context, const Task& task, graph::Slice slice) {
        std::atomic<std::int64_t> next{slice.begin};
        arena_.execute([&] {
            tbb::parallel_for(
                std::size_t{0}, workers_.size(),
                [&](std::size_t i) {
                    for (auto map = next++; map < slice.end && !context.cancel().is_cancelled(); map = next++)
                        trace_map(task, workers_[i], static_cast<std::size_t>(map));
                },
                tbb::simple_partitioner());
        });
        context.cancel().check();
    }

    void write_shares(std::span<Shares> shares) const {
        std::fill(shares.begin(), shares.end(), Shares{});
        for (std::size_t i = 0; i < sources_.size(); ++i) shares[sources_[i].primary] = shares_.of(i);
    }

    /// Writes the records from place `first` on, as far as there is room, in the order of sources, then of
    /// maps. Returns how many there are.
    std::size_t store(std::span<const Primary> primaries, std::span<Photon> photons, std::size_t first) {
        std::vector<std::size_t> places(sources_.size() + 1, 0);
        for (const auto& hits : hits_)
            for (const auto& hit : hits) ++places[hit.source + 1];
        for (std::size_t i = 1; i < places.size(); ++i) places[i] += places[i - 1];
        const auto count = places.back();
        constexpr std::size_t grain = 256;
        arena_.execute([&] {
            tbb::parallel_for(tbb::blocked_range<std::size_t>(0, sources_.size(), grain),
                              [&](const auto& range) {
                                  store_range(primaries, photons, first, range.begin(), range.end(), places);
                              });
        });
        return count;
    }

    void report(const graph::PassContext& context, const ldm::HostCounters& counters) const {
        std::vector<ldm::HostWork> work;
        for (const auto& worker : workers_)
            work.push_back({worker.scratch.fragments_made, worker.scratch.bytes() + worker.map.bytes(),
                            worker.build_ms, worker.query_ms});
        counters.report(context, maps_->layout, work);
    }

  private:
    static bool splits(const Primary& p) {
        return p.fate == primary_splits && reflected_flux(p) != glm::vec3(0);
    }

    Source source_of(const Primary& p, std::size_t index) const {
        const float turn =
            std::sqrt(glm::dot(p.turn_u, p.turn_u) + glm::dot(p.turn_v, p.turn_v) + half_turn_ * half_turn_);
        const float axis = std::sqrt(glm::dot(p.axis_u, p.axis_u) + glm::dot(p.axis_v, p.axis_v));
        return {p.position_ws,    p.normal_ws,
                p.shading_ws,     static_cast<std::uint32_t>(index),
                1 / p.cosine_sum, {axis, turn, parameters_.clipping != Clipping::none}};
    }

    static double ms_since(Clock::time_point start) {
        return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
    }

    void trace_map(const Task& task, Worker& worker, std::size_t map) {
        if (task.first_hit) {
            const auto start = Clock::now();
            trace_rays(task, map);
            worker.query_ms += ms_since(start);
            if (task.looks.looks.empty()) return;
        }
        const int resolution = maps_->layout.resolution, rows = ldm::StreamedMap::band_rows(resolution);
        auto& hits = hits_[map];
        for (int row = 0; row < resolution; row += rows) {
            const auto start = Clock::now();
            ldm::build_map(task.scene.meshlets, task.scene.masks, maps_->frames[map], row,
                           std::min(rows, resolution - row), worker.map, worker.scratch);
            worker.build_ms += ms_since(start);
            const auto built = Clock::now();
            if (!task.first_hit) trace_band(task, worker, map);
            if (!task.looks.looks.empty()) look(task.looks, worker.map, map);
            worker.query_ms += ms_since(built);
        }
        if (rows < resolution)  // bands know them in parts
            std::sort(hits.begin(), hits.end(),
                      [](const Hit& a, const Hit& b) { return a.source < b.source; });
    }

    /// Where a hit is, and of what surface.
    Arrival arrival(const ldm::PointTracer& tracer, const ldm::MapFrame& frame, const Source& s, bool forward,
                    const ldm::FirstHit& hit) const {
        const glm::vec3 v(frame.direction), step_u(frame.step_u), step_v(frame.step_v);
        Arrival a;
        a.origin = s.position_ws;
        a.direction = forward ? v : -v;
        a.map_normal = -a.direction;
        float distance = hit.distance;
        if (parameters_.landing == LandingBy::plane) {
            const auto plane = tracer.plane_at(hit.column, hit.row, hit.entry);
            a.has_surface = plane.is_known;
            if (plane.is_known) {
                const auto x = tracer.project(s.position_ws);
                const auto from_centre = glm::vec2(x) - glm::vec2(hit.column, hit.row) - 0.5f;
                const float depth = static_cast<float>(hit.entry) + glm::dot(plane.slope, from_centre);
                distance = forward ? depth - x.z : x.z - depth;
                a.map_normal = tracer.normal_of(plane, a.direction);
            }
        }
        a.distance = std::max(distance, 0.0f) * frame.direction.w;
        a.error = entry_error(s.normal_ws, a.direction, step_u, step_v);
        a.step_u = step_u;
        a.step_v = step_v;
        a.spread = s.spread;
        return a;
    }

    /// As look.comp does, for a band of a map.
    void look(const Looks& to, const ldm::StreamedMap& band, std::size_t map) const {
        static_assert(look_tile == ldm::PixelTiles::side);
        constexpr std::size_t pixels = ldm::PixelTiles::pixels, tiles_at_once = 16;
        const float units = band.frame.direction.w * to.units_per_metre;
        const bool is_first = band.first_row == 0;
        float seen[tiles_at_once * pixels];
        for (std::size_t first = 0; first < tiles_.count(); first += tiles_at_once) {
            const auto end = std::min(first + tiles_at_once, tiles_.count());
            ldm::see_along(tiles_, first, end, band, rule_, seen);
            for (auto tile = first; tile < end; ++tile) {
                auto* const looks = to.looks.data() + look_place(tile, maps_->frames.size(), map);
                const auto* const distances = seen + (tile - first) * pixels;
                for (std::size_t i = 0; i < pixels; ++i)
                    if (distances[i] >= 0)
                        looks[i] = static_cast<std::uint8_t>(packed_look(distances[i] * units));
                    else if (is_first)
                        looks[i] = 0;
            }
        }
    }

    /// Of all photons that leave along a map's direction, or against it: `land` has those that leave above
    /// their triangle, and nothing where another band of the map answers. Says of the others that they lie
    /// below it.
    template <class Land>
    void split_along(std::size_t map, bool counts_below, const Land& land) {
        const glm::vec3 v(maps_->frames[map].direction);
        for (std::size_t i = 0; i < sources_.size(); ++i) {
            const auto& s = sources_[i];
            const float cosine = glm::dot(s.shading_ws, v);
            const bool forward = cosine > 0;
            const auto direction = forward ? v : -v;
            std::optional<Landing> at;
            if (glm::dot(s.normal_ws, direction) > 0)
                at = land(s, forward, direction);
            else if (counts_below)
                at = Landing{Cause::below, 0, {}};
            if (!at) continue;
            shares_.add(i, at->cause, std::abs(cosine) * s.per_cosine);
            if (at->cause >= Cause::stored)
                hits_[map].push_back(
                    {static_cast<std::uint32_t>(i), at->distance, packed_direction(at->normal_ws), 0});
        }
    }

    void trace_band(const Task& task, const Worker& worker, std::size_t map) {
        const ldm::PointTracer tracer(worker.map, rule_);
        const auto& frame = worker.map.frame;
        const auto first = hits_[map].size();
        split_along(map, worker.map.first_row == 0,
                    [&](const Source& s, bool forward, const glm::vec3&) -> std::optional<Landing> {
                        const auto hit = tracer.trace(s.position_ws, s.normal_ws, forward);
                        if (!hit.is_here) return {};
                        if (!hit.is_found) return Landing{Cause::left, 0, {}};
                        return task.view.land(arrival(tracer, frame, s, forward, hit));
                    });
        if (parameters_.overhang == Overhang::lost || parameters_.clipping != Clipping::none) return;
        for (auto& hit : std::span(hits_[map]).subspan(first)) {
            MendedFootprints mended;  // counted where they are splatted
            const Child child{static_cast<std::uint32_t>(map), hit.distance, hit.normal, 0};
            const auto photon = photon_of(task.primaries[sources_[hit.source].primary], child,
                                          glm::vec3(frame.direction), half_turn_);
            hit.beyond = part_beyond(tracer, frame, photon, ellipses_->make(photon, mended));
        }
    }

    /// Where rays find the hits, in place of a map's bands.
    void trace_rays(const Task& task, std::size_t map) {
        split_along(map, true,
                    [&](const Source& s, bool, const glm::vec3& direction) -> std::optional<Landing> {
                        const auto hit = task.first_hit(s.position_ws, s.normal_ws, direction);
                        if (!hit.is_hit()) return Landing{Cause::left, 0, {}};
                        return task.view.land(arrival_of_ray(task.world, s, direction, hit));
                    });
    }

    static Arrival arrival_of_ray(const scene::World& world, const Source& s, const glm::vec3& direction,
                                  const passes::Hit& hit) {
        const auto normal = passes::triangle_normal(world, hit.triangle);
        Arrival a;
        a.origin = s.position_ws;
        a.direction = direction;
        a.distance = hit.distance;
        a.error = 0;
        a.step_u = a.step_v = glm::vec3(0);
        a.spread = s.spread;
        a.has_surface = normal != glm::vec3(0);
        a.map_normal = !a.has_surface ? -direction : glm::dot(normal, direction) < 0 ? normal : -normal;
        return a;
    }

    void store_range(std::span<const Primary> primaries, std::span<Photon> photons, std::size_t first,
                     std::size_t begin, std::size_t end, const std::vector<std::size_t>& starts) const {
        std::vector<std::size_t> places(starts.begin() + static_cast<std::ptrdiff_t>(begin),
                                        starts.begin() + static_cast<std::ptrdiff_t>(end));
        for (std::size_t map = 0; map < hits_.size(); ++map) {
            const auto& hits = hits_[map];
            const glm::vec3 direction(maps_->frames[map].direction);
            auto hit = std::lower_bound(hits.begin(), hits.end(), begin,
                                        [](const Hit& h, std::size_t source) { return h.source < source; });
            for (; hit != hits.end() && hit->source < end; ++hit) {
                const auto place = first + places[hit->source - begin]++;
                if (place >= photons.size()) continue;
                const Child child{static_cast<std::uint32_t>(map), hit->distance, hit->normal, hit->beyond};
                photons[place] =
                    photon_of(primaries[sources_[hit->source].primary], child, direction, half_turn_);
            }
        }
    }

    ldm::MapsPointer maps_;
    Parameters parameters_;
    ldm::SelfHitRule rule_;
    float half_turn_;
    std::optional<EllipseMaker> ellipses_;
    tbb::task_arena arena_;
    std::vector<Worker> workers_;
    ldm::PixelTiles tiles_;
    std::vector<Source> sources_;
    WholeShares shares_;
    std::vector<std::vector<Hit>> hits_;  ///< by map, in the order of the sources
};

/// Primary photons that were stored themselves.
std::size_t count_direct(std::span<const std::uint32_t> fates) {
    const auto first = static_cast<std::uint32_t>(Cause::stored);
    return static_cast<std::size_t>(
        std::ranges::count_if(fates, [&](std::uint32_t fate) { return fate == first || fate == first + 1; }));
}

}  // namespace

void split_on_host(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, const ldm::MapsPointer& maps,
                   const Primaries& primaries, Photons& photons, std::optional<graph::BufferRef> direct_fates,
                   const Parameters& parameters) {
    const auto meshlets = ldm::declare_meshlets(builder, maps->options.detail);
    const auto counters = ldm::declare_host_counters(builder);
    std::optional<FirstHits> first_hits;
    if (ray_tracer(parameters)) first_hits.emplace(builder, *maps, parameters);
    const auto split = std::make_shared<HostSplit>(maps, parameters, ldm::host_threads(builder.inputs()));
    const auto stored = builder.buffer({.text = {.key = "indirect.stored",
                                                 .label = "Photons to read",
                                                 .doc = "Those stored, as far as the buffer reaches.",
                                                 .semantic = Semantic::count},
                                        .fields = {{"photons", graph::FieldType::u32}},
                                        .elements = 1});
    photons.stored = stored;
    auto pass = builder.pass("trace photons through maps", graph::Queue::cpu);
    pass.has_two_bodies()
        .reads(meshlets, primaries.records, gbuffer.position, gbuffer.normal, gbuffer.geometric_normal)
        .writes(primaries.shares, photons.records, stored)
        .counts(photons.count)
        .counts(counters.fragments)
        .counts(counters.texels)
        .counts(counters.bytes);
    if (direct_fates) pass.reads(*direct_fates);
    if (first_hits) first_hits->read_by(pass);
    if (photons.looks) pass.writes(*photons.looks);
    const auto run = [=, looks = photons.looks, records = photons.records, count_of = photons.count](
                         graph::PassContext& context, graph::Slice slice) {
        const auto all = context.elements<const Primary>(primaries.records);
        if (slice.first) split->begin(context.inputs(), all);
        const auto& view = context.inputs().view;
        const LandingView landing(landing_constants(context.inputs(), parameters), parameters,
                                  {view.width, view.height},
                                  context.pixels<const glm::vec4>(gbuffer.position),
                                  context.pixels<const glm::vec4>(gbuffer.geometric_normal));
        HostSplit::Looks to;
        if (looks) to = {context.elements<std::uint8_t>(*looks), units_per_metre(*context.inputs().world)};
        if (looks && slice.first)
            split->take_pixels({view.width, view.height, context.pixels<const glm::vec4>(gbuffer.position),
                                context.pixels<const std::uint64_t>(gbuffer.normal),
                                context.pixels<const glm::vec4>(gbuffer.geometric_normal)});
        const auto scene = context.object<ldm::HostScene>(meshlets);
        split->trace(context,
                     {*scene, *context.inputs().world, landing, to,
                      first_hits ? first_hits->in(context) : FirstHits::Find{}, all},
                     slice);
        if (!slice.last) return;
        split->write_shares(context.elements<Shares>(primaries.shares));
        const auto before =
            direct_fates ? count_direct(context.elements<const std::uint32_t>(*direct_fates)) : 0;
        const auto count = split->store(all, context.elements<Photon>(records), before);
        context.add(count_of, static_cast<std::uint32_t>(count));
        context.elements<std::uint32_t>(stored)[0] =
            static_cast<std::uint32_t>(std::min<std::uint64_t>(before + count, context.capacity(records)));
        split->report(context, counters);
    };
    pass.execute_sliced(maps->layout.maps, run, split->first_slice());
}

}  // namespace ir::methods::ldm_indirect
