#include "renderers/methods/deep-screen-space/surfels/counts.h"

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
        .reads(is_fine ? "FineSurfels" : "Surfels", records)
        .writes("Sums", sums)
        .counts("Count", count)
        .compute({{"methods/deep-screen-space/surfels/sums.comp"}, {{"FINE", is_fine ? "1" : "0"}}},
                 groups * group_size, [=](const PassContext& context, const gl::Program& program) {
                     set_ideal(program, context.inputs(), parameters);
                     program.set("capacity", static_cast<unsigned>(context.capacity(records)));
                 });
    return sums;
}

}  // namespace

void count_surfels(graph::GraphBuilder& builder, const Patches& patches, const Growing& fine,
                   const Surfels& surfels, const Parameters& parameters) {
    const auto of_fine = add_up(builder, "fine", true, fine.buffer, fine.count, parameters);
    const auto of_kept = add_up(builder, "kept", false, surfels.records, surfels.count, parameters);
    const auto row = builder.output("surfels.counts", {.fields = {{"triangles", FieldType::u32},
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
        .reads("FineSums", of_fine)
        .reads("KeptSums", of_kept)
        .writes("Row", row)
        .counts("TriangleCount", patches.triangles)
        .counts("PatchCount", patches.list.count)
        .counts("FineCount", fine.count)
        .counts("KeptCount", surfels.count)
        .compute({{"methods/deep-screen-space/surfels/counts.comp"}}, 1,
                 [](const PassContext& context, const gl::Program& program) {
                     program.set("groups", static_cast<unsigned>(groups));
                     program.set("world_triangles",
                                 static_cast<unsigned>(context.inputs().world->triangles()));
                 });
}

}  // namespace ir::methods::deep_screen_space
