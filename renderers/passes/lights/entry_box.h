#pragma once

#include <glm/glm.hpp>

#include "renderers/scene/scene.h"

namespace ir::passes {

/// The scene's bounds, a little larger: light from infinitely far comes in through its faces. Of a disk about
/// the bounds, which [Pharr16 §16.1.2] has, a cube's shadow covers two thirds, that of most scenes less.
class EntryBox {
  public:
    struct Point {
        glm::vec3 position_ws, normal_ws;  ///< the normal is unit length and points outwards
    };

    explicit EntryBox(const scene::Bounds& bounds);

    glm::vec3 centre_ws() const { return centre_; }
    /// m², of all faces.
    float area() const { return 2 * (face_areas_.x + face_areas_.y + face_areas_.z); }
    /// m², of the shadow along a unit direction.
    float area_across(glm::vec3 direction_ws) const { return glm::dot(face_areas_, glm::abs(direction_ws)); }
    /// A point of all faces by u in [0, 1)², uniformly in area.
    Point point(glm::vec2 u) const;
    /// Where light that travels in a unit direction comes in, by u in [0, 1)², uniformly across it.
    glm::vec3 entry(glm::vec3 direction_ws, glm::vec2 u) const;

  private:
    glm::vec3 on_face(int axis, float side, glm::vec2 u) const;

    glm::vec3 centre_, half_;  ///< half_: m, half of the sides
    glm::vec3 face_areas_;     ///< m², of one face across each axis
};

}  // namespace ir::passes
