#include "renderers/passes/shadow/shadow_maps.h"

#include <algorithm>

#include "renderers/graph/pass_context.h"
#include "renderers/passes/scene/light_data.h"
#include "renderers/passes/shadow/shadow_views.h"

namespace ir::passes {
namespace {

using graph::GraphBuilder;
using graph::PassContext;
using graph::Slice;

/// Constants of shadow.vert.
struct DrawShadow {
    glm::mat4 clip_from_world;
    glm::vec3 origin_ws, depth_axis_ws;
    IR_FIELDS(clip_from_world, origin_ws, depth_axis_ws)
};

void draw_triangles(const PassContext& p, const ShadowViewData& view, bool masked) {
    const auto opaque = static_cast<GLint>(3 * p.inputs().world->opaque_triangles);
    const auto all = static_cast<GLint>(p.inputs().world->indices.size());
    const int first = masked ? opaque : 0, end = masked ? all : opaque;
    if (first == end) return;
    const auto& program =
        p.use({{"passes/shadow/shadow.vert", "passes/shadow/shadow.frag"}, {{"MASKED", masked ? "1" : "0"}}});
    program.set(DrawShadow{view.clip_from_world, view.origin_ws, view.forward_ws / view.far});
    p.api().DrawArrays(GL_TRIANGLES, first, end - first);
}

void draw_layers(const PassContext& p, const ShadowMaps& shadow, Slice slice) {
    const auto views = shadow_views(*p.inputs().world, p.shape(shadow.maps).width);
    if (slice.first) p.upload(shadow.views, std::as_bytes(std::span(views)));
    p.bind_empty_vertex_array();
    p.api().Enable(GL_DEPTH_TEST);
    for (auto layer = slice.begin; layer < slice.end; ++layer) {
        const PassContext::Attachment depth{shadow.maps, static_cast<int>(layer)};
        p.bind_framebuffer({}, &depth);
        const float far = 1;
        p.api().ClearBufferfv(GL_DEPTH, 0, &far);
        if (static_cast<std::size_t>(layer) >= views.size()) continue;
        draw_triangles(p, views[static_cast<std::size_t>(layer)], false);
        draw_triangles(p, views[static_cast<std::size_t>(layer)], true);
    }
    p.api().Disable(GL_DEPTH_TEST);
}

}  // namespace

ShadowMaps shadow_maps(GraphBuilder& builder, const SceneBuffers& scene, int resolution) {
    int layers = 0;
    for (const auto& light : builder.inputs().world->lights) layers += shadow_layers(light);
    const auto& world = builder.inputs().world_fingerprint;
    const auto fingerprint = world.empty() ? "" : world + " at " + std::to_string(resolution);

    graph::ImageDesc maps;
    maps.text = {"shadow.maps", "Shadow maps", "Depth along each map's axis over its far distance",
                 Semantic::depth};
    maps.name = "shadow_maps";
    maps.format = gl::Format::depth32f;
    maps.extent = graph::Extent::fixed(resolution, resolution);
    maps.layers = std::max(1, layers);
    maps.fingerprint = fingerprint;
    graph::BufferDesc views;
    views.text = {"shadow.views", "Views of the shadow maps"};
    views.name = "ShadowViews";
    views.fields = record_fields<ShadowViewData>();
    views.elements = static_cast<std::uint64_t>(layers);
    views.fingerprint = fingerprint;

    const ShadowMaps shadow{builder.image(maps), builder.buffer(views)};
    builder.pass("shadow maps")
        .reads(scene.positions, scene.indices, scene.uv0, scene.uv1, scene.triangle_materials,
               scene.materials, scene.opacity, scene.opacity_words)
        .writes(shadow.maps, shadow.views)
        .execute_sliced(
            maps.layers, [=](PassContext& p, Slice slice) { draw_layers(p, shadow, slice); }, 1);
    return shadow;
}

}  // namespace ir::passes
