#include "renderers/methods/ldm-indirect/tracing/extended_emission.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "renderers/core/constants.h"
#include "renderers/core/parallel_for.h"
#include "renderers/graph/pass_context.h"
#include "renderers/methods/ldm-indirect/tracing/sending_surfaces.h"
#include "renderers/passes/direct/direct_light.h"
#include "renderers/passes/lights/emission_sampler.h"
#include "renderers/passes/raytracing/bvh.h"
#include "renderers/passes/raytracing/open_part.h"
#include "renderers/passes/sampling/point_sequence.h"
#include "renderers/passes/scene/light_data.h"
#include "renderers/passes/scene/progressive.h"
#include "renderers/scene/frame.h"

namespace ir::methods::ldm_indirect {
namespace {

/// A photon is the first one of so many rays that is of use. In a lamp's light that comes in through a small
/// opening, one ray each would leave a few photons of thousands.
constexpr std::uint32_t rays_of_photon = 8;
/// By which it is found out whether what its first surface reflects meets anything.
constexpr std::uint32_t trial_rays = 2;

/// Pairs of numbers of a ray; further ones are of rays in gaps.
enum EmissionDimension : std::uint32_t {
    of_place,
    of_direction,
    of_use,
    of_trial,
    of_gap = of_trial + trial_rays
};

/// Of n photons each has 1/n of the places, and 1/n of the directions; ellipses have these areas. (Places and
/// directions spread together, so a photon stands for more: 1/n of both in m² sr. But what it lights reflects
/// diffusely, and then only matters how far apart photons arrive, from wherever.)
Spacing spacing_of(const passes::EmittedLight& light, float photons) {
    const float n = pi * photons * light.probability;
    return {std::sqrt(1 / (n * light.area_pdf)), std::min(std::sqrt(1 / (n * light.direction_pdf)), 1.0f)};
}

/// Emits the photons of a frame.
class ExtendedEmission {
  public:
    ExtendedEmission(const graph::FrameInputs& inputs, std::shared_ptr<const SendingSurfaces> surfaces,
                     const ExtendedPhotons& photons, const Parameters& parameters)
        : seed_(photon_seed(inputs, parameters)),
          photons_(photons),
          surfaces_(std::move(surfaces)),
          lamps_(surfaces_->lookup(), {.lights = extended_lights(*inputs.world), .environment = false}),
          environment_(surfaces_->lookup(), {.emissive_meshes = false}) {}

    /// `number` among all of them, `source` among the primary photons.
    Primary photon(const passes::Bvh& bvh, std::uint64_t number, std::uint32_t source) const {
        const bool is_lamp = number < photons_.lamps;
        const auto all = static_cast<std::uint32_t>(is_lamp ? photons_.lamps : photons_.environment);
        const auto index = static_cast<std::uint32_t>(is_lamp ? number : number - photons_.lamps);
        const float choice = (static_cast<float>(index) + 0.5f) / static_cast<float>(all);
        const auto& sources = is_lamp ? lamps_ : environment_;
        Ray chosen;
        int emitted = 0, useful = 0;
        for (std::uint32_t i = 0; i < rays_of_photon; ++i) {
            const passes::PathSampler random(seed_ + (is_lamp ? 0 : 1), index + i * all);
            Ray ray;
            ray.random = random;
            ray.light = sources.sample(choice, random.pair(of_place), random.pair(of_direction));
            if (!ray.light) continue;
            ++emitted;
            ray.hit = bvh.closest_hit(ray.light->origin_ws, ray.light->direction_ws, 0, infinity);
            ray.use = use_of(bvh, ray);
            const bool is_useful = random.pair(of_use).x < ray.use;
            if (!chosen.light || (is_useful && useful == 0)) chosen = ray;
            useful += is_useful;
        }
        Primary primary = SendingSurfaces::nothing(source);
        if (!chosen.light) return primary;
        primary.light = light_of(*chosen.light);
        const auto whole = chosen.light->flux / static_cast<float>(all);
        const float shining = static_cast<float>(emitted) / static_cast<float>(rays_of_photon);
        primary.emitted = shining * whole;
        primary.direction_ws = chosen.light->direction_ws;
        if (useful == 0) return primary;
        // It stands for its part of the rays, and for those that were left out because they are of less use.
        const float part = static_cast<float>(useful) / (static_cast<float>(rays_of_photon) * chosen.use);
        primary.emitted = part * whole;
        primary.missed = shining / part - 1;
        primary.path_length = chosen.hit.distance;
        surfaces_->arrive(primary, surfaces_->lookup().at(chosen.hit, chosen.light->direction_ws));
        if (primary.fate != primary_splits) return primary;
        // Directions of what is infinitely far do not spread on their way.
        SendingSurfaces::spread(primary, spacing_of(*chosen.light, static_cast<float>(all) / part),
                                is_lamp ? chosen.hit.distance : 0);
        if (const float narrow = surfaces_->narrow(); chosen.hit.distance < narrow)
            primary.reflectance *=
                passes::open_part(bvh, primary.position_ws, primary.normal_ws, narrow, chosen.random, of_gap);
        return primary;
    }

  private:
    struct Ray {
        passes::PathSampler random;
        std::optional<passes::EmittedLight> light;
        passes::Hit hit;
        float use = 0;  ///< probability with which it is taken
    };
    /// What its first surface reflects is of more use where something else is in sight of it.
    float use_of(const passes::Bvh& bvh, const Ray& ray) const {
        if (!ray.hit.is_hit()) return 0;
        const auto at = surfaces_->lookup().at(ray.hit, ray.light->direction_ws);
        const auto around = scene::frame_around(at.geometric_normal_ws);
        const auto origin = passes::offset_origin(at.position_ws, at.geometric_normal_ws);
        std::uint32_t met = 0;
        for (std::uint32_t i = 0; i < trial_rays; ++i)
            met += bvh.occluded(
                origin, glm::normalize(around * passes::sample_cosine_ts(ray.random.pair(of_trial + i))), 0,
                infinity);
        return static_cast<float>(met + 1) / (trial_rays + 1);
    }
    static std::vector<int> extended_lights(const scene::World& world) {
        std::vector<int> result;
        for (std::size_t i = 0; i < world.lights.size(); ++i)
            if (passes::shadow_layers(world.lights[i]) == 0) result.push_back(static_cast<int>(i));
        return result;
    }
    static std::uint32_t light_of(const passes::EmittedLight& light) {
        if (light.emitter == passes::EmissionSampler::environment) return light_environment;
        if (light.emitter == passes::EmissionSampler::emissive_mesh) return light_mesh;
        return std::min(static_cast<std::uint32_t>(light.emitter), light_mesh - 1);
    }

    std::uint64_t seed_;
    ExtendedPhotons photons_;
    std::shared_ptr<const SendingSurfaces> surfaces_;
    passes::EmissionSampler lamps_, environment_;
};

constexpr std::int64_t first_emission_slice = 256;

}  // namespace

ExtendedPhotons extended_photons(const graph::FrameInputs& inputs, const Parameters& parameters) {
    if (parameters.transport.paths == Transport::Paths::direct) return {};
    const auto photons =
        static_cast<std::uint64_t>(parameters.emission) * static_cast<std::uint64_t>(parameters.emission);
    const auto sources = passes::extended_sources(
        inputs, passes::extended_light_options(parameters.light, parameters.transport));
    return {sources.flat_lights + sources.emissive_triangles > 0 ? photons : 0,
            sources.environment ? 6 * photons : 0};
}

void emit_from_extended(graph::GraphBuilder& builder, const Primaries& primaries, graph::ObjectRef surfaces,
                        const Parameters& parameters) {
    const auto photons = primaries.extended;
    if (photons.count() == 0) return;
    const auto bvh = passes::bvh(builder);
    const auto emission = builder.object(
        {.text = {.key = "indirect.emission",
                  .label = "Sources with an extent",
                  .doc = "Lights, emissive triangles and the environment, as photons leave them."}});
    builder.pass("extended sources", graph::Queue::cpu)
        .reads(surfaces)
        .writes(emission)
        .execute([=](graph::PassContext& context) {
            context.store(
                emission,
                std::make_shared<ExtendedEmission>(
                    context.inputs(), context.object<SendingSurfaces>(surfaces), photons, parameters),
                sizeof(ExtendedEmission));
        });
    builder.pass("emit photons of extended sources", graph::Queue::cpu)
        .reads(bvh, emission)
        .writes(primaries.records)
        .execute_sliced(
            static_cast<std::int64_t>(photons.count()),
            [=](graph::PassContext& context, graph::Slice slice) {
                const auto traced = context.object<passes::Bvh>(bvh);
                const auto emitted = context.object<ExtendedEmission>(emission);
                const auto all = context.elements<Primary>(primaries.records);
                const int threads = context.inputs().threads;
                parallel_for(threads, slice.begin, slice.end, [&](std::int64_t i) {
                    const auto number = static_cast<std::uint64_t>(i);
                    const auto source = primaries.from_images + number;
                    all[source] = emitted->photon(*traced, number, static_cast<std::uint32_t>(source));
                });
            },
            first_emission_slice);
}

}  // namespace ir::methods::ldm_indirect
