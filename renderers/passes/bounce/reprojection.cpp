#include "renderers/passes/bounce/reprojection.h"

#include "renderers/passes/bounce/tiles.h"
#include "renderers/passes/gbuffer/pixel_rays.h"

namespace ir::passes {
namespace {

const Condition reprojected{"reprojection", {true}};

struct Images {
    graph::ImageRef now, average, surfaces, frames;
};

graph::ResourceText of_this_frame(graph::ResourceText text) {
    text.key += ".frame";
    text.label += ", this frame";
    text.doc = "Before it is averaged with the last frames.";
    return text;
}

/// Constants of reproject.comp.
struct Reproject {
    bool has_history;
    float history;
    glm::vec4 depth_row;
    PixelRays rays;
    IR_FIELDS(has_history, history, depth_row, rays)
};

}  // namespace

ParameterTable<ReprojectionParameters> reprojection_parameters() {
    ParameterTable<ReprojectionParameters> table;
    table
        .add(
            &ReprojectionParameters::reprojection,
            {.key = "reprojection",
             .label = "Average over frames",
             .doc = "Each frame draws other random numbers and is blended with the last one's picture, which "
                    "follows the motion of camera and scene and starts again where something else was seen.",
             .citation = "Nalbach15 §5; Scherzer12"})
        .add(
            &ReprojectionParameters::history,
            {.key = "history",
             .label = "Weight of history",
             .doc =
                 "Fraction of a pixel that past frames may make up. Up to 1 / (1 − weight) frames their plain "
                 "mean is taken.",
             .hard = {0, 0.9999},
             .soft = {0, 0.99},
             .active_when = reprojected});
    return table;
}

std::vector<OutputDescription> reprojection_outputs() {
    return {{.key = "reprojection.frames",
             .label = "Frames averaged",
             .semantic = Semantic::count,
             .doc =
                 "For how many frames the pixel's surface has been followed, this one counted: 1 where the "
                 "average started again, 0 without a surface.",
             .active_when = reprojected}};
}

graph::ImageRef reproject(graph::GraphBuilder& builder, const GBuffer& gbuffer,
                          const std::function<graph::ImageRef(graph::ResourceText)>& produce,
                          const ReprojectionParameters& parameters, graph::ResourceText text,
                          FourthChannel fourth) {
    if (!parameters.reprojection) return produce(std::move(text));
    Images images;
    images.now = produce(of_this_frame(text));
    const auto format = builder.images().at(static_cast<std::size_t>(images.now.index)).format;
    images.average = builder.image({.text = std::move(text), .format = format});
    images.surfaces =
        builder.image({.text = {"reprojection.surfaces", "Surfaces for the next frame", packed_surface_doc},
                       .format = gl::Format::rg32ui});
    images.frames = builder.output("reprojection.frames", {.format = gl::Format::r32f});
    auto pass = builder.pass("reprojection");
    pass.reads("now", images.now)
        .reads(gbuffer.position, gbuffer.geometric_normal, gbuffer.velocity)
        .reads_previous("previous_average", images.average)
        .reads_previous("previous_surfaces", images.surfaces)
        .reads_previous("previous_frames", images.frames)
        .writes("average", images.average)
        .writes("surfaces", images.surfaces)
        .writes("frames", images.frames);
    gl::ProgramSource source{{"passes/bounce/reproject.comp"}};
    source.defines["VARIANCE"] = fourth == FourthChannel::variance ? "1" : "0";
    bounce::compute_by_tiles(pass, builder, source, [=](const graph::PassContext& context) {
        const auto& inputs = context.inputs();
        return Reproject{.has_history = context.has_previous(),
                         .history = parameters.history,
                         .depth_row = -glm::vec4(glm::transpose(inputs.view.view_from_world)[2]),
                         .rays = pixel_rays(inputs.previous_view)};
    });
    return images.average;
}

}  // namespace ir::passes
