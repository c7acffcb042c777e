#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "renderers/scene/builtin/mesh_builder.h"

/// Closed bodies, in metres, added to a MeshBuilder in its current space.
namespace ir::scene::builtin {

struct Box {
    glm::vec3 min, max;
};

/// A box from which other boxes, which may overlap, are taken: rooms and the doorways between them. The
/// surface goes to the builders by `paint`, which is told a face's middle and outward normal and returns the
/// builder's number: so the surfaces of all builders together are closed. Faces end where any hole's plane
/// passes.
struct Carving {
    Box body;
    std::vector<Box> holes;
    std::function<int(glm::vec3 middle, glm::vec3 normal)> paint;
};
void carve(std::span<MeshBuilder> builders, const Carving& carving);

/// A box whose vertical edges are rounded by `corner` and whose others are by `edge`; 0 < edge ≤ corner ≤ the
/// half sides. Texture coordinates are (x, z).
struct Slab {
    glm::vec3 min, max;
    float corner, edge;
};
void slab(MeshBuilder& b, const Slab& slab, int segments);

/// A round bar from a to c with flat ends.
void bar(MeshBuilder& b, glm::vec3 a, glm::vec3 c, float radius, int segments);

/// A ball with its poles on the y axis.
void ball(MeshBuilder& b, glm::vec3 centre, float radius, int segments);

/// A tube around a plane curve with 0 ≤ t ≤ 1 and flat ends. `side`: unit normal of the curve's plane.
struct Tube {
    std::function<glm::vec3(float t)> curve;
    std::function<float(float t)> radius;
    glm::vec3 side;
    bool is_ring = false;  ///< ends where it starts
};
void tube(MeshBuilder& b, const Tube& tube, int along, int around);

/// A sheet of the given thickness over [0,1]² with its edges; `position` is its upper side, outside where
/// ∂P/∂u × ∂P/∂v points.
void sheet(MeshBuilder& b, int columns, int rows, const std::function<glm::vec3(float, float)>& position,
           float thickness, glm::vec2 uv_scale);

}  // namespace ir::scene::builtin
