#include "renderers/methods/ldm-indirect/tracing/emission.h"

#include "renderers/methods/ldm-indirect/tracing/extended_emission.h"
#include "renderers/methods/ldm-indirect/tracing/further_bounces.h"
#include "renderers/methods/ldm-indirect/tracing/sending_surfaces.h"
#include "renderers/passes/lights/shining.h"

namespace ir::methods::ldm_indirect {
namespace {

/// Constants of emit.comp.
struct Emit {
    unsigned views_drawn, map_count;
    IR_FIELDS(views_drawn, map_count)
};

}  // namespace

Primaries emit_photons(graph::GraphBuilder& builder, const passes::SceneBuffers& scene,
                       const passes::Rsm& images, const passes::ldm::MapsPointer& maps,
                       const Parameters& parameters) {
    Primaries primaries;
    primaries.extended = extended_photons(builder.inputs(), parameters);
    passes::note_darkness(builder, parameters.transport);
    primaries.from_images = static_cast<std::uint64_t>(images.layers) *
                            static_cast<std::uint64_t>(images.resolution) *
                            static_cast<std::uint64_t>(images.resolution);
    if (parameters.transport.paths != Transport::Paths::direct)
        primaries.bounces = parameters.transport.max_bounces;
    primaries.records = builder.buffer(
        {.text = {.key = "indirect.primary_photons",
                  .label = "Primary photons, all",
                  .doc =
                      "A photon for each texel of the lights' images, up to its first surface; then those "
                      "of sources with an extent, and those of further bounces. Axes and turns are half of "
                      "the differentials of position and direction. fate: 0 nothing was seen or no light "
                      "shines there, 1 splits, 2 its footprint is degenerate. light: 254 an emissive mesh, "
                      "255 the environment."},
         .fields = record_fields<Primary>(),
         .elements = primaries.count()});
    primaries.shares = builder.buffer(
        {.text = {.key = "indirect.shares",
                  .label = "Where split photons go",
                  .doc =
                      "Of each primary photon: parts of the flux that it reflects, and numbers of photons, "
                      "by cause (see indirect.energy, leg 1)."},
         .fields = record_fields<Shares>(),
         .elements = primaries.count(),
         .cleared = true});
    auto pass = builder.pass("emit photons");
    passes::reads_rsm(pass, images, scene);
    pass.reads(images.geometric_normal, maps->frame_buffer)
        .writes("Primaries", primaries.records)
        .writes(primaries.shares)
        .compute_sliced(
            {{"methods/ldm-indirect/tracing/emit.comp"}}, static_cast<std::int64_t>(primaries.from_images),
            Emit{static_cast<unsigned>(images.views_drawn), static_cast<unsigned>(maps->layout.maps)}, 4096);
    if (primaries.extended.count() > 0 || primaries.bounces > 1) {
        const auto surfaces = sending_surfaces(builder, maps, parameters);
        emit_from_extended(builder, primaries, surfaces, parameters);
        go_on(builder, primaries, surfaces, *maps, parameters);
    }
    return primaries;
}

}  // namespace ir::methods::ldm_indirect
