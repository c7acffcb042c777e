#include "renderers/passes/shadow/shadow_maps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "renderers/graph/pass_context.h"
#include "renderers/passes/direct/panes.h"
#include "renderers/passes/scene/draw_triangles.h"
#include "renderers/passes/scene/light_data.h"
#include "renderers/passes/shadow/texel_constants.h"

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
ShadowViewData perspective_view(const scene::World& world, int light, glm::vec3 forward, glm::vec3 up,
                                float tangent) {
    const auto& source = world.lights[static_cast<std::size_t>(light)];
    const auto extent = extent_along(world.bounds, forward) - glm::dot(source.position, forward);
    float far = extent.y > 0 ? 1.001f * extent.y : 1.0f;
    if (source.range > 0) far = std::min(far, source.range);
    ShadowViewData v{};
    v.origin_ws = source.position;
    v.perspective = 1;
    v.up_ws = up * tangent;
    v.right_ws = glm::cross(forward, up) * tangent;
    v.forward_ws = forward;
    v.far = far;
    // a lamp's own bulb about its centre must not shadow everything
    v.near = std::min(std::max(0.999f * extent.x, 1e-4f * far), 0.5f * far);
    v.light = light;
    return with_matrix(v);
}

/// The outer cone, with a texel of margin on each side.
ShadowViewData spot_view(const scene::World& world, int light, int resolution, glm::vec2 shift) {
    const auto& source = world.lights[static_cast<std::size_t>(light)];
    const float texel = 2 / static_cast<float>(resolution),
                tangent = std::max(std::tan(source.outer_angle), 1e-3f) * (1 + texel);
    const auto up = any_up(source.direction), right = glm::cross(source.direction, up);
    // A turn by δ moves the cone's edge by (1 + tangent²) δ in tangents, of which a texel has tangent ·
    // texel: so this one moves the edge by a texel, and the middle by less.
    const float turn = tangent * texel / (1 + tangent * tangent);
    const auto forward = glm::normalize(source.direction + turn * (shift.x * right + shift.y * up));
    return perspective_view(world, light, forward, any_up(forward), tangent);
}

ShadowViewData orthographic_view(const scene::World& world, int light, int resolution, glm::vec2 shift) {
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
    v.origin_ws = right * 0.5f * (x.x + x.y) + up * 0.5f * (y.x + y.y) + forward * (z.x - least) +
                  2 / static_cast<float>(resolution) * (shift.x * v.right_ws + shift.y * v.up_ws);
    v.light = light;
    return with_matrix(v);
}

constexpr std::array<glm::vec3, 6> cube_faces{glm::vec3{1, 0, 0},  glm::vec3{-1, 0, 0}, glm::vec3{0, 1, 0},
                                              glm::vec3{0, -1, 0}, glm::vec3{0, 0, 1},  glm::vec3{0, 0, -1}};

}  // namespace

std::vector<ShadowViewData> shadow_views(const scene::World& world, int resolution,
                                         const ViewJitter& jitter) {
    std::vector<ShadowViewData> views;
    for (int i = 0; i < static_cast<int>(world.lights.size()); ++i) {
        const auto& light = world.lights[static_cast<std::size_t>(i)];
        const int layers = shadow_layers(light);
        if (layers == 6)
            for (const auto& face : cube_faces)
                views.push_back(
                    perspective_view(world, i, jitter.turn * face, jitter.turn * any_up(face), 1));
        else if (light.type == scene::LightType::directional)
            views.push_back(orthographic_view(world, i, resolution, jitter.shift));
        else if (layers == 1)
            views.push_back(spot_view(world, i, resolution, jitter.shift));
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

struct ShadowDrawing {
    SceneBuffers scene;
    ShadowMaps shadow;
    Transport::Materials model;
    bool has_panes;
    std::shared_ptr<TriangleChunks> chunks = std::make_shared<TriangleChunks>();  ///< of the frame's world
};

/// Constants of pane.frag.
struct DrawPane {
    TexelConstants texel;
    bool normal_maps;
    int textures;
    IR_FIELDS(texel, normal_maps, textures)
};

const scene::Material& material_of(const PassContext& p, const scene::MaterialRange& range) {
    return p.inputs().scene->materials.at(static_cast<std::size_t>(range.material));
}

/// Of these triangles those that are no panes.
std::vector<TriangleRun> opaque_runs(const PassContext& p, const ShadowDrawing& d, TriangleRun among) {
    if (!d.has_panes) return {among};
    std::vector<TriangleRun> runs;
    for (const auto& range : p.inputs().world->ranges) {
        const auto begin = std::max(range.first_triangle, among.first),
                   end = std::min(range.first_triangle + range.triangle_count, among.first + among.count);
        if (begin < end && !Panes::may_be(material_of(p, range))) runs.push_back({begin, end - begin});
    }
    return runs;
}

void draw_shadow(const PassContext& p, const ShadowDrawing& d, const ShadowViewData& view, bool masked) {
    const auto opaque = p.inputs().world->opaque_triangles;
    const auto all = static_cast<std::uint32_t>(p.inputs().world->triangles());
    std::vector<TriangleRun> runs;
    for (const auto& run :
         opaque_runs(p, d, masked ? TriangleRun{opaque, all - opaque} : TriangleRun{0, opaque})) {
        const auto seen = d.chunks->seen(view.clip_from_world, run);
        runs.insert(runs.end(), seen.begin(), seen.end());
    }
    if (runs.empty()) return;
    const auto& program =
        p.use({{"passes/shadow/shadow.vert", "passes/shadow/shadow.frag"}, {{"MASKED", masked ? "1" : "0"}}});
    program.set(DrawShadow{view.clip_from_world, view.origin_ws, view.forward_ws / view.far});
    draw_triangles(p, runs);
}

/// What may be panes: what passes them, or the depth of what is none.
void draw_panes(const PassContext& p, const ShadowDrawing& d, const ShadowViewData& view, bool passed) {
    gl::ProgramSource source{{"passes/scene/triangles.vert", "passes/shadow/pane.frag"},
                             {{"MATERIALS", std::to_string(static_cast<int>(d.model))}}};
    if (passed) source.defines["PASSED"] = "1";
    const auto& program = p.use(source);
    DrawPane constants{texel_constants(view, p.shape(d.shadow.maps).width), false, 0};
    for (const auto& range : p.inputs().world->ranges) {
        const auto& material = material_of(p, range);
        if (!Panes::may_be(material)) continue;
        constants.texel.material_index = range.material;
        constants.textures = bind_textures(p, d.scene, material);
        program.set(constants);
        draw_triangles(p, d.chunks->seen(view.clip_from_world, {range.first_triangle, range.triangle_count}));
    }
}

/// Before what the layer holds already.
void multiply_by_panes(const PassContext& p, const ShadowDrawing& d, int layer, const ShadowViewData* view) {
    const PassContext::Attachment depth{d.shadow.maps, layer};
    p.bind_framebuffer({{d.shadow.panes, layer}}, view ? &depth : nullptr);
    const float one[4] = {1, 1, 1, 1};
    p.api().ClearBufferfv(GL_COLOR, 0, one);
    if (!view) return;
    p.api().DepthMask(GL_FALSE);
    p.api().Enable(GL_BLEND);
    p.api().BlendEquation(GL_FUNC_ADD);
    p.api().BlendFunc(GL_ZERO, GL_SRC_COLOR);
    draw_panes(p, d, *view, true);
    p.api().Disable(GL_BLEND);
    p.api().DepthMask(GL_TRUE);
}

void draw_layers(const PassContext& p, const ShadowDrawing& d, Slice slice) {
    const auto views = shadow_views(*p.inputs().world, p.shape(d.shadow.maps).width);
    if (slice.first) {
        p.upload(d.shadow.views, std::as_bytes(std::span(views)));
        *d.chunks = TriangleChunks(*p.inputs().world);
    }
    p.bind_empty_vertex_array();
    p.api().Enable(GL_DEPTH_TEST);
    for (auto at = slice.begin; at < slice.end; ++at) {
        const int layer = static_cast<int>(at);
        const auto* view =
            static_cast<std::size_t>(at) < views.size() ? &views[static_cast<std::size_t>(at)] : nullptr;
        const PassContext::Attachment depth{d.shadow.maps, layer};
        p.bind_framebuffer({}, &depth);
        const float far = 1;
        p.api().ClearBufferfv(GL_DEPTH, 0, &far);
        for (const bool masked : {false, true})
            if (view) draw_shadow(p, d, *view, masked);
        if (view && d.has_panes) draw_panes(p, d, *view, false);
        multiply_by_panes(p, d, layer, d.has_panes ? view : nullptr);
    }
    p.api().Disable(GL_DEPTH_TEST);
}

}  // namespace

ShadowMaps shadow_maps(GraphBuilder& builder, const SceneBuffers& scene, int resolution,
                       Transport::Materials model) {
    int layers = 0;
    for (const auto& light : builder.inputs().world->lights) layers += shadow_layers(light);
    const bool has_panes = Panes::any_in(builder.inputs().scene->materials, model);
    const auto& world = builder.inputs().world_fingerprint;
    const auto fingerprint =
        world.empty() ? "" : world + " at " + std::to_string(resolution) + (has_panes ? " behind panes" : "");

    graph::ImageDesc maps;
    maps.text = {"shadow.maps", "Shadow maps", "Depth along each map's axis over its far distance",
                 Semantic::depth};
    maps.name = "shadow_maps";
    maps.format = gl::Format::depth32f;
    maps.extent = graph::Extent::fixed(resolution, resolution);
    maps.layers = std::max(1, layers);
    maps.fingerprint = fingerprint;
    graph::ImageDesc panes = maps;
    panes.text = {
        "shadow.panes", "Panes before lights",
        "Fraction of the light that comes through sheets of clear glass to what the shadow map holds",
        Semantic::albedo};
    panes.name = "shadow_panes";
    panes.format = gl::Format::rgba16f;
    if (!has_panes) panes.extent = graph::Extent::fixed(1, 1);
    graph::BufferDesc views;
    views.text = {"shadow.views", "Views of the shadow maps"};
    views.name = "ShadowViews";
    views.fields = record_fields<ShadowViewData>();
    views.elements = static_cast<std::uint64_t>(layers);
    views.fingerprint = fingerprint;

    const ShadowDrawing drawing{
        scene, {builder.image(maps), builder.image(panes), builder.buffer(views)}, model, has_panes};
    auto pass = builder.pass("shadow maps");
    if (has_panes) {
        reads_triangles(pass, scene);
        reads_textures(pass, scene);
    } else {
        pass.reads(scene.positions, scene.indices, scene.uv0, scene.uv1, scene.materials, scene.opacity,
                   scene.opacity_words);
    }
    pass.reads(scene.triangle_materials)
        .writes(drawing.shadow.maps, drawing.shadow.panes, drawing.shadow.views)
        .execute_sliced(
            maps.layers, [=](PassContext& p, Slice slice) { draw_layers(p, drawing, slice); }, 1);
    return drawing.shadow;
}

}  // namespace ir::passes
