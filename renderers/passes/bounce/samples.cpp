#include "renderers/passes/bounce/samples.h"

#include "renderers/passes/bounce/tiles.h"

namespace ir::passes::bounce {
namespace {

/// Constants of visibility.comp.
struct See {
    float max_distance;
    IR_FIELDS(max_distance)
};

OutputDescription incoming(Effects effects) {
    OutputDescription d{.key = "bounce.incoming", .label = "Incoming", .kind = OutputKind::stack};
    if (effects == Effects::ambient_occlusion) {
        d.semantic = Semantic::accessibility;
        d.doc =
            "Whether each sample's ray is open (1) or met something within the maximum distance; with the "
            "smooth fall-off (d/d_max)². A layer per sample.";
    } else {
        d.doc =
            "What arrives along each sample's ray, a layer per sample. Ambient occlusion: 1 open, 0 closed. "
            "Light: radiance of what was met, W/(m² sr), black where nothing was.";
    }
    return d;
}

}  // namespace

std::vector<OutputDescription> sample_outputs(const Condition& active_when, Effects effects) {
    auto in = incoming(effects);
    in.active_when = active_when;
    return {{.key = "bounce.distance",
             .label = "Bounced z",
             .kind = OutputKind::stack,
             .semantic = Semantic::distance,
             .unit = "m",
             .doc = "The bounced z-buffer, a layer per sample: metres from the pixel's point to what its ray "
                    "met first. Negative: nothing.",
             .active_when = active_when},
            in};
}

graph::ImageRef declare_distance(graph::GraphBuilder& builder, Batches& batches,
                                 const std::string& fingerprint) {
    return batches.stack(builder, {.text = builder.text_of_output("bounce.distance"),
                                   .format = gl::Format::r32f,
                                   .fingerprint = fingerprint});
}

graph::ImageRef declare_incoming(graph::GraphBuilder& builder, Batches& batches, Effects effects) {
    return batches.stack(builder,
                         {.text = builder.text_of_output("bounce.incoming"),
                          .format = effects == Effects::light ? gl::Format::rgba32f : gl::Format::r32f});
}

void fill_visibility(graph::GraphBuilder& builder, const GBuffer& gbuffer, const Directions& directions,
                     const Samples& samples, const Transport& transport, const Batch& batch) {
    auto pass = builder.pass("visibility" + batch.name);
    pass.reads(gbuffer.geometric_normal)
        .reads("directions", directions.directions)
        .reads("distances", samples.distance)
        .writes("incoming", samples.incoming);
    const bool is_smooth = transport.falloff == Transport::Falloff::smooth;
    compute_by_tiles(pass, builder, {{"passes/bounce/visibility.comp"}, {{"SMOOTH", is_smooth ? "1" : "0"}}},
                     See{transport.max_distance});
}

}  // namespace ir::passes::bounce
