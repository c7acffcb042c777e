#include "renderers/methods/ambient-occlusion-volumes/volumes.h"

#include <algorithm>
#include <optional>

#include "renderers/passes/gbuffer/pixel_rays.h"
#include "shaders/methods/ambient-occlusion-volumes/triangle.glsl.h"

namespace ir::methods::ambient_occlusion_volumes {
namespace {

/// Boxes of what tiles of the picture show.
struct Tiles {
    graph::ImageRef low, high;
    int side = 0;  ///< pixels
};

/// Constants of bounds.comp.
struct TileBounds {
    int side;
    IR_FIELDS(side)
};

/// At least 8 pixels a side, at most 64 tiles along each: an invocation may look at all of them.
Tiles declare_tiles(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer) {
    const auto& view = builder.inputs().view;
    Tiles tiles;
    tiles.side = std::max(8, (std::max(view.width, view.height) + 63) / 64);
    const auto declare = [&](const char* key, const char* label) {
        graph::ImageDesc desc;
        desc.text = {key, label,
                     "Of the positions that a tile of the picture shows; w: 1 where it shows anything",
                     Semantic::position, "m"};
        desc.extent = graph::Extent::fixed((view.width + tiles.side - 1) / tiles.side,
                                           (view.height + tiles.side - 1) / tiles.side);
        return builder.image(std::move(desc));
    };
    tiles.low = declare("volumes.tiles.low", "Least position of tiles");
    tiles.high = declare("volumes.tiles.high", "Largest position of tiles");
    builder.pass("picture bounds")
        .reads(gbuffer.position)
        .writes("low", tiles.low)
        .writes("high", tiles.high)
        .compute({{"methods/ambient-occlusion-volumes/bounds.comp"}}, tiles.low, TileBounds{tiles.side});
    return tiles;
}

void read_triangles(graph::PassBuilder& pass, const passes::SceneBuffers& scene) {
    pass.reads(scene.positions, scene.indices, scene.uv0, scene.uv1, scene.triangle_materials,
               scene.materials, scene.opacity, scene.opacity_words);
}

bool is_orthographic(const scene::View& view) {
    return view.clip_from_view[2][3] == 0;
}

/// Constants of cull.comp.
struct Cull {
    Hull hull;
    int side;
    glm::vec2 size_px;
    unsigned first_triangle, end_triangle;
    IR_FIELDS(hull, side, size_px, first_triangle, end_triangle)
};

struct CullPass {
    Volumes volumes;
    std::optional<Tiles> tiles;  ///< without them nothing but triangles without area is culled
    graph::CounterRef drawn, culled;

    void run(const graph::PassContext& context, graph::Slice slice) const {
        gl::ProgramSource source{{"methods/ambient-occlusion-volumes/cull.comp"}};
        source.defines["CULLING"] = tiles ? "1" : "0";
        const auto& program = context.use(source);
        const auto& view = context.inputs().view;
        program.set(Cull{.hull = hull(context.inputs(), volumes),
                         .side = tiles ? tiles->side : 0,
                         .size_px = {view.width, view.height},
                         .first_triangle = static_cast<unsigned>(slice.begin),
                         .end_triangle = static_cast<unsigned>(slice.end)});
        program.dispatch(slice.end - slice.begin);
    }
};

void cull(graph::GraphBuilder& builder, const Volumes& volumes, const std::optional<Tiles>& tiles) {
    CullPass cull{volumes, tiles, {}, {}};
    cull.drawn = builder.counter({.key = "volumes.drawn", .label = "Volumes drawn"});
    cull.culled = builder.counter({.key = "volumes.culled",
                                   .label = "Volumes culled",
                                   .doc = "Nothing that the picture shows lies in them, or their triangle "
                                          "has no area."});
    auto pass = builder.pass("cull volumes");
    read_triangles(pass, volumes.scene);
    if (tiles) pass.reads("tile_low", tiles->low).reads("tile_high", tiles->high);
    pass.writes("Occluders", volumes.occluders).counts("Drawn", cull.drawn).counts("Culled", cull.culled);
    pass.execute_sliced(volumes.triangles, [cull](graph::PassContext& context, graph::Slice slice) {
        cull.run(context, slice);
    });
}

}  // namespace

Volumes declare_volumes(graph::GraphBuilder& builder, const passes::SceneBuffers& scene,
                        const passes::GBuffer& gbuffer, const Parameters& parameters) {
    const auto& world = *builder.inputs().world;
    Volumes volumes{.scene = scene,
                    .gbuffer = gbuffer,
                    .occluders = {},
                    .triangles = static_cast<std::int64_t>(world.triangles()),
                    .reach = reach_of(parameters, world),
                    .both_sides = both_sides(parameters)};
    volumes.occluders = builder.buffer(
        {.text = {.key = "volumes.occluders",
                  .label = "Occluders",
                  .doc = "Whether a triangle's volume is drawn, and the mean of the triangle's mask."},
         .fields = record_fields<Occluder>(),
         .elements = std::max<std::uint64_t>(1, world.triangles())});
    std::optional<Tiles> tiles;
    if (parameters.culling) tiles = declare_tiles(builder, gbuffer);
    cull(builder, volumes, tiles);
    return volumes;
}

void read_volumes(graph::PassBuilder& pass, const Volumes& volumes) {
    read_triangles(pass, volumes.scene);
    const auto& g = volumes.gbuffer;
    pass.reads("Occluders", volumes.occluders).reads(g.position, g.normal, g.geometric_normal);
}

TriangleConstants triangle_constants(const graph::FrameInputs& inputs, const Volumes& volumes) {
    return {.opaque_triangles = inputs.world->opaque_triangles,
            .reach = volumes.reach,
            .both_sides = volumes.both_sides};
}

Hull hull(const graph::FrameInputs& inputs, const Volumes& volumes) {
    const auto& view = inputs.view;
    const glm::vec3 axis = -glm::vec3(glm::transpose(view.view_from_world)[2]);
    const auto rays = passes::pixel_rays(view);
    return {.triangles = triangle_constants(inputs, volumes),
            .viewer_ws = is_orthographic(view) ? glm::vec4(-axis, 0) : glm::vec4(view.eye_ws, 1),
            .view_axis_ws = axis,
            .pixel_size = {std::max(glm::length(rays.origin_dx), glm::length(rays.origin_dy)),
                           std::max(glm::length(rays.direction_dx), glm::length(rays.direction_dy))},
            .clip_from_world = view.clip_from_world()};
}

gl::ProgramSource drawing_with(const std::string& fragments) {
    const std::string folder = "methods/ambient-occlusion-volumes/";
    return {{folder + "volume.vert", folder + "volume.geom", folder + fragments}};
}

void draw_volumes(const graph::PassContext& context, std::int64_t begin, std::int64_t end) {
    if (begin == end) return;
    context.bind_empty_vertex_array();
    context.api().Enable(GL_DEPTH_CLAMP);  // near and far plane cut no volume
    context.api().DrawArrays(GL_POINTS, static_cast<GLint>(begin), static_cast<GLsizei>(end - begin));
    context.api().Disable(GL_DEPTH_CLAMP);
}

}  // namespace ir::methods::ambient_occlusion_volumes
