#include "renderers/methods/deep-screen-space/surfels/showing.h"

#include <algorithm>

#include "renderers/methods/deep-screen-space/surfels/packing.h"
#include "renderers/methods/deep-screen-space/surfels/view.h"

namespace ir::methods::deep_screen_space {

using graph::FieldType;

void show_surfels(graph::GraphBuilder& builder, const Surfels& surfels, std::uint64_t reserve,
                  const Parameters& parameters) {
    const auto shown = growing(builder,
                               {.text = builder.text_of_output("surfels"),
                                .kind = OutputKind::glyphs,
                                .fields = {{"centre", FieldType::f32, 3},
                                           {"surfel", FieldType::u32},
                                           {"normal", FieldType::f32, 3},
                                           {"radius"},
                                           {"radiance_front", FieldType::f32, 3},
                                           {"triangle", FieldType::u32},
                                           {"radiance_back", FieldType::f32, 3},
                                           {"part"}}},
                               {.key = "surfels.shown", .label = "Surfels shown"}, reserve);
    builder.pass("show surfels")
        .reads("Surfels", surfels.records)
        .writes("Shown", shown.buffer)
        .counts("SurfelCount", surfels.count)
        .counts("ShownCount", shown.count)
        .execute_sliced(
            packing_parts,
            [=](graph::PassContext& context, graph::Slice slice) {
                const auto& program = context.use({{"methods/deep-screen-space/surfels/show.comp"}});
                set_ideal(program, context.inputs(), parameters);
                const auto capacity =
                    std::min(context.capacity(surfels.records), context.capacity(shown.buffer));
                program.set("capacity", static_cast<unsigned>(capacity));
                dispatch_parts(program, capacity, slice);
            },
            1);
}

}  // namespace ir::methods::deep_screen_space
