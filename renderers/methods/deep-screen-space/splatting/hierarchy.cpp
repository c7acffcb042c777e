#include "renderers/graph/pass_context.h"
#include "renderers/methods/deep-screen-space/parameters.h"
#include "renderers/methods/deep-screen-space/splatting.h"
#include "renderers/methods/deep-screen-space/splatting/host/layout_on_host.h"
#include "renderers/methods/deep-screen-space/splatting/steps.h"

namespace ir::methods::deep_screen_space {
namespace {

int padded(int size, int levels) {
    const int step = 1 << (levels - 1);
    return (size + step - 1) / step * step;
}

graph::ImageRef declare(graph::GraphBuilder& builder, const Hierarchy& hierarchy, const std::string& key,
                        gl::Format format, const std::string& name = {},
                        const std::string& fingerprint = {}) {
    return builder.output(key, {.name = name,
                                .format = format,
                                .extent = graph::Extent::fixed(hierarchy.width, hierarchy.height),
                                .layers = hierarchy.levels,
                                .fingerprint = fingerprint});
}

/// Constants of layout.comp.
struct Layout {
    unsigned seed;
    glm::ivec2 view_size;
    IR_FIELDS(seed, view_size)
};

void lay_out(graph::GraphBuilder& builder, Hierarchy& hierarchy, unsigned seed) {
    const auto& inputs = builder.inputs();
    const glm::ivec2 view(inputs.view.width, inputs.view.height);
    const auto fingerprint = std::to_string(view.x) + " x " + std::to_string(view.y) + ", " +
                             std::to_string(hierarchy.levels) + " levels, seed " + std::to_string(seed);
    const auto layout = hierarchy.layout =
        declare(builder, hierarchy, "hierarchy.layout", gl::Format::r32ui, "layout_texture", fingerprint);
    const auto places = hierarchy.places =
        declare(builder, hierarchy, "hierarchy.places", gl::Format::r32ui, "", fingerprint);
    if (inputs.processor == Processor::host) {
        lay_out_on_host(builder, hierarchy, seed);
        return;
    }
    builder.pass("framebuffer layout")
        .has_two_bodies()
        .writes("layout_image", layout)
        .writes("places_image", places)
        .compute({{folder + "layout.comp"}}, places, Layout{seed, view});
}

void shuffle_surfaces(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, Hierarchy& hierarchy) {
    hierarchy.positions =
        declare(builder, hierarchy, "hierarchy.positions", gl::Format::rgba32f, "shuffled_positions");
    hierarchy.normals =
        declare(builder, hierarchy, "hierarchy.normals", gl::Format::rgba32f, "shuffled_normals");
    builder.pass("shuffle")
        .reads(hierarchy.layout, gbuffer.position, gbuffer.normal)
        .writes(hierarchy.positions, hierarchy.normals)
        .compute({{folder + "shuffle.comp"}}, hierarchy.positions);
}

/// Only for people: the colours of the picture, shuffled.
void shuffle_colours(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer,
                     const Hierarchy& hierarchy) {
    const auto colours = declare(builder, hierarchy, "hierarchy.colours", gl::Format::rgba16f);
    builder.pass("shuffle colours")
        .reads(hierarchy.layout, gbuffer.albedo)
        .writes("colours", colours)
        .compute({{folder + "shuffle_colours.comp"}}, colours);
}

}  // namespace

Hierarchy shuffle(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer,
                  const Parameters& parameters) {
    const auto& view = builder.inputs().view;
    Hierarchy hierarchy;
    hierarchy.levels = parameters.levels;
    hierarchy.width = padded(view.width, parameters.levels);
    hierarchy.height = padded(view.height, parameters.levels);
    lay_out(builder, hierarchy, random_seed(builder.inputs(), parameters));
    shuffle_surfaces(builder, gbuffer, hierarchy);
    shuffle_colours(builder, gbuffer, hierarchy);
    bound_positions(builder, gbuffer, hierarchy);
    return hierarchy;
}

}  // namespace ir::methods::deep_screen_space
