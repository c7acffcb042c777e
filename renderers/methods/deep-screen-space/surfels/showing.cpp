#include "renderers/methods/deep-screen-space/surfels/steps.h"

#include <algorithm>

#include "renderers/methods/deep-screen-space/surfels.h"
#include "renderers/methods/deep-screen-space/surfels/packing.h"
#include "renderers/methods/deep-screen-space/surfels/view.h"
#include "shaders/methods/deep-screen-space/surfels/show.comp.h"

namespace ir::methods::deep_screen_space {
namespace {

/// Constants of show.comp.
struct Show {
    Ideal ideal;
    unsigned capacity;
    IR_FIELDS(ideal, capacity)
};

}  // namespace

void show_surfels(graph::GraphBuilder& builder, const Surfels& surfels, std::uint64_t reserve,
                  const Parameters& parameters) {
    const auto shown = growing(builder,
                               {.text = builder.text_of_output("surfels"),
                                .kind = OutputKind::glyphs,
                                .fields = record_fields<ShownSurfel>()},
                               {.key = "surfels.shown", .label = "Surfels shown"}, reserve);
    auto pass = builder.pass("show surfels");
    if (surfels.are_lit()) pass.reads("SurfelLights", surfels.lights);
    pass.reads("Surfels", surfels.records)
        .reads("Stored", surfels.stored)
        .writes("Shown", shown.buffer)
        .counts("ShownCount", shown.count)
        .execute_sliced(
            packing_parts,
            [=](graph::PassContext& context, graph::Slice slice) {
                const auto& program = context.use({{"methods/deep-screen-space/surfels/show.comp"},
                                                   {{"LIT", surfels.are_lit() ? "1" : "0"}}});
                const auto capacity =
                    std::min(context.capacity(surfels.records), context.capacity(shown.buffer));
                program.set(Show{ideal(context.inputs().view, parameters), static_cast<unsigned>(capacity)});
                dispatch_parts(program, capacity, slice);
            },
            1);
}

std::vector<OutputDescription> surfel_outputs() {
    return {
        {.key = "surfels",
         .label = "Surfels",
         .kind = OutputKind::glyphs,
         .unit = "m",
         .doc = "The discs that stand for the scene's surfaces [Nalbach15 fig. 7]. surfel: its number, by "
                "which it is chosen. radius: m, of a disc as large as the piece of surface that it stands "
                "for; part: of the ideal area. radiance_front, radiance_back: RGB, W/(m² sr), what it sends "
                "on the side of its normal and on the other one: the diffuse part of direct light; 0 for "
                "ambient occlusion. triangle: of the scene."},
        {.key = "surfels.fine",
         .label = "Fine surfels",
         .kind = OutputKind::glyphs,
         .unit = "m",
         .doc =
             "Before thinning, as tessellation makes them; also where an alpha mask has holes. part: of the "
             "ideal area; those below 1 are kept with this probability. patch: in the list of patches; "
             "radius, triangle: as of the surfels; barycentrics: weights of its second and third corner, 16 "
             "bits each; identity: a hash of triangle and place, of which all random choices are made.",
         .active_when = {"placement", {std::string("random"), std::string("barycentric")}}},
        {.key = "surfels.counts",
         .label = "Counts of surfels",
         .kind = OutputKind::table,
         .semantic = Semantic::count,
         .doc = "triangles: of the scene; left: after culling; patches: after splitting; fine, kept: surfels "
                "before and after thinning (fine: 0 with systematic placement); fine_area, kept_area: their "
                "areas together, m²; fine_part, kept_part: their area as a multiple of the ideal area, on "
                "average."}};
}

}  // namespace ir::methods::deep_screen_space
