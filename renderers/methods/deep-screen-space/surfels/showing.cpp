#include "renderers/methods/deep-screen-space/surfels/steps.h"

#include <algorithm>
#include <functional>
#include <optional>

#include "renderers/methods/deep-screen-space/surfels.h"
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

namespace {

constexpr int group_count = 64, group_size = 256;

/// Constants of sums.comp.
struct SurfelSums {
    Ideal ideal;
    unsigned capacity;
    IR_FIELDS(ideal, capacity)
};

/// Constants of counts.comp.
struct CountsRow {
    unsigned groups, world_triangles;
    IR_FIELDS(groups, world_triangles)
};

/// `count` gives a pass the number of records.
graph::BufferRef add_up(graph::GraphBuilder& builder, const std::string& what, bool is_fine,
                        graph::BufferRef records, const std::function<void(graph::PassBuilder&)>& count,
                        const Parameters& parameters, const std::string& fingerprint) {
    const auto sums = builder.buffer({.text = {.key = "surfels.sums." + what,
                                               .label = "Sums of surfels, " + what,
                                               .doc = "Of parts of the list."},
                                      .fields = {{"area"}, {"part"}},
                                      .elements = group_count,
                                      .fingerprint = fingerprint});
    auto pass = builder.pass("add up surfels, " + what);
    count(pass);
    pass.reads(is_fine ? "FineSurfels" : "Surfels", records)
        .writes("Sums", sums)
        .compute(
            {{"methods/deep-screen-space/surfels/sums.comp"}, {{"FINE", is_fine ? "1" : "0"}}},
            group_count * group_size,
            [records, size = ideal(builder.inputs().view, parameters)](const graph::PassContext& context) {
                return SurfelSums{size, static_cast<unsigned>(context.capacity(records))};
            });
    return sums;
}

}  // namespace

void count_surfels(graph::GraphBuilder& builder, const Patches& patches, const Growing* fine,
                   const Surfels& surfels, const Parameters& parameters) {
    std::optional<graph::BufferRef> of_fine;
    if (fine)
        of_fine = add_up(
            builder, "fine", true, fine->buffer,
            [&](graph::PassBuilder& pass) { pass.counts("Count", fine->count); }, parameters,
            surfels.fingerprint);
    const auto of_kept = add_up(
        builder, "kept", false, surfels.records,
        [&](graph::PassBuilder& pass) { pass.reads("Stored", surfels.stored); }, parameters,
        surfels.fingerprint);
    const bool on_host = patches.left.index >= 0;
    const auto row = builder.output(
        "surfels.counts",
        {.fields = record_fields<SurfelCounts>(), .elements = 1, .fingerprint = surfels.fingerprint});
    auto pass = builder.pass("count surfels");
    if (fine) pass.reads("FineSums", *of_fine).counts("FineCount", fine->count);
    if (on_host)
        pass.reads("Left", patches.left);
    else
        pass.counts("TriangleCount", patches.triangles).counts("PatchCount", patches.list.count);
    pass.reads("KeptSums", of_kept)
        .reads("Stored", surfels.stored)
        .writes("Row", row)
        .compute({{"methods/deep-screen-space/surfels/counts.comp"},
                  {{"HAS_FINE", fine ? "1" : "0"}, {"ON_HOST", on_host ? "1" : "0"}}},
                 1, CountsRow{group_count, static_cast<unsigned>(builder.inputs().world->triangles())});
}

}  // namespace ir::methods::deep_screen_space
