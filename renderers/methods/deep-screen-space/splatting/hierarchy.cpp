#include "renderers/methods/deep-screen-space/splatting/hierarchy.h"

#include <algorithm>
#include <bit>

#include "renderers/graph/pass_context.h"

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
        .compute({{folder + "shuffle.comp"}, {{"COLOURS", "0"}}}, hierarchy.positions);
}

/// Only for people: the colours of the picture, shuffled.
void shuffle_colours(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer,
                     const Hierarchy& hierarchy) {
    const auto colours = declare(builder, hierarchy, "hierarchy.colours", gl::Format::rgba16f);
    builder.pass("shuffle colours")
        .reads(hierarchy.layout, gbuffer.albedo)
        .writes("colours", colours)
        .compute({{folder + "shuffle.comp"}, {{"COLOURS", "1"}}}, colours);
}

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

/// "hierarchy.min" and "max", down to one texel. A pixel (x, y) lies on mip level m below the texel
/// (min(x >> m, width_m - 1), …). [Nalbach15 §4.3]
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

std::vector<OutputDescription> hierarchy_outputs() {
    return {
        {.key = "hierarchy.colours",
         .label = "Sub-images",
         .kind = OutputKind::stack,
         .semantic = Semantic::albedo,
         .doc = "The picture's base colours on each level of the hierarchical framebuffer: level l (a layer) "
                "is 2^l × 2^l small pictures side by side, each with one pixel, at random, of every "
                "neighbourhood of 2^l × 2^l. Black: padding and background."},
        {.key = "hierarchy.layout",
         .label = "Layout of the levels",
         .kind = OutputKind::stack,
         .semantic = Semantic::id,
         .doc = "Which pixel of the view stands at a place of a level: x + 65536 y; 4294967295 is padding. "
                "A layer per level."},
        {.key = "hierarchy.places",
         .label = "Places on the levels",
         .kind = OutputKind::stack,
         .semantic = Semantic::id,
         .doc = "Where a pixel of the (padded) view stands on a level: x + 65536 y. A layer per level."},
        {.key = "hierarchy.positions",
         .label = "Shuffled positions",
         .kind = OutputKind::stack,
         .semantic = Semantic::position,
         .unit = "m",
         .doc = "Positions of the view's surfaces at their places on each level; alpha 0: no surface."},
        {.key = "hierarchy.normals",
         .label = "Shuffled normals",
         .kind = OutputKind::stack,
         .semantic = Semantic::normal,
         .doc = "Shading normals of the view's surfaces at their places on each level."},
        {.key = "hierarchy.min",
         .label = "Minimum positions",
         .kind = OutputKind::pyramid,
         .semantic = Semantic::position,
         .unit = "m",
         .doc =
             "Minimum x, y and z of all surfaces seen below a texel, on each mip level: with the maximum ones "
             "the box that splats are culled against. 3e38: no surface."},
        {.key = "hierarchy.max",
         .label = "Maximum positions",
         .kind = OutputKind::pyramid,
         .semantic = Semantic::position,
         .unit = "m",
         .doc =
             "Maximum x, y and z of all surfaces seen below a texel, on each mip level; -3e38: no surface."},
    };
}

}  // namespace ir::methods::deep_screen_space
