#include "renderers/passes/lights/entry_box.h"

#include <algorithm>

namespace ir::passes {
namespace {

constexpr float wider = 2e-4f;  ///< parts of the radius: rays start outside of what lies in the faces
constexpr float least = 1e-3f;  ///< m, radius of a scene of one point

/// Which axis a number in [0, 1) chooses, by weights that are not all 0; `u` becomes uniform in [0, 1) again.
int chosen_axis(glm::vec3 weights, float& u) {
    constexpr float below_one = 0x1.fffffep-1f;
    float left = u * (weights.x + weights.y + weights.z);
    int axis = 0;
    while (axis < 2 && (left >= weights[axis] || weights[axis] == 0)) left -= weights[axis++];
    u = weights[axis] > 0 ? std::clamp(left / weights[axis], 0.0f, below_one) : 0;
    return axis;
}

}  // namespace

EntryBox::EntryBox(const scene::Bounds& bounds)
    : centre_(bounds.centre()),
      half_(0.5f * (bounds.max - bounds.min) + wider * std::max(bounds.radius(), least)),
      face_areas_(4.0f * glm::vec3(half_.y * half_.z, half_.z * half_.x, half_.x * half_.y)) {}

glm::vec3 EntryBox::on_face(int axis, float side, glm::vec2 u) const {
    const auto place = 2.0f * u - 1.0f;
    glm::vec3 at(0);
    at[axis] = side;
    at[(axis + 1) % 3] = place.x;
    at[(axis + 2) % 3] = place.y;
    return centre_ + half_ * at;
}

EntryBox::Point EntryBox::point(glm::vec2 u) const {
    const int axis = chosen_axis(face_areas_, u.x);
    const float side = u.x < 0.5f ? -1.0f : 1.0f;
    u.x = u.x < 0.5f ? 2 * u.x : 2 * u.x - 1;
    glm::vec3 normal(0);
    normal[axis] = side;
    return {on_face(axis, side, u), normal};
}

glm::vec3 EntryBox::entry(glm::vec3 direction_ws, glm::vec2 u) const {
    const int axis = chosen_axis(face_areas_ * glm::abs(direction_ws), u.x);
    return on_face(axis, direction_ws[axis] > 0 ? -1.0f : 1.0f, u);
}

}  // namespace ir::passes
