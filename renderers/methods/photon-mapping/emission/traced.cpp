#include "renderers/methods/photon-mapping/emission/traced.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <sstream>

#include "renderers/core/constants.h"
#include "renderers/core/parallel_for.h"
#include "renderers/passes/lights/punctual.h"
#include "renderers/passes/sampling/point_sequence.h"
#include "shaders/methods/photon-mapping/emission/emitted.glsl.h"

namespace ir::methods::photon_mapping {
namespace {

/// Pairs of numbers of a ray.
enum EmissionDimension : std::uint32_t { of_place, of_direction };

/// The rays of one frame. Emitters are chosen by evenly spaced numbers, so that each has the same number of
/// rays in every frame, one after the other.
class EmissionRays {
  public:
    EmissionRays(const graph::FrameInputs& inputs, const Sources& sources, const EmissionSets& sets,
                 std::uint64_t count)
        : surfaces_(*inputs.scene, *inputs.world, false, false),
          sampler_(surfaces_, sources.traced),
          sources_(sources),
          sets_(sets),
          count_(count),
          key_(passes::mixed(sets.seed())),
          shift_(static_cast<double>(passes::mixed(key_) >> 11) * 0x1p-53) {}

    void fill(std::uint64_t i, passes::RayRecord& ray, EmittedRay& emitted) const {
        ray = {{0, 0, 0}, 0, {0, 0, 1}, 0};
        emitted = {};
        const passes::PathSampler numbers(key_, static_cast<std::uint32_t>(sets_.stratum * count_ + i));
        const auto light = sampler_.sample(choice(i), numbers.pair(of_place), numbers.pair(of_direction));
        if (!light) return;
        ray.origin_ws = light->origin_ws;
        ray.direction_ws = light->direction_ws;
        ray.far = light->range > 0 ? light->range : infinity;
        emitted.power = light->flux / static_cast<float>(count_);
        emitted.range = light->range;
        emitted.light = light_name(light->emitter);
        emitted.has_extent = !is_punctual(light->emitter);
    }

    /// The sources with their points, numbered behind those of maps.
    std::vector<SourceData> rows(std::uint64_t from_maps) const {
        auto rows = sources_.traced_rows;
        for (std::size_t r = 0; r < rows.size(); ++r) {
            const auto first = rays_before(place_of(emitter_of_row(r)));
            rows[r].first_point = static_cast<std::uint32_t>(from_maps + first);
            rows[r].points = static_cast<std::uint32_t>(rays_before(place_of(emitter_of_row(r)) + 1) - first);
        }
        return rows;
    }

  private:
    bool is_punctual(int emitter) const {
        return emitter >= 0 &&
               passes::is_punctual(surfaces_.world().lights[static_cast<std::size_t>(emitter)]);
    }
    float choice(std::uint64_t i) const {
        constexpr float below_one = 0x1.fffffep-1f;
        const double at = static_cast<double>(i) + (sets_.stratum + shift_) / sets_.strata;
        return std::min(static_cast<float>(at / static_cast<double>(count_)), below_one);
    }
    /// In the order in which they are chosen.
    static std::int64_t place_of(int emitter) {
        constexpr std::int64_t behind = std::numeric_limits<int>::max();
        return emitter >= 0 ? emitter : behind - emitter;  // meshes, environment
    }
    int emitter_of_row(std::size_t row) const {
        if (row < sources_.traced.lights.size()) return sources_.traced.lights[row];
        return sources_.traced_rows[row].light == light_sky ? passes::EmissionSampler::environment
                                                            : passes::EmissionSampler::emissive_mesh;
    }
    /// By halves: clang 14 cannot compile std::views::iota for std::ranges::partition_point.
    std::uint64_t rays_before(std::int64_t place) const {
        std::uint64_t before = 0, end = count_;
        while (before < end) {
            const auto middle = before + (end - before) / 2;
            if (place_of(sampler_.emitter(choice(middle))) < place)
                before = middle + 1;
            else
                end = middle;
        }
        return before;
    }

    passes::SurfaceLookup surfaces_;
    passes::EmissionSampler sampler_;
    Sources sources_;
    EmissionSets sets_;
    std::uint64_t count_;
    std::uint64_t key_;
    double shift_;
};

/// Of the rays: they stay while these do.
std::string fingerprint_of(const graph::FrameInputs& inputs, const Sources& sources,
                           const EmissionPoints& points, const EmissionSets& sets) {
    if (inputs.world_fingerprint.empty()) return "";
    std::ostringstream text;
    text << inputs.world_fingerprint << " seed " << sets.seed() << " stratum " << sets.stratum << '/'
         << sets.strata << " points " << points.from_maps << '/' << points.count << " meshes "
         << sources.traced.emissive_meshes << " environment " << sources.traced.environment << " lights";
    for (const int light : sources.traced.lights) text << ' ' << light;
    return text.str();
}

void start_rays(graph::GraphBuilder& builder, const TracedEmission& traced, const Sources& sources,
                const EmissionPoints& points, const EmissionSets& sets) {
    const auto made = std::make_shared<std::unique_ptr<EmissionRays>>();
    const auto count = points.count - points.from_maps, from_maps = points.from_maps;
    builder.pass("emission rays", graph::Queue::cpu)
        .writes(traced.rays.rays, traced.emitted, traced.rows)
        .execute_sliced(
            static_cast<std::int64_t>(count),
            [=](graph::PassContext& context, graph::Slice slice) {
                if (!*made) *made = std::make_unique<EmissionRays>(context.inputs(), sources, sets, count);
                const auto rays = context.elements<passes::RayRecord>(traced.rays.rays);
                const auto emitted = context.elements<EmittedRay>(traced.emitted);
                const int threads = context.inputs().threads;
                parallel_for(threads, slice.begin, slice.end, [&](std::int64_t i) {
                    const auto at = static_cast<std::size_t>(i);
                    (*made)->fill(at, rays[at], emitted[at]);
                });
                if (!slice.last) return;
                std::ranges::copy((*made)->rows(from_maps),
                                  context.elements<SourceData>(traced.rows).begin());
            },
            first_points_slice);
}

/// Constants of hits.comp.
struct LightHits {
    unsigned all_points, stratum, seed_low, seed_high, first_traced;
    SurfaceRules rules;
    bool normal_maps;
    unsigned capacity;  ///< 0 where only survivors are found
    float power_unit, photons_per_point;
    IR_FIELDS(all_points, stratum, seed_low, seed_high, first_traced, rules, normal_maps, capacity,
              power_unit, photons_per_point)
};

LightHits light_hits(const graph::FrameInputs& inputs, const Sources& sources, const EmissionPoints& points,
                     const Parameters& parameters) {
    const auto sets = emission_sets(inputs, sources, points, parameters);
    return {.all_points = sets.all_points,
            .stratum = sets.stratum,
            .seed_low = sets.seed_low,
            .seed_high = sets.seed_high,
            .first_traced = static_cast<unsigned>(points.from_maps),
            .rules = surface_rules(*inputs.scene, parameters),
            .normal_maps = parameters.transport.normal_maps,
            .capacity = 0,
            .power_unit = points.samples.power_unit,
            .photons_per_point = static_cast<float>(points.samples.photons_per_point)};
}

gl::ProgramSource source_of_hits(bool packs) {
    return {{"methods/photon-mapping/emission/hits.comp"}, {{"PACKS", packs ? "1" : "0"}}};
}

void read_hits(graph::PassBuilder& pass, const TracedEmission& traced) {
    traced.surfaces.read_by(pass);
    pass.reads("Rays", traced.rays.rays).reads("Hits", traced.rays.hits).reads("Emitted", traced.emitted);
}

std::int64_t rays_of(const EmissionPoints& points) {
    return static_cast<std::int64_t>(points.count - points.from_maps);
}

}  // namespace

TracedEmission trace_emission(graph::GraphBuilder& builder, const passes::SceneBuffers& scene,
                              const Sources& sources, const EmissionPoints& points,
                              const Parameters& parameters) {
    const auto& inputs = builder.inputs();
    const auto sets = emission_sets(inputs, sources, points, parameters);
    const auto fingerprint = fingerprint_of(inputs, sources, points, sets);
    const auto elements = std::max<std::uint64_t>(1, static_cast<std::uint64_t>(rays_of(points)));
    TracedEmission traced;
    traced.rays = passes::declare_rays(builder, "emission", elements, fingerprint);
    traced.emitted =
        builder.buffer({.text = {.key = "emission.emitted", .label = "What rays from lights carry"},
                        .fields = record_fields<EmittedRay>(),
                        .elements = elements,
                        .fingerprint = fingerprint});
    traced.rows = builder.buffer({.text = {.key = "emission.traced_sources", .label = "What rays start from"},
                                  .fields = record_fields<SourceData>(),
                                  .elements = std::max<std::uint64_t>(1, sources.traced_rows.size()),
                                  .fingerprint = fingerprint});
    start_rays(builder, traced, sources, points, sets);
    passes::trace_rays(builder, "trace emission", scene, tracer_of(builder.inputs(), parameters), traced.rays,
                       parameters.cube);
    traced.surfaces = passes::hit_surfaces(builder, scene);
    return traced;
}

void survive_hits(graph::GraphBuilder& builder, const TracedEmission& traced, const Sources& sources,
                  const EmissionPoints& points, const Parameters& parameters) {
    auto pass = builder.pass("traced emission points");
    read_hits(pass, traced);
    pass.writes("Survivors", points.survivors);
    pass.compute_sliced(source_of_hits(false), rays_of(points),
                        light_hits(builder.inputs(), sources, points, parameters), first_points_slice);
}

void pack_hits(graph::GraphBuilder& builder, const TracedEmission& traced, const Sources& sources,
               const EmissionPoints& points, const Parameters& parameters) {
    const auto hits = light_hits(builder.inputs(), sources, points, parameters);
    auto pass = builder.pass("traced sample points");
    read_hits(pass, traced);
    pass.reads("Places", points.places).writes("Samples", points.samples.points);
    pass.compute_sliced(
        source_of_hits(true), rays_of(points),
        [hits, packed = points.samples.points](const graph::PassContext& p) {
            auto constants = hits;
            constants.capacity = static_cast<unsigned>(p.capacity(packed));
            return constants;
        },
        first_points_slice);
}

}  // namespace ir::methods::photon_mapping
