#include "renderers/methods/deep-screen-space/surfels/steps.h"

#include <functional>
#include <optional>

#include "renderers/methods/deep-screen-space/surfels/view.h"

namespace ir::methods::deep_screen_space {
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
