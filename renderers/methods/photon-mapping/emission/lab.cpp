#include "renderers/methods/photon-mapping/emission/lab.h"

#include <algorithm>
#include <cmath>

#include "renderers/methods/photon-mapping/emission/levels.h"
#include "renderers/methods/photon-mapping/emission/views.h"

namespace ir::methods::photon_mapping {
namespace {

using graph::PassContext;

/// Depths of a map and of the picture agree but for their texels' slopes.
constexpr float map_tolerance = 0.02f;

/// Constants of quadrants.comp.
struct Quadrants {
    int layer;
    IR_FIELDS(layer)
};

LevelSums map_of(const PassContext& p, const EmissionMaps& maps, int source) {
    return {p.pixels<const float>(maps.probability, source), maps.resolution};
}

/// What points follow: the map, or all texels alike.
LevelSums followed(const PassContext& p, const EmissionMaps& maps, int source, const Parameters& parameters) {
    if (parameters.emission == Emission::importance) return map_of(p, maps, source);
    return {std::vector<float>(
                static_cast<std::size_t>(maps.resolution) * static_cast<std::size_t>(maps.resolution), 1.0f),
            maps.resolution};
}

LevelSums points_of(const PassContext& p, const EmissionMaps& maps, const EmissionPoints& points,
                    int source) {
    return {texels_of(p.elements<const std::uint32_t>(points.candidates), points.from_maps, source,
                      maps.resolution),
            maps.resolution};
}

void show_quadrants(graph::GraphBuilder& builder, const EmissionMaps& maps, int source) {
    const auto picture = builder.output(
        "emission.quadrants",
        {.format = gl::Format::r32f, .extent = graph::Extent::fixed(maps.resolution, maps.resolution)});
    builder.pass("Haar quadrants")
        .reads("haar_pyramid", maps.haar)
        .writes("quadrants", picture)
        .compute({{"methods/photon-mapping/emission/quadrants.comp"}}, picture, Quadrants{source});
}

void show_fits(graph::GraphBuilder& builder, const EmissionMaps& maps, const EmissionPoints& points,
               int source, const Parameters& parameters) {
    const auto table = builder.output(
        "emission.levels",
        {.fields = record_fields<LevelFit>(), .elements = static_cast<std::uint64_t>(maps.levels) + 1});
    builder.pass("fit of points by level", graph::Queue::cpu)
        .reads(maps.probability, points.candidates)
        .writes(table)
        .execute([=](PassContext& p) {
            const auto fits = fits_of(followed(p, maps, source, parameters), map_of(p, maps, source),
                                      points_of(p, maps, points, source));
            std::ranges::copy(fits, p.elements<LevelFit>(table).begin());
        });
}

/// Rows of all maps that look at a place.
std::vector<CellOnTheWay> ways_to(const PassContext& p, glm::vec3 position_ws, const Sources& sources,
                                  const MappedEmission& mapped, const EmissionPoints& points,
                                  const Parameters& parameters) {
    std::vector<CellOnTheWay> rows;
    for (int source = 0; source < static_cast<int>(sources.views.size()); ++source) {
        const auto& maps = mapped.maps;
        const auto seen =
            seen_at(sources.views[static_cast<std::size_t>(source)], position_ws, maps.resolution);
        if (!seen) continue;
        const float depth = p.pixels<const float>(
            mapped.rsm.depth,
            source)[static_cast<std::size_t>(seen->texel.y * maps.resolution + seen->texel.x)];
        for (auto cell :
             way_to(seen->texel, followed(p, maps, source, parameters), points_of(p, maps, points, source))) {
            cell.source = static_cast<std::uint32_t>(source);
            cell.lit = std::abs(depth - seen->depth) < map_tolerance * seen->depth ? 1 : 0;
            rows.push_back(cell);
        }
    }
    return rows;
}

void explain_texel(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, const Sources& sources,
                   const MappedEmission& mapped, const EmissionPoints& points, const Parameters& parameters) {
    const auto rows = builder.explanation("emission.explain.texel",
                                          {.fields = record_fields<CellOnTheWay>(),
                                           .elements = static_cast<std::uint64_t>(mapped.maps.levels) + 1});
    builder.pass("way to the pixel's texel", graph::Queue::cpu)
        .reads(mapped.maps.probability, points.candidates, mapped.rsm.depth, gbuffer.position)
        .writes(rows.elements)
        .counts(rows.count)
        .execute([=](PassContext& p) {
            const auto pixel = p.inputs().picked_pixel();
            if (pixel.x < 0) return;
            const auto surface = p.pixels<const glm::vec4>(
                gbuffer.position)[static_cast<std::size_t>(pixel.y * p.inputs().view.width + pixel.x)];
            if (surface.w == 0) return;
            const auto found = ways_to(p, glm::vec3(surface), sources, mapped, points, parameters);
            const auto room = p.elements<CellOnTheWay>(rows.elements);
            std::copy_n(found.begin(), std::min(found.size(), room.size()), room.begin());
            p.add(rows.count, static_cast<std::uint32_t>(found.size()));
        });
}

}  // namespace

void show_levels(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, const Sources& sources,
                 const MappedEmission& mapped, const EmissionPoints& points, const Parameters& parameters) {
    const int source = std::max(0, shown_source(builder.inputs().inspection, sources));
    show_quadrants(builder, mapped.maps, source);
    show_fits(builder, mapped.maps, points, source, parameters);
    explain_texel(builder, gbuffer, sources, mapped, points, parameters);
}

std::vector<OutputDescription> level_outputs() {
    return {
        {.key = "emission.quadrants",
         .label = "Haar quadrants",
         .colour_map = "coolwarm",
         .doc =
             "The pyramid of the map chosen (of all maps the first) as the classic picture: of each level the "
             "details left minus right on the upper right, upper minus lower on the lower left and the "
             "diagonals on the lower right, and on the upper left the next level; last, in the corner, the "
             "mean. As coarse as the level: in texels of the map the upper right half-size square is of quads "
             "of texels.",
         .explains = true,
         .active_when = from_rsm()},
        {.key = "emission.levels",
         .label = "Points by level",
         .kind = OutputKind::table,
         .doc =
             "For each level of the pyramid of the map chosen, from the whole map to its texels: chi square "
             "of the points against what its cells expect, cells below 5 points pooled, with its degrees of "
             "freedom; and the sampling efficiency of points that follow the map down to there and are even "
             "within the cells: (sum q)² / sum q²/p of the map q and their probabilities p. At level 0 that "
             "is the efficiency of uniform points, at the last one 1 where points follow the map.",
         .explains = true,
         .active_when = from_rsm()},
        {.key = "emission.explain.texel",
         .label = "Way to the pixel's texel",
         .kind = OutputKind::table,
         .doc =
             "For each map that looks at the picked pixel's surface the cells from the whole map down to the "
             "texel: cell x and y of 2^level a side, coefficients (mean and the three details of its quad), "
             "and how many points it expects and has. lit: whether the map's depth there is that of the "
             "surface, within 2 %.",
         .when_empty = "no light's map looks at the pixel's surface",
         .explains = true,
         .active_when = from_rsm()}};
}

}  // namespace ir::methods::photon_mapping
