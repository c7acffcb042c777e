#include "renderers/methods/deep-screen-space/splatting/splats.h"

#include <algorithm>

#include "renderers/gl/dispatch_items.h"
#include "renderers/methods/deep-screen-space/parameters.h"
#include "renderers/methods/deep-screen-space/surfels/steps.h"
#include "shaders/methods/deep-screen-space/splatting/show_culling.comp.h"
#include "shaders/methods/deep-screen-space/surfels/commands.comp.h"

namespace ir::methods::deep_screen_space {
namespace {

using graph::FieldType;
using graph::PassContext;

/// Surfels whose rectangles are known at a time.
constexpr std::uint64_t max_at_once = 1 << 16;
/// Without mip levels in its sampler a texture has one.
constexpr scene::Sampler all_levels{scene::Wrap::clamp_to_edge, scene::Wrap::clamp_to_edge,
                                    scene::Filter::nearest, scene::Filter::nearest, true};

bool is_counted(const Splats& splats) {
    return splats.drawn.index >= 0;
}

/// Constants of drawn_splat.glsl.
struct DrawnSplat {
    InfluenceConstants influence;
    SphereBounds bounds;
    bool culls, shells;
    IR_FIELDS(influence, bounds, culls, shells)
};

DrawnSplat drawn_splat(const PassContext& p, const Splats& splats) {
    const auto& parameters = splats.parameters;
    return {influence_constants(splats), sphere_bounds(p.inputs().view), parameters.splat_culling,
            !parameters.visibility || parameters.shells == Shells::shells};
}

/// Constants of rectangles.comp.
struct SplatRectangles {
    DrawnSplat drawn;
    unsigned first, end, level, sample_index, seed;
    glm::ivec2 hierarchy_size;
    bool stratified_sub_images;
    IR_FIELDS(drawn, first, end, level, sample_index, seed, hierarchy_size, stratified_sub_images)
};

/// Constants of show_culling.comp.
struct ShowCulling {
    DrawnSplat drawn;
    int levels;
    IR_FIELDS(drawn, levels)
};

/// Constants of splat.vert.
struct SplatVertices {
    unsigned first_surfel;
    glm::vec2 framebuffer_size;
    IR_FIELDS(first_surfel, framebuffer_size)
};

void find_rectangles(const PassContext& p, const Splats& splats, const SplatLayer& layer, std::uint64_t first,
                     std::uint64_t end) {
    p.barrier();  // the draw before may still read what is written here
    gl::ProgramSource source{{folder + "rectangles.comp"}};
    if (is_counted(splats)) source.defines["COUNTS"] = "1";
    source.defines["DARK_IS_IDLE"] = splats.dark_is_idle() ? "1" : "0";
    const auto& program = p.use(source);
    const auto& parameters = splats.parameters;
    program.set(SplatRectangles{.drawn = drawn_splat(p, splats),
                                .first = static_cast<unsigned>(first),
                                .end = static_cast<unsigned>(end),
                                .level = static_cast<unsigned>(layer.level),
                                .sample_index = static_cast<unsigned>(splats.first_sample + layer.sample),
                                .seed = random_seed(p.inputs(), parameters),
                                .hierarchy_size = {splats.hierarchy.width, splats.hierarchy.height},
                                .stratified_sub_images = parameters.sub_images == SubImages::stratified});
    program.dispatch(static_cast<std::int64_t>(end - first));
    p.barrier();
}

void draw_layer(const PassContext& p, const Splats& splats, const SplatLayer& layer, const BindLayer& bind) {
    const auto& program = bind(p, layer);
    for (auto first = layer.first; first < layer.end; first += max_at_once) {
        const auto end = std::min(layer.end, first + max_at_once);
        find_rectangles(p, splats, layer, first, end);
        p.use(program);
        program.set(SplatVertices{static_cast<unsigned>(first),
                                  glm::vec2(splats.hierarchy.width, splats.hierarchy.height)});
        p.bind_empty_vertex_array();
        p.api().BindBuffer(GL_DRAW_INDIRECT_BUFFER, p.buffer(splats.command));
        p.api().DrawArraysIndirect(GL_TRIANGLES, nullptr);
        p.api().BindBuffer(GL_DRAW_INDIRECT_BUFFER, 0);
    }
}

/// A slice may end within one layer and go on in the next.
void draw_slice(const PassContext& p, graph::Slice slice, const Splats& splats, const BindLayer& bind) {
    const auto capacity = p.capacity(splats.surfels.records);
    const auto surfel_at = [&](std::int64_t part) {
        return capacity * static_cast<std::uint64_t>(part) / static_cast<std::uint64_t>(surfel_parts);
    };
    for (auto item = slice.begin; item < slice.end;) {
        const auto index = item / surfel_parts, begin = item % surfel_parts;
        const auto end = std::min(surfel_parts, begin + slice.end - item);
        SplatLayer layer;
        layer.sample = static_cast<int>(index) / splats.hierarchy.levels;
        layer.level = static_cast<int>(index) % splats.hierarchy.levels;
        layer.first = surfel_at(begin);
        layer.end = surfel_at(end);
        layer.is_first = begin == 0;
        draw_layer(p, splats, layer, bind);
        item += end - begin;
    }
}

}  // namespace

InfluenceConstants influence_constants(const Splats& splats) {
    const auto& parameters = splats.parameters;
    const bool estimated = parameters.influence == Influence::estimated;
    const bool open = parameters.last_shell == LastShell::open;
    return {.shell_radius = estimated && open ? 0.0f : splats.reach.shell_radius,
            .whole_reach = splats.reach.whole,
            .trade_off = estimated ? parameters.trade_off : 0.0f,
            .open_level = open ? parameters.levels - 1 : -1};
}

SplatConstants splat_constants(const Splats& splats, const SplatLayer& layer) {
    return {influence_constants(splats), layer.level, layer.sample};
}

/// Pixels of a view-space point: scale · (x/−z, y/−z), or of x and y in parallel views, plus offset.
SphereBounds sphere_bounds(const scene::View& view) {
    const auto& clip = view.clip_from_view;
    const bool perspective = clip[3][3] == 0;
    const glm::vec2 half = 0.5f * glm::vec2(view.width, -view.height);
    const glm::vec2 shift = perspective ? -glm::vec2(clip[2]) : glm::vec2(clip[3]);
    return {.view_from_world = view.view_from_world,
            .pixel_scale = half * glm::vec2(clip[0][0], clip[1][1]),
            .pixel_offset = half * shift + 0.5f * glm::vec2(view.width, view.height),
            .near_plane = view.near_plane,
            .far_plane = view.far_plane,
            .perspective = perspective,
            .view_size = {view.width, view.height}};
}

void show_culling(graph::GraphBuilder& builder, const Splats& splats) {
    const auto room = builder.buffers().at(static_cast<std::size_t>(splats.surfels.records.index)).elements;
    const auto shown = growing(builder,
                               {.text = builder.text_of_output("splats.by_surfel"),
                                .kind = OutputKind::glyphs,
                                .fields = record_fields<CulledSplats>()},
                               {.key = "splats.surfels", .label = "Surfels whose splats are shown"}, room);
    auto pass = builder.pass("show culled splats");
    if (splats.dark_is_idle()) pass.reads("SurfelLights", splats.surfels.lights);
    pass.reads("Surfels", splats.surfels.records)
        .reads("Stored", splats.surfels.stored)
        .reads("min_texture", splats.hierarchy.min, all_levels)
        .reads("max_texture", splats.hierarchy.max, all_levels)
        .writes("Shown", shown.buffer)
        .counts("ShownCount", shown.count)
        .execute_sliced(surfel_parts, [=](PassContext& p, graph::Slice slice) {
            const auto& program = p.use(
                {{folder + "show_culling.comp"}, {{"DARK_IS_IDLE", splats.dark_is_idle() ? "1" : "0"}}});
            program.set(ShowCulling{drawn_splat(p, splats), splats.hierarchy.levels});
            const auto capacity = static_cast<std::int64_t>(p.capacity(splats.surfels.records));
            gl::dispatch_items(program, capacity * slice.begin / surfel_parts,
                               capacity * slice.end / surfel_parts);
        });
}

std::vector<OutputDescription> splat_outputs() {
    return {{.key = "splats.by_surfel",
             .label = "Splats of surfels",
             .kind = OutputKind::glyphs,
             .unit = "m",
             .doc = "For each surfel on how many levels its splat is drawn, and on how many it is culled, as "
                    "nothing that the picture shows there is within its reach. The same for every sample. On "
                    "the host nothing is drawn; it shows what a device would do."}};
}

Splats declare_splats(graph::GraphBuilder& builder, const Hierarchy& hierarchy, const Surfels& surfels,
                      const Parameters& parameters, const passes::bounce::Batches& batches) {
    Splats splats;
    splats.hierarchy = hierarchy;
    splats.surfels = surfels;
    splats.reach = reach_of(parameters, *builder.inputs().world);
    splats.parameters = parameters;
    splats.samples = batches.together();
    splats.open_glass = has_open_glass(builder.inputs(), parameters);
    if (parameters.visibility && batches.all().size() == 1)
        splats.fingerprint = splat_fingerprint(builder.inputs(), surfels.fingerprint, parameters);
    splats.rectangles = builder.buffer(
        {.text = {.key = "splats.rectangles",
                  .label = "Rectangles of splats",
                  .doc =
                      "First place of the surfels drawn last, and the one after the last: x + 65536 y. How "
                      "many surfels a draw has depends on how long the frame's slices take."},
         .fields = {{"first", FieldType::u32}, {"after", FieldType::u32}},
         .elements = max_at_once,
         .fingerprint = splats.fingerprint});
    splats.command = builder.buffer({.text = {.key = "splats.command",
                                              .label = "Command of the draw",
                                              .doc = "Vertices of the last draw of splats, as long as its "
                                                     "slice was: none where that had no surfels left."},
                                     .fields = record_fields<DrawCommand>(),
                                     .elements = 1,
                                     .fingerprint = splats.fingerprint});
    splats.drawn = builder.counter({.key = "splats.drawn",
                                    .label = "Splats drawn",
                                    .doc = "On all levels, for all samples: rectangles of places in which "
                                           "something may be affected."});
    splats.culled =
        builder.counter({.key = "splats.culled",
                         .label = "Splats culled",
                         .doc = "Splats in the picture whose rectangles show nothing within reach "
                                "of the surfel, by the bounds of positions."});
    return splats;
}

void draw_splats(graph::PassBuilder pass, const Splats& splats, const BindLayer& bind) {
    if (splats.dark_is_idle()) pass.reads("SurfelLights", splats.surfels.lights);
    pass.reads("Surfels", splats.surfels.records)
        .reads("Stored", splats.surfels.stored)
        .may_read(splats.hierarchy.layout, splats.hierarchy.positions, splats.hierarchy.normals)
        .reads("min_texture", splats.hierarchy.min, all_levels)
        .reads("max_texture", splats.hierarchy.max, all_levels)
        .writes("Rectangles", splats.rectangles)
        .writes("Draw", splats.command);
    if (is_counted(splats)) pass.counts("Drawn", splats.drawn).counts("Culled", splats.culled);
    pass.execute_sliced(splats.samples * splats.hierarchy.levels * surfel_parts,
                        [=](PassContext& p, graph::Slice slice) { draw_slice(p, slice, splats, bind); });
}

graph::ImageRef count_cover(graph::GraphBuilder& builder, const Splats& splats) {
    const auto cover = builder.output(
        "splats.cover", {.format = gl::Format::rg32f,
                         .extent = graph::Extent::fixed(splats.hierarchy.width, splats.hierarchy.height),
                         .layers = splats.samples * splats.hierarchy.levels});
    const gl::ProgramSource source{
        {"methods/deep-screen-space/splatting/splat.vert", "methods/deep-screen-space/splatting/cover.frag"}};
    auto uncounted = splats;
    uncounted.drawn = uncounted.culled = {};
    auto pass = builder.pass("count splats of places").writes(cover);
    draw_splats(pass, uncounted,
                [=](const graph::PassContext& p, const SplatLayer& layer) -> const gl::Program& {
                    const int index = layer.sample * splats.hierarchy.levels + layer.level;
                    if (layer.is_first && index == 0) p.clear(cover);
                    p.bind_framebuffer({{cover, index}});
                    const auto& program = p.use(source);
                    program.set(splat_constants(splats, layer));
                    p.api().Enable(GL_BLEND);
                    p.api().BlendEquation(GL_FUNC_ADD);
                    p.api().BlendFunc(GL_ONE, GL_ONE);
                    return program;
                });
    return cover;
}

}  // namespace ir::methods::deep_screen_space
