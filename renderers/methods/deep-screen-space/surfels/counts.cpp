#include "renderers/methods/deep-screen-space/surfels/counts.h"

#include "renderers/graph/output_text.h"
#include "renderers/methods/deep-screen-space/surfels/view.h"

namespace ir::methods::deep_screen_space {
namespace {

using graph::FieldType;
using graph::PassContext;

constexpr int groups = 64, group_size = 256;

graph::BufferRef add_up(graph::GraphBuilder& builder, const std::string& what, bool is_fine,
                        graph::BufferRef records, graph::CounterRef count, const Parameters& parameters) {
    const auto sums = builder.buffer({.text = {.key = "surfels.sums." + what,
                                               .label = "Sums of surfels, " + what,
                                               .doc = "Of parts of the list."},
                                      .fields = {{"area"}, {"part"}},
                                      .elements = groups});
    builder.pass("add up surfels, " + what)
        .reads(records)
        .writes(sums)
        .counts(count)
        .execute([=](PassContext& context) {
            const auto& program = context.program(
                {{"methods/deep-screen-space/surfels/sums.comp"}, {{"FINE", is_fine ? "1" : "0"}}});
            program.use();
            context.bind_buffer(0, records);
            context.bind_counter(1, count);
            context.bind_buffer(2, sums);
            set_ideal(program, context.inputs(), parameters);
            program.set("capacity", static_cast<unsigned>(context.capacity(records)));
            program.dispatch(groups * group_size);
        });
    return sums;
}

}  // namespace

void count_surfels(graph::GraphBuilder& builder, const Patches& patches, const Growing& fine,
                   const Surfels& surfels, const Parameters& parameters) {
    const auto of_fine = add_up(builder, "fine", true, fine.buffer, fine.count, parameters);
    const auto of_kept = add_up(builder, "kept", false, surfels.records, surfels.count, parameters);
    const auto row = builder.buffer({.text = graph::text_of(surfel_outputs(), "surfels.counts"),
                                     .fields = {{"triangles", FieldType::u32},
                                                {"left", FieldType::u32},
                                                {"patches", FieldType::u32},
                                                {"fine", FieldType::u32},
                                                {"kept", FieldType::u32},
                                                {"fine_area"},
                                                {"kept_area"},
                                                {"fine_part"},
                                                {"kept_part"}},
                                     .elements = 1});
    builder.pass("count surfels")
        .reads(of_fine, of_kept)
        .writes(row)
        .counts(patches.triangles)
        .counts(patches.list.count)
        .counts(fine.count)
        .counts(surfels.count)
        .execute([=](PassContext& context) {
            const auto& program = context.program({{"methods/deep-screen-space/surfels/counts.comp"}});
            program.use();
            context.bind_buffer(0, of_fine);
            context.bind_buffer(1, of_kept);
            int binding = 2;
            for (const auto counter : {patches.triangles, patches.list.count, fine.count, surfels.count})
                context.bind_counter(binding++, counter);
            context.bind_buffer(6, row);
            program.set("groups", static_cast<unsigned>(groups));
            program.set("world_triangles", static_cast<unsigned>(context.inputs().world->triangles()));
            program.dispatch(1);
        });
}

}  // namespace ir::methods::deep_screen_space
