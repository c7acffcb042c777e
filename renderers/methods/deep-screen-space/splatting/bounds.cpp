#include "renderers/methods/deep-screen-space/splatting/steps.h"

#include <bit>

#include "renderers/graph/pass_context.h"

namespace ir::methods::deep_screen_space {
namespace {

graph::ImageRef declare(graph::GraphBuilder& builder, const std::string& key, int levels) {
    return builder.output(key, {.format = gl::Format::rgba32f, .levels = levels});
}

void reduce(const graph::PassContext& p, const Hierarchy& hierarchy, int level) {
    gl::ProgramSource source{{"methods/deep-screen-space/splatting/bounds.comp"}};
    if (level == 0) source.defines["FIRST"] = "1";
    p.bind("min_image", hierarchy.min, level);
    p.bind("max_image", hierarchy.max, level);
    p.bind("finer_min", hierarchy.min, level - 1);
    p.bind("finer_max", hierarchy.max, level - 1);
    const auto& program = p.use(source);
    const auto shape = p.shape(hierarchy.min);
    program.dispatch(shape.level_width(level), shape.level_height(level));
    p.barrier();
}

}  // namespace

void bound_positions(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, Hierarchy& hierarchy) {
    const auto& view = builder.inputs().view;
    const int levels = std::bit_width(static_cast<unsigned>(std::max(view.width, view.height)));
    hierarchy.min = declare(builder, "hierarchy.min", levels);
    hierarchy.max = declare(builder, "hierarchy.max", levels);
    builder.pass("bounds of positions")
        .reads(gbuffer.position)
        .writes(hierarchy.min, hierarchy.max)
        .execute([=](graph::PassContext& p) {
            for (int level = 0; level < levels; ++level) reduce(p, hierarchy, level);
        });
}

}  // namespace ir::methods::deep_screen_space
