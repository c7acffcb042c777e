#include "renderers/passes/scene/hit_surfaces.h"

#include "renderers/core/record.h"
#include "renderers/graph/declared.h"
#include "renderers/passes/scene/texel_buffer.h"

namespace ir::passes {
namespace {

/// Four vec4 of hit_surface.glsl.
struct HitVertex {
    glm::vec3 position;
    std::uint32_t colour;
    glm::vec3 normal;
    float unused;
    glm::vec4 tangent;
    glm::vec2 uv0, uv1;
    IR_FIELDS(position, colour, normal, unused, tangent, uv0, uv1)
};
static_assert(sizeof(HitVertex) == 64);

void upload_vertices(const graph::PassContext& context, graph::BufferRef to) {
    const auto& w = *context.inputs().world;
    std::vector<HitVertex> vertices;
    vertices.reserve(w.positions.size());
    for (std::size_t i = 0; i < w.positions.size(); ++i)
        vertices.push_back(
            {w.positions[i], w.colours[i], w.normals[i], 0, w.tangents[i], w.uv0[i], w.uv1[i]});
    context.upload(to, std::as_bytes(std::span(vertices)));
}

}  // namespace

HitSurfaces hit_surfaces(graph::GraphBuilder& builder, const SceneBuffers& scene) {
    if (const auto known = graph::declared_buffer(builder, "scene.hit_vertices"))
        return {*known, graph::declared_buffer(builder, "scene.texels").value(), scene.indices,
                scene.triangle_materials, scene.materials};
    graph::BufferDesc desc;
    desc.text = {.key = "scene.hit_vertices", .label = "Vertices, each in one piece"};
    desc.name = "HitVertices";
    desc.fields = record_fields<HitVertex>();
    desc.elements = builder.inputs().world->positions.size();
    desc.fingerprint = builder.inputs().geometry_fingerprint;
    HitSurfaces result;
    result.vertices = builder.buffer(std::move(desc));
    builder.pass("upload hit vertices")
        .writes(result.vertices)
        .execute([vertices = result.vertices](graph::PassContext& context) {
            upload_vertices(context, vertices);
        });
    result.texels = texel_buffer(builder);
    result.indices = scene.indices;
    result.triangle_materials = scene.triangle_materials;
    result.materials = scene.materials;
    return result;
}

}  // namespace ir::passes
