#include "renderers/methods/deep-screen-space/surfels/steps.h"

#include <algorithm>

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

}  // namespace ir::methods::deep_screen_space
