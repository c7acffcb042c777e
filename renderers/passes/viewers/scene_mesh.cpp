#include "renderers/passes/viewers/scene_mesh.h"

#include <span>

namespace ir::passes::viewers {
namespace {

/// Constants of scene.vert and scene.frag.
struct Mesh {
    glm::mat4 clip_from_world;
    Shade shade;
    IR_FIELDS(clip_from_world, shade)
};

}  // namespace

SceneMesh::SceneMesh(const Tools& tools) : tools_(tools), positions_(tools.device), indices_(tools.device) {
    const auto& gl = tools_.api;
    gl.CreateVertexArrays(1, &vertex_array_);
    gl.EnableVertexArrayAttrib(vertex_array_, 0);
    gl.VertexArrayAttribFormat(vertex_array_, 0, 3, GL_FLOAT, GL_FALSE, 0);
    gl.VertexArrayAttribBinding(vertex_array_, 0, 0);
}

SceneMesh::~SceneMesh() {
    tools_.api.DeleteVertexArrays(1, &vertex_array_);
}

SceneMesh::Buffers SceneMesh::buffers(graph::Graph& graph, const graph::FrameInputs& inputs) {
    const auto& world = *inputs.world;
    const auto positions = graph.device_buffer("scene.positions"),
               indices = graph.device_buffer("scene.indices");
    const auto is_this_world = [&](const auto& buffer, std::size_t elements) {
        return buffer && buffer->desc.fingerprint == inputs.geometry_fingerprint &&
               buffer->elements == elements && graph::stride(buffer->desc) == 12;
    };
    if (is_this_world(positions, world.positions.size()) && is_this_world(indices, world.triangles()))
        return {positions->name, indices->name};
    if (inputs.geometry_fingerprint.empty() || fingerprint_ != inputs.geometry_fingerprint) {
        positions_.write(std::as_bytes(std::span(world.positions)), "3D view, positions");
        indices_.write(std::as_bytes(std::span(world.indices)), "3D view, triangles");
        fingerprint_ = inputs.geometry_fingerprint;
    }
    return {positions_.name(), indices_.name()};
}

void SceneMesh::draw(graph::Graph& graph, const graph::FrameInputs& inputs, const Sight& sight) {
    if (!inputs.world || inputs.world->triangles() == 0) return;
    const auto& gl = tools_.api;
    const auto from = buffers(graph, inputs);
    gl.VertexArrayVertexBuffer(vertex_array_, 0, from.positions, 0, 12);
    gl.VertexArrayElementBuffer(vertex_array_, from.indices);
    gl.BindVertexArray(vertex_array_);
    const auto& program = tools_.programs.get({{"passes/viewers/scene.vert", "passes/viewers/scene.frag"}});
    program.use();
    program.set(Mesh{sight.view.clip_from_world(), shade(sight)});
    // a little behind glyphs and lines that lie on surfaces
    gl.Enable(GL_POLYGON_OFFSET_FILL);
    gl.PolygonOffset(1, 4);
    gl.DrawElements(GL_TRIANGLES, static_cast<GLsizei>(inputs.world->indices.size()), GL_UNSIGNED_INT,
                    nullptr);
    gl.Disable(GL_POLYGON_OFFSET_FILL);
    gl.BindVertexArray(0);
    gl.VertexArrayVertexBuffer(vertex_array_, 0, 0, 0, 12);
    gl.VertexArrayElementBuffer(vertex_array_, 0);
}

}  // namespace ir::passes::viewers
