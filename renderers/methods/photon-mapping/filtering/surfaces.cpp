#include "renderers/methods/photon-mapping/filtering/stages.h"

namespace ir::methods::photon_mapping {
namespace {

/// Of the dispatch of a slice.
struct FirstRow {
    int first_row;
    IR_FIELDS(first_row)
};

/// Constants of surfaces.comp.
struct PackSurfaces {
    glm::vec4 depth_row;
    IR_FIELDS(depth_row)
};

}  // namespace

void compute_by_rows(graph::PassBuilder& pass, const graph::GraphBuilder& builder,
                     const gl::ProgramSource& source, graph::Constants constants) {
    const auto rows = (builder.inputs().view.height + group_size - 1) / group_size;
    execute_by_rows(pass, rows, [=](graph::PassContext& context, graph::Slice slice) {
        const auto& program = context.use(source);
        constants.give(context, program);
        program.set(FirstRow{static_cast<int>(slice.begin) * group_size});
        program.dispatch(context.inputs().view.width, (slice.end - slice.begin) * group_size);
    });
}

Edges edges(const graph::FrameInputs& inputs, const Parameters& parameters) {
    return {passes::pixel_rays(inputs.view), parameters.sigma_depth, parameters.sigma_normal};
}

Signal declare_signal(graph::GraphBuilder& builder, const graph::ResourceText& text) {
    const graph::ResourceText direction{
        text.key + "_direction", text.label + ": direction",
        "y and z of the sum of directions to the light, weighted by R + G + B"};
    return {builder.image({.text = text, .format = gl::Format::rgba32f}),
            builder.image({.text = direction, .format = gl::Format::rg32f})};
}

graph::ImageRef pack_surfaces(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer) {
    graph::ImageDesc desc;
    desc.text = {"filter.surfaces", "Packed surfaces", passes::packed_surface_doc};
    desc.format = gl::Format::rg32ui;
    const auto result = builder.image(desc);
    auto pass = builder.pass("filter surfaces");
    pass.reads(gbuffer.position, gbuffer.geometric_normal).writes("surfaces", result);
    compute_by_rows(pass, builder, {{folder + "surfaces.comp"}},
                    PackSurfaces{-glm::transpose(builder.inputs().view.view_from_world)[2]});
    return result;
}

}  // namespace ir::methods::photon_mapping
