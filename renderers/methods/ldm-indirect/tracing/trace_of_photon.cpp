// How the brightest photon of a picked pixel was traced from where it was split: what the entries of the map
// are to that place, and what an exact ray finds beside them. [Aalund15 §3.1, Fig. 4]
#include <algorithm>

#include "renderers/core/record.h"
#include "renderers/methods/ldm-indirect/splatting/found.h"
#include "renderers/methods/ldm-indirect/tracing/first_hits.h"
#include "renderers/passes/ldm/map_views.h"
#include "renderers/passes/ldm/walk.h"
#include "shaders/methods/ldm-indirect/tracing/primary.glsl.h"
#include "shaders/methods/ldm-indirect/tracing/walk.comp.h"

namespace ir::methods::ldm_indirect {
namespace {

namespace ldm = passes::ldm;

constexpr const char* no_photon = "the pixel shows no surface, or no photon lights it that was split";

/// Constants of walk.comp.
struct WalkThrough {
    glm::vec3 scene_min, scene_max;
    unsigned first_map;
    IR_FIELDS(scene_min, scene_max, first_map)
};

enum TraceRole : std::uint32_t { as_traced, by_a_ray };

struct TraceLine {
    std::array<float, 3> start, end;
    std::uint32_t role;
    float distance;
    std::uint32_t map;
    std::int32_t side;
    std::uint32_t photon;
    IR_FIELDS(start, end, role, distance, map, side, photon)
};

/// The brightest that did not come directly: of the maps chosen, if one of theirs is there.
const FoundPhoton* brightest(std::span<const FoundPhoton> found, ldm::MapRange chosen) {
    const FoundPhoton* any = nullptr;
    for (const auto& photon : found) {
        if (photon.side == 0) continue;
        const auto map = static_cast<int>(photon.map);
        if (map >= chosen.first && map < chosen.first + chosen.count) return &photon;
        if (!any) any = &photon;
    }
    return any;
}

}  // namespace

void explain_trace(graph::GraphBuilder& builder, const Photons& photons, const PixelPhotons& pixel) {
    const auto maps = photons.maps;
    const auto chosen = ldm::chosen_maps(builder.inputs().inspection, *maps);
    const auto split = builder.buffer({.text = {.key = "indirect.explain.split",
                                                .label = "Where the photon was split",
                                                .doc = "Of the brightest photon of the picked pixel."},
                                       .fields = record_fields<SplitPlace>(),
                                       .elements = 1});
    const auto lines =
        builder.explanation("indirect.explain.trace", {.fields = record_fields<TraceLine>(), .elements = 2},
                            {.key = "indirect.explain.trace_count", .label = "Lines of traces"});
    const FirstHits exact(builder, *maps, {});
    auto find = builder.pass("trace of a photon", graph::Queue::cpu);
    exact.read_by(find);
    find.reads(pixel.photons, pixel.sum, photons.records, photons.primaries)
        .writes(split, lines.elements)
        .counts(lines.count)
        .execute([=](graph::PassContext& p) {
            auto& place = p.elements<SplitPlace>(split)[0];
            place = {};
            place.map = no_map;
            const auto* photon = brightest(found_photons(p, pixel), chosen);
            if (!photon) return;
            const auto& record = p.elements<const Photon>(photons.records)[photon->photon];
            const auto& primary = p.elements<const Primary>(photons.primaries)[photon->source];
            place.position_ws = primary.position_ws;
            place.map = photon->map;
            place.shading_ws = primary.shading_ws;
            place.normal_ws = primary.normal_ws;
            const auto direction = float(photon->side) * glm::vec3(maps->frames[photon->map].direction);
            const auto line = [&](TraceRole role, float distance) {
                const auto end = primary.position_ws + distance * direction;
                return TraceLine{components(primary.position_ws),
                                 components(end),
                                 role,
                                 distance,
                                 photon->map,
                                 photon->side,
                                 photon->photon};
            };
            const auto hit = exact.in(p)(primary.position_ws, primary.normal_ws, direction);
            const auto to = p.elements<TraceLine>(lines.elements);
            std::uint32_t count = 0;
            to[count++] = line(as_traced, record.distance);
            if (hit.is_hit()) to[count++] = line(by_a_ray, hit.distance);
            p.add(lines.count, count);
        });
    const auto views = ldm::declare_walk_views(builder, 1);
    auto walk = builder.pass("walk of a photon");
    ldm::reads_maps(walk, *maps);
    walk.reads("Split", split);
    views.written_by(walk);
    walk.execute([=](graph::PassContext& p) {
        gl::ProgramSource source{{"methods/ldm-indirect/tracing/walk.comp"}};
        source.defines = ldm::defines_of(p, *maps);
        const auto& program = p.use(source);
        const auto& bounds = p.inputs().world->bounds;
        program.set(WalkThrough{bounds.min, bounds.max,
                                static_cast<unsigned>(maps->first_map(maps->layout.batches() - 1))});
        program.dispatch(1);
    });
}

std::vector<OutputDescription> trace_outputs() {
    const std::vector<OutputDescription> lines{
        {.key = "indirect.explain.trace",
         .label = "Trace of the brightest photon",
         .kind = OutputKind::line_set,
         .unit = "m",
         .doc =
             "Of the photon that adds most to the picked pixel, along the map chosen if there is one: from "
             "where it was split to where it landed, and to what an exact ray hits. distance: m. Where the "
             "first is much shorter, the map stopped it too early, as a self-hit does; where it is "
             "longer, it let it pass.",
         .categories = {{"role",
                         {{as_traced, "as it was traced", tints::sky},
                          {by_a_ray, "by an exact ray", tints::green}}},
                        {"side", {ldm::against_map, ldm::along_map}}},
         .when_empty = no_photon,
         .explains = true}};
    return joined({lines, ldm::walk_outputs({.point = "the place where the brightest photon was split",
                                             .map = "its map",
                                             .ends = "the scene's end",
                                             .when_empty = std::string(no_photon) +
                                                           ", or its map is of an earlier batch"})});
}

}  // namespace ir::methods::ldm_indirect
