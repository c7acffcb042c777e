#include "renderers/methods/ldm-indirect/tracing/further_bounces.h"

#include <cmath>

#include "renderers/core/parallel_for.h"
#include "renderers/graph/pass_context.h"
#include "renderers/methods/ldm-indirect/tracing/first_hits.h"
#include "renderers/methods/ldm-indirect/tracing/host/children.h"
#include "renderers/methods/ldm-indirect/tracing/sending_surfaces.h"
#include "renderers/passes/sampling/point_sequence.h"
#include "renderers/passes/scattering/microfacets.h"
#include "renderers/passes/scene/progressive.h"
#include "renderers/scene/frame.h"

namespace ir::methods::ldm_indirect {
namespace {

/// Pairs of numbers of a ray.
enum BounceDimension : std::uint32_t { of_pair, of_further_direction };

constexpr std::int64_t first_bounce_slice = 1024;

float carried(const Primary& p) {
    if (p.fate != primary_splits) return 0;
    const auto flux = reflected_flux(p);
    return flux.r + flux.g + flux.b;
}

/// What goes on from the first of `pair` that a number chooses by the flux that they reflect: the photon of a
/// bounce that has `all`. DEVIATION [Aalund15 §6]: print has a subset of the directions for each photon,
/// traced through the maps; this is one direction for two photons, not of the maps', whose hit a ray finds
/// with normal and reflectance, which nodes do not have.
Primary gone_on(const SendingSurfaces& surfaces, const FirstHits::Find& first_hit,
                std::span<const Primary> pair, const passes::PathSampler& random, std::uint64_t all,
                std::uint32_t source) {
    float sum = 0;
    for (const auto& p : pair) sum += carried(p);
    Primary result = SendingSurfaces::nothing(source);
    if (!(sum > 0)) return result;
    const bool takes_first =
        carried(pair.back()) == 0 || random.pair(of_pair).x * sum < carried(pair.front());
    const auto& from = takes_first ? pair.front() : pair.back();
    result.light = from.light;
    result.emitted = reflected_flux(from) * (sum / carried(from));
    result.path_length = from.path_length;
    const auto direction = glm::normalize(scene::frame_around(from.shading_ws) *
                                          passes::sample_cosine_ts(random.pair(of_further_direction)));
    result.direction_ws = direction;
    if (glm::dot(direction, from.normal_ws) <= 0) return result;
    const auto hit = first_hit(from.position_ws, from.normal_ws, direction);
    if (!hit.is_hit()) return result;
    result.path_length += hit.distance;
    surfaces.arrive(result, surfaces.lookup().at(hit, direction));
    if (result.fate != primary_splits) return result;
    // As spacing_of(): the pair has the places of both, |u × v| each, seen along the ray; of n photons with
    // the density cosine / π each has a cone of π r² = π / (n cosine). What grazes, and few photons, stay
    // bounded.
    const float cosine = std::max(glm::dot(direction, from.shading_ws), 1e-3f);
    const float place = static_cast<float>(pair.size()) * glm::length(glm::cross(from.axis_u, from.axis_v));
    SendingSurfaces::spread(
        result,
        {std::sqrt(place * cosine), std::min(std::sqrt(1 / (cosine * static_cast<float>(all))), 1.0f)},
        hit.distance);
    return result;
}

std::array<float, 3> channels_of(const glm::dvec3& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

BounceRow row_of(int bounce, std::span<const Primary> primaries, std::span<const Shares> shares) {
    BounceRow row{};
    row.bounce = static_cast<std::uint32_t>(bounce);
    glm::dvec3 sent(0), arrived(0), reflected(0), stored(0);
    for (std::size_t i = 0; i < primaries.size(); ++i) {
        const auto& p = primaries[i];
        sent += glm::dvec3(p.emitted) * (1.0 + double(p.missed));
        if (p.fate == primary_nothing) continue;
        ++row.photons;
        arrived += glm::dvec3(p.emitted * p.reached);
        if (p.fate != primary_splits) continue;
        const auto flux = glm::dvec3(reflected_flux(p));
        reflected += flux;
        for (const auto cause : {Cause::stored, Cause::stored_hidden})
            stored += flux * double(shares[i].part[static_cast<std::size_t>(cause)]);
    }
    row.sent = channels_of(sent), row.arrived = channels_of(arrived);
    row.reflected = channels_of(reflected), row.stored = channels_of(stored);
    return row;
}

}  // namespace

void go_on(graph::GraphBuilder& builder, const Primaries& primaries, graph::ObjectRef surfaces,
           const passes::ldm::Maps& maps, const Parameters& parameters) {
    if (primaries.bounces < 2) return;
    const FirstHits first_hits(builder, maps, parameters);
    const auto& inputs = builder.inputs();
    const auto seed = photon_seed(inputs, parameters);
    for (int bounce = 2; bounce <= primaries.bounces; ++bounce) {
        const auto all = primaries.of_bounce(bounce), begin = primaries.first_of(bounce),
                   before = primaries.first_of(bounce - 1);
        auto pass = builder.pass("photons of bounce " + std::to_string(bounce), graph::Queue::cpu);
        first_hits.read_by(pass);
        pass.reads(surfaces, primaries.records)
            .writes(primaries.records)
            .execute_sliced(
                static_cast<std::int64_t>(all),
                [=](graph::PassContext& context, graph::Slice slice) {
                    const auto first_hit = first_hits.in(context);
                    const auto met = context.object<SendingSurfaces>(surfaces);
                    const auto records = context.elements<Primary>(primaries.records);
                    const auto key = passes::mixed(seed + static_cast<std::uint64_t>(bounce));
                    parallel_for(context.inputs().threads, slice.begin, slice.end, [&](std::int64_t i) {
                        const auto place = static_cast<std::uint64_t>(i);
                        const auto first = before + 2 * place;
                        const auto pair = std::span<const Primary>(records).subspan(
                            first, std::min<std::uint64_t>(2, begin - first));
                        const passes::PathSampler random(key, static_cast<std::uint32_t>(place));
                        records[begin + place] = gone_on(*met, first_hit, pair, random, all,
                                                         static_cast<std::uint32_t>(begin + place));
                    });
                },
                first_bounce_slice);
    }
}

void sum_bounces(graph::GraphBuilder& builder, const Primaries& primaries) {
    const auto table = builder.output(
        "indirect.bounces",
        {.fields = record_fields<BounceRow>(), .elements = static_cast<std::uint64_t>(primaries.bounces)});
    builder.pass("energy by bounce", graph::Queue::cpu)
        .reads(primaries.records, primaries.shares)
        .writes(table)
        .execute([=](graph::PassContext& context) {
            const auto records = context.elements<const Primary>(primaries.records);
            const auto shares = context.elements<const Shares>(primaries.shares);
            const auto rows = context.elements<BounceRow>(table);
            for (int bounce = 1; bounce <= primaries.bounces; ++bounce) {
                const auto first = primaries.first_of(bounce), count = primaries.of_bounce(bounce);
                rows[static_cast<std::size_t>(bounce - 1)] =
                    row_of(bounce, records.subspan(first, count), shares.subspan(first, count));
            }
        });
}

std::vector<OutputDescription> bounce_outputs() {
    return {{.key = "indirect.bounces",
             .label = "Energy by bounce",
             .kind = OutputKind::table,
             .unit = "W",
             .doc =
                 "Of each bounce, W of red, green and blue. photons: that meet a surface. sent: what the "
                 "sources emit, or what goes on from the bounce before. arrived: at a surface. reflected: "
                 "split into the directions of the maps. stored: what arrives where the view may see it."}};
}

}  // namespace ir::methods::ldm_indirect
