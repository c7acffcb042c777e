#include "renderers/methods/ldm-indirect/tracing/energy.h"

namespace ir::methods::ldm_indirect {
namespace {

using graph::PassContext;

/// Constants of energy.comp.
struct SumEnergy {
    unsigned primary_count, block_size, direct_count;
    bool splits;
    IR_FIELDS(primary_count, block_size, direct_count, splits)
};

/// Constants of energy_table.comp.
struct MakeEnergyTable {
    unsigned block_count;
    IR_FIELDS(block_count)
};

/// All of the first bounce.
void count_causes(graph::GraphBuilder& builder, graph::PassBuilder& pass) {
    for (
        const auto& [key, name, label, doc] :
        {std::tuple{
             "emitted", "EmittedCounter", "Primary photons",
             "Of the first bounce, as all that follow: pixels of the lights' images into which light shines, and "
             "photons of sources with an extent."},
         std::tuple{"below", "BelowCounter", "Photons below the surface",
                    "Their direction is above the shading normal's plane, but below the triangle's."},
         std::tuple{"left", "LeftCounter", "Photons that left the scene", "Of the first bounce."},
         std::tuple{"outside", "OutsideCounter", "Photons outside the view",
                    "They arrive behind or beside the view, and their footprints do not reach it."},
         std::tuple{"hidden", "HiddenCounter", "Photons hidden",
                    "Those of the first bounce that arrive behind what the camera sees."},
         std::tuple{"back", "BackCounter", "Photons on backs",
                    "They arrive on sides that face away from the viewer."},
         std::tuple{"degenerate", "DegenerateCounter", "Photons without a footprint",
                    "They graze the surface, so that their footprint has no size."}})
        pass.counts(builder.counter(
            {.key = std::string("indirect.") + key, .name = name, .label = label, .doc = doc}));
}

}  // namespace

void sum_energy(graph::GraphBuilder& builder, const Primaries& primaries, bool splits,
                std::optional<graph::BufferRef> direct_fates) {
    const auto count = primaries.of_bounce(1);
    const auto block_photons = photons_of_energy_block(count);
    const auto block_count = (count + block_photons - 1) / block_photons;
    const auto blocks = builder.buffer({.text = {.key = "indirect.energy_blocks",
                                                 .label = "Energy of blocks of photons",
                                                 .doc = "The rows of indirect.energy of every " +
                                                        std::to_string(block_photons) + " photons."},
                                        .fields = record_fields<EnergyRow>(),
                                        .elements = block_count * energy_rows});
    const auto table =
        builder.output("indirect.energy", {.fields = record_fields<EnergyRow>(), .elements = energy_rows});
    auto sum = builder.pass("sum energy");
    sum.reads("Primaries", primaries.records).reads("AllShares", primaries.shares).writes("Blocks", blocks);
    if (direct_fates) sum.reads("Fates", *direct_fates);
    gl::ProgramSource source{{"methods/ldm-indirect/tracing/energy.comp"}};
    if (direct_fates) source.defines["DIRECT"] = "1";
    sum.compute_sliced(source, static_cast<std::int64_t>(block_count * energy_rows),
                       SumEnergy{static_cast<unsigned>(count), static_cast<unsigned>(block_photons),
                                 static_cast<unsigned>(direct_fates ? primaries.from_images : 0), splits},
                       4096);
    auto pass = builder.pass("energy table");
    pass.reads("Blocks", blocks).writes("Table", table);
    count_causes(builder, pass);
    pass.compute({{"methods/ldm-indirect/tracing/energy_table.comp"}}, energy_rows,
                 MakeEnergyTable{static_cast<unsigned>(block_count)});
}

std::vector<OutputDescription> energy_outputs() {
    return {
        {.key = "indirect.energy",
         .label = "Energy by cause",
         .kind = OutputKind::table,
         .unit = "W",
         .doc =
             "Where the lights' flux goes in the first bounce (indirect.bounces has all): photons, and W of "
             "red, green and blue. Leg 0, up to the first "
             "surface: 0 emitted, 1 nothing seen, 2 beyond the light's range, 3 without a footprint, 4 "
             "absorbed at the first surface, or left in a gap before it that is narrower than two texels, 5 not split (paths are direct). Leg 1, behind it: 6 below "
             "the triangle's plane, 7 left the scene, 8 outside the view, 9 hidden, 10 on a back, 11 "
             "without a footprint, 12 stored, 13 stored although its middle is hidden or outside. Row 0 "
             "is the sum of rows 1 to 13. Leg 2, photons that are stored where they arrive from the "
             "light, before they are absorbed or split, the same causes: 14 is 0, 15 is 0, 16 outside, "
             "17 hidden, 18 back, 19 without a footprint, 20 stored, 21 stored although its middle is "
             "hidden or outside."}};
}

}  // namespace ir::methods::ldm_indirect
