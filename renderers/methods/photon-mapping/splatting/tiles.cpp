#include "renderers/methods/photon-mapping/splatting/stages.h"

#include "renderers/graph/pass_context.h"
#include "renderers/methods/photon-mapping/splatting/splat_view.h"

namespace ir::methods::photon_mapping {
namespace {

/// Constants of tiles.comp.
struct CountTiles {
    SplatView view;
    int tile_size;
    IR_FIELDS(view, tile_size)
};

}  // namespace

graph::ImageRef count_tiles(graph::GraphBuilder& builder, const StoredPhotons& photons,
                            const Parameters& parameters) {
    const int divisor = divisor_of(parameters.splat_resolution);
    const auto& view = builder.inputs().view;
    const CountTiles constants{splat_view(view, divisor), parameters.tile_size};
    const auto tiles =
        (texels_of(view, divisor) + parameters.tile_size - 1) / glm::ivec2(parameters.tile_size);
    const auto image = builder.output(
        "splat.tiles", {.format = gl::Format::r32ui, .extent = graph::Extent::fixed(tiles.x, tiles.y)});
    builder.pass("count photons of tiles")
        .reads("Photons", photons.records)
        .reads("Stored", photons.stored)
        .writes("tiles", image)
        .execute_sliced(passes::photon_parts, [=](graph::PassContext& p, graph::Slice slice) {
            if (slice.first) p.clear(image);
            const auto& program = p.use({{"methods/photon-mapping/splatting/tiles.comp"}});
            program.set(constants);
            passes::dispatch_photons(p, program, photons, slice);
        });
    return image;
}

}  // namespace ir::methods::photon_mapping
