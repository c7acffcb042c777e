#include <algorithm>
#include <array>

#include "renderers/graph/pass_context.h"
#include "renderers/image/colour_map.h"
#include "renderers/methods/photon-mapping/bounces.h"
#include "renderers/methods/photon-mapping/paths/path_picture.h"
#include "renderers/methods/photon-mapping/splatting/overlay.h"
#include "renderers/methods/photon-mapping/splatting/stages.h"

namespace ir::methods::photon_mapping {
namespace {

using graph::PassContext;

constexpr std::uint64_t expected_legs = 4096;
/// A photon and the end of its path's leg differ by rounding: part of the radius of the scene's bounds.
constexpr float tolerance = 1e-3f;

constexpr const char* path_selector = "path";

/// Legs by where they start: at the light, or at a surface.
Categories leg_categories(const std::string& field) {
    Categories legs{field, {{0, "from the light", tints::orange}}};
    for (const auto& bounce : bounce_categories("").values) {
        if (bounce.value == 8) break;  // a picture has eight colours
        legs.values.push_back({bounce.value, "from surface " + std::to_string(bounce.value), bounce.colour});
    }
    return legs;
}

struct ShownPaths {
    SamplePoints samples;
    Photons photons;
    Splat splat;
    graph::CountedBuffer legs;
};

void find_legs(const PassContext& p, const ShownPaths& paths) {
    if (p.inputs().picked_pixel().x < 0) return;
    const auto found = found_photons(p, paths.splat);
    if (paths.photons.legs.paths < paths.samples.paths && !found.empty())
        p.notes().warn("paths are kept of the first " + std::to_string(paths.photons.legs.paths) + " of " +
                       std::to_string(paths.samples.paths) + " photons, as many as a buffer holds");
    const auto& samples = paths.samples;
    PathRecords records{.samples = p.elements<const SamplePoint>(samples.points),
                        .sources = p.elements<const SourceData>(samples.sources),
                        .photons = p.elements<const Photon>(paths.photons.records),
                        .vertices = p.elements<const PathVertex>(paths.photons.legs.vertices),
                        .surfaces = paths.photons.legs.surfaces,
                        .photons_per_point = samples.photons_per_point,
                        .all_points = std::max(1u, samples.all_points),
                        .from_maps = samples.from_maps,
                        .tolerance = tolerance * p.inputs().world->bounds.radius()};
    if (samples.traced_rays) records.rays = p.elements<const passes::RayRecord>(*samples.traced_rays);
    const auto legs = legs_of(found, records, p.inputs().inspection.item(path_selector));
    const auto room = p.elements<PathLeg>(paths.legs.elements);
    std::copy_n(legs.begin(), std::min(legs.size(), room.size()), room.begin());
    p.add(paths.legs.count, static_cast<std::uint32_t>(legs.size()));
}

}  // namespace

void show_paths(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, const SamplePoints& samples,
                const Photons& photons, const Splat& splat) {
    const ShownPaths paths{samples, photons, splat,
                           builder.explanation("photons.explain.paths", {.fields = record_fields<PathLeg>(),
                                                                         .elements = expected_legs})};
    auto pass = builder.pass("paths of the pixel's photons", graph::Queue::cpu);
    pass.reads(splat.found, splat.sum, samples.points, samples.sources, photons.records,
               photons.legs.vertices)
        .writes(paths.legs.elements)
        .counts(paths.legs.count);
    if (samples.traced_rays) pass.reads(*samples.traced_rays);
    pass.execute([=](PassContext& p) { find_legs(p, paths); });
    const auto marks = builder.image({.text = {.key = "photons.explain.path_marks",
                                               .label = "Lines of paths",
                                               .doc = "1 + the number of the leg; 0: none.",
                                               .semantic = Semantic::id},
                                      .format = gl::Format::r32ui});
    builder.pass("draw paths of the pixel's photons", graph::Queue::cpu)
        .reads(paths.legs.elements, gbuffer.position)
        .writes(marks)
        .execute([=](PassContext& p) {
            const auto pixels = p.pixels<std::uint32_t>(marks);
            std::ranges::fill(pixels, 0u);
            draw_legs(p.elements<const PathLeg>(paths.legs.elements), p.inputs().view,
                      p.pixels<const glm::vec4>(gbuffer.position), pixels);
        });
    draw_marks(builder, gbuffer, marks, "photons.explain.picture", leg_categories(""));
}

std::vector<OutputDescription> path_outputs() {
    return {
        {.key = "photons.explain.paths",
         .label = "Paths of the pixel's photons",
         .kind = OutputKind::line_set,
         .unit = "m",
         .doc = "The legs of the photons whose kernels cover the picked pixel's texel, each from the light "
                "to where the photon is stored. leg: 0 from the light, n from the n-th surface on the way, "
                "mirrors and glass included. path: the photon's place by what it contributes, from 0. "
                "contribution, photon and light: as of the photons. chosen: whether the selector *Path of "
                "a photon* names it. Directional lights begin on the near plane of their map.",
         .categories = {leg_categories("leg"),
                        bounce_categories("bounce"),
                        {"chosen", {{0, "another path", tints::sky}, {1, "the path chosen", tints::orange}}}},
         .when_empty = "no kernel covers the texel in this frame",
         .explains = true},
        {.key = "photons.explain.picture",
         .label = "Paths over the picture",
         .semantic = Semantic::albedo,
         .doc = "The same legs over the scene in grey, dotted behind what is seen; the path chosen is "
                "thicker, in front.",
         .categories = {leg_categories("")},
         .explains = true}};
}

std::vector<SelectorDescription> path_selectors() {
    return {{.key = path_selector,
             .label = "Path of a photon",
             .doc =
                 "Of the photons that light the picked pixel the one whose path is highlighted, by what it "
                 "contributes, from 0, the strongest. All: none.",
             .count = 4096}};
}

}  // namespace ir::methods::photon_mapping
