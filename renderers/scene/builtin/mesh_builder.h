#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "renderers/scene/scene.h"

namespace ir::scene::builtin {

struct Vertex {
    glm::vec3 position, normal;
    glm::vec2 uv;
};

enum class BoxFace { pos_x, neg_x, pos_y, neg_y, pos_z, neg_z };

/// Collects triangles, counter-clockwise seen from outside, with texture coordinates in metres.
class MeshBuilder {
  public:
    /// Applied to what is added afterwards; rigid, perhaps with a uniform scale.
    glm::mat4 transform{1};

    /// a, b, c, d counter-clockwise; u runs along ab, v along ad from `uv`.
    void quad(glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d, glm::vec2 uv = {0, 0});
    /// Six outward faces.
    void box(glm::vec3 min, glm::vec3 max);
    /// One of them.
    void box_face(BoxFace face, glm::vec3 min, glm::vec3 max);
    /// Six faces seen from within.
    void cavity(glm::vec3 min, glm::vec3 max);
    /// A box from `a` to `b` along its axis; `width` lies across, `height` along `up`, both centred on the
    /// axis.
    void beam(glm::vec3 a, glm::vec3 b, float width, float height, glm::vec3 up = {0, 1, 0});
    /// A surface over [0,1]² with shared vertices; outside is where ∂P/∂u × ∂P/∂v points.
    void grid(int columns, int rows, const std::function<Vertex(float u, float v)>& vertex);
    /// The same with normals by differences.
    void surface(int columns, int rows, const std::function<glm::vec3(float u, float v)>& position,
                 glm::vec2 uv_scale = {1, 1});

    std::size_t triangles() const { return mesh_.indices.size() / 3; }
    /// Moves the mesh out.
    Mesh take(const std::string& name, int material);

  private:
    std::uint32_t add(const Vertex& vertex);
    void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);
    Mesh mesh_;
};

/// Appends the mesh and a node of the same name that shows it. Does nothing for a mesh without triangles.
void add_mesh(Scene& scene, Mesh mesh);

/// Appends a rough dielectric and returns its index.
int add_material(Scene& scene, const std::string& name, glm::vec3 base_colour, float roughness = 0.9f);

/// Appends a perspective camera; `fov_y` in degrees.
void add_camera(Scene& scene, const std::string& name, glm::vec3 eye, glm::vec3 target, float fov_y,
                glm::vec3 up = {0, 1, 0});

/// A directional light of this name; W/m² on a surface that faces it.
Light sun(glm::vec3 direction, float intensity, glm::vec3 colour = glm::vec3(1));

}  // namespace ir::scene::builtin
