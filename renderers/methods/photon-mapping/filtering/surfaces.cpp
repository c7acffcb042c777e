#include "renderers/methods/photon-mapping/filtering/stages.h"
#include "renderers/passes/gbuffer/pixel_rays.h"

namespace ir::methods::photon_mapping {

std::int64_t group_rows(const graph::GraphBuilder& builder) {
    return (builder.inputs().view.height + group_size - 1) / group_size;
}

void dispatch_rows(const graph::PassContext& context, const gl::Program& program, graph::Slice slice) {
    program.set("first_row", static_cast<int>(slice.begin) * group_size);
    program.dispatch(context.inputs().view.width, (slice.end - slice.begin) * group_size);
}

void set_edges(const graph::PassContext& context, const gl::Program& program, const Parameters& parameters) {
    passes::set_pixel_rays(program, context.inputs().view);
    program.set("sigma_depth", parameters.sigma_depth);
    program.set("sigma_normal", parameters.sigma_normal);
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
    desc.text = {"filter.surfaces", "Packed surfaces",
                 "Geometric normal, octahedral in 2 x 16 bits, and the bits of the depth along the view axis "
                 "(m); infinite where there is no surface"};
    desc.format = gl::Format::rg32ui;
    const auto result = builder.image(desc);
    auto pass = builder.pass("filter surfaces");
    pass.reads(gbuffer.position, gbuffer.geometric_normal).writes("surfaces", result);
    execute_by_rows(pass, group_rows(builder), [=](graph::PassContext& context, graph::Slice slice) {
        const auto& program = context.use({{"methods/photon-mapping/filtering/surfaces.comp"}});
        program.set("depth_row", -glm::vec4(glm::transpose(context.inputs().view.view_from_world)[2]));
        dispatch_rows(context, program, slice);
    });
    return result;
}

}  // namespace ir::methods::photon_mapping
