#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "renderers/scene/scene.h"

namespace ir::scene {

/// Which node draws a triangle of the scene as flatten() makes it; -1: there is no such triangle.
int node_of_triangle(const Scene& scene, std::size_t triangle);

/// A mesh as a node draws it in a pose, in world space: moved as a whole, or morphed and bent by the joints
/// of a skin. Scene and pose must outlive it.
class PlacedMesh {
  public:
    PlacedMesh(const Scene& scene, const Pose& pose, int node, int mesh);

    std::size_t vertices() const { return mesh_.positions.size(); }
    glm::vec3 position(std::size_t vertex) const;
    glm::vec3 normal(std::size_t vertex) const;  ///< unit length
    /// w: handedness.
    glm::vec4 tangent(std::size_t vertex, glm::vec3 normal_ws) const;
    bool is_mirrored(std::size_t vertex) const;
    /// Whether all vertices are where those of the same mesh in another pose are.
    bool stands_like(const PlacedMesh& other) const;

  private:
    /// Normals take the cofactors, which are the inverse transpose up to a factor and exist for singular
    /// matrices too.
    struct Transform {
        explicit Transform(const glm::mat4& world_from_mesh);
        glm::mat4 matrix;
        glm::mat3 cofactors;
        bool mirrored;
    };

    bool is_skinned() const { return !joints_.empty(); }
    glm::mat4 blended(std::size_t vertex) const;
    glm::vec3 facet_normal(std::size_t vertex) const;
    template <class Vector>
    Vector morphed(Vector value, std::vector<glm::vec3> MorphTarget::*deltas, std::size_t vertex) const;

    const Mesh& mesh_;
    Transform whole_;
    std::vector<glm::mat4> joints_;  ///< world from mesh, of each joint
    std::vector<float> weights_;     ///< of morph targets; empty where all are 0
};

}  // namespace ir::scene
