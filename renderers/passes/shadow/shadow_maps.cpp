#include "renderers/passes/shadow/shadow_maps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "renderers/graph/pass_context.h"
#include "renderers/passes/scene/draw_triangles.h"
#include "renderers/passes/scene/light_data.h"

namespace ir::passes {

namespace {

std::array<glm::vec3, 8> corners(const scene::Bounds& bounds) {
    std::array<glm::vec3, 8> result;
    for (int i = 0; i < 8; ++i)
        result[static_cast<std::size_t>(i)] = {(i & 1) ? bounds.max.x : bounds.min.x,
                                               (i & 2) ? bounds.max.y : bounds.min.y,
                                               (i & 4) ? bounds.max.z : bounds.min.z};
    return result;
}

/// Smallest and largest coordinate of the bounds along a unit axis.
glm::vec2 extent_along(const scene::Bounds& bounds, glm::vec3 axis) {
    glm::vec2 extent(INFINITY, -INFINITY);
    for (const auto& corner : corners(bounds)) {
        const float t = glm::dot(corner, axis);
        extent = {std::min(extent.x, t), std::max(extent.y, t)};
    }
    return extent;
}

glm::vec3 any_up(glm::vec3 forward) {
    const auto axis = std::abs(forward.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(0, 0, 1);
    return glm::normalize(axis - glm::dot(axis, forward) * forward);
}

/// Fills in the matrix that belongs to the other members.
ShadowViewData with_matrix(ShadowViewData v) {
    const float depth = v.far - v.near;
    const auto x = v.right_ws / glm::dot(v.right_ws, v.right_ws), y = v.up_ws / glm::dot(v.up_ws, v.up_ws);
    const bool perspective = v.perspective != 0;
    const auto z = v.forward_ws * (perspective ? v.far / depth : 1 / depth);
    const float z0 = -(perspective ? v.far * v.near : v.near) / depth;
    const auto w = perspective ? v.forward_ws : glm::vec3(0);
    const glm::mat4 rows(glm::vec4(x, -glm::dot(x, v.origin_ws)), glm::vec4(y, -glm::dot(y, v.origin_ws)),
                         glm::vec4(z, z0 - glm::dot(z, v.origin_ws)),
                         glm::vec4(w, perspective ? -glm::dot(w, v.origin_ws) : 1));
    v.clip_from_world = glm::transpose(rows);
    return v;
}

/// `tangent` of half the opening angle. The range of depths is that of the bounds, as far as light reaches.
ShadowViewData perspective_view(const scene::World& world, int light, glm::vec3 forward, float tangent) {
    const auto& source = world.lights[static_cast<std::size_t>(light)];
    const auto extent = extent_along(world.bounds, forward) - glm::dot(source.position, forward);
    float far = extent.y > 0 ? 1.001f * extent.y : 1.0f;
    if (source.range > 0) far = std::min(far, source.range);
    ShadowViewData v{};
    v.origin_ws = source.position;
    v.perspective = 1;
    v.up_ws = any_up(forward) * tangent;
    v.right_ws = glm::cross(forward, any_up(forward)) * tangent;
    v.forward_ws = forward;
    v.far = far;
    // a lamp's own bulb about its centre must not shadow everything
    v.near = std::min(std::max(0.999f * extent.x, 1e-4f * far), 0.5f * far);
    v.light = light;
    return with_matrix(v);
}

ShadowViewData orthographic_view(const scene::World& world, int light, int resolution) {
    const auto forward = world.lights[static_cast<std::size_t>(light)].direction;
    const auto up = any_up(forward), right = glm::cross(forward, up);
    const auto x = extent_along(world.bounds, right), y = extent_along(world.bounds, up),
               z = extent_along(world.bounds, forward);
    // a texel of margin on each side
    const float margin = 1 + 2.0f / static_cast<float>(resolution);
    const float least = std::max(1e-3f * (z.y - z.x), 1e-6f);
    ShadowViewData v{};
    v.right_ws = right * std::max(0.5f * margin * (x.y - x.x), least);
    v.up_ws = up * std::max(0.5f * margin * (y.y - y.x), least);
    v.forward_ws = forward;
    v.near = 0;
    v.far = (z.y - z.x) + 2 * least;
    v.origin_ws = right * 0.5f * (x.x + x.y) + up * 0.5f * (y.x + y.y) + forward * (z.x - least);
    v.light = light;
    return with_matrix(v);
}

constexpr std::array<glm::vec3, 6> cube_faces{glm::vec3{1, 0, 0},  glm::vec3{-1, 0, 0}, glm::vec3{0, 1, 0},
                                              glm::vec3{0, -1, 0}, glm::vec3{0, 0, 1},  glm::vec3{0, 0, -1}};

}  // namespace

std::vector<ShadowViewData> shadow_views(const scene::World& world, int resolution) {
    const float margin = 1 + 2.0f / static_cast<float>(resolution);
    std::vector<ShadowViewData> views;
    for (int i = 0; i < static_cast<int>(world.lights.size()); ++i) {
        const auto& light = world.lights[static_cast<std::size_t>(i)];
        const int layers = shadow_layers(light);
        if (layers == 6)
            for (const auto& face : cube_faces) views.push_back(perspective_view(world, i, face, 1));
        else if (light.type == scene::LightType::directional)
            views.push_back(orthographic_view(world, i, resolution));
        else if (layers == 1)
            views.push_back(perspective_view(world, i, light.direction,
                                             std::max(std::tan(light.outer_angle), 1e-3f) * margin));
    }
    return views;
}

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

void draw_shadow(const PassContext& p, const TriangleChunks& chunks, const ShadowViewData& view,
                 bool masked) {
    const auto opaque = p.inputs().world->opaque_triangles;
    const auto all = static_cast<std::uint32_t>(p.inputs().world->triangles());
    const auto runs = chunks.seen(view.clip_from_world,
                                  masked ? TriangleRun{opaque, all - opaque} : TriangleRun{0, opaque});
    if (runs.empty()) return;
    const auto& program =
        p.use({{"passes/shadow/shadow.vert", "passes/shadow/shadow.frag"}, {{"MASKED", masked ? "1" : "0"}}});
    program.set(DrawShadow{view.clip_from_world, view.origin_ws, view.forward_ws / view.far});
    draw_triangles(p, runs);
}

void draw_layers(const PassContext& p, const ShadowMaps& shadow, TriangleChunks& chunks, Slice slice) {
    const auto views = shadow_views(*p.inputs().world, p.shape(shadow.maps).width);
    if (slice.first) {
        p.upload(shadow.views, std::as_bytes(std::span(views)));
        chunks = TriangleChunks(*p.inputs().world);
    }
    p.bind_empty_vertex_array();
    p.api().Enable(GL_DEPTH_TEST);
    for (auto layer = slice.begin; layer < slice.end; ++layer) {
        const PassContext::Attachment depth{shadow.maps, static_cast<int>(layer)};
        p.bind_framebuffer({}, &depth);
        const float far = 1;
        p.api().ClearBufferfv(GL_DEPTH, 0, &far);
        if (static_cast<std::size_t>(layer) >= views.size()) continue;
        for (const bool masked : {false, true})
            draw_shadow(p, chunks, views[static_cast<std::size_t>(layer)], masked);
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
            maps.layers,
            [=, chunks = std::make_shared<TriangleChunks>()](PassContext& p, Slice slice) {
                draw_layers(p, shadow, *chunks, slice);
            },
            1);
    return shadow;
}

}  // namespace ir::passes
