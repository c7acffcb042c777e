#pragma once

#include <glm/glm.hpp>
#include <vector>

/// Where the dominoes stand, lean and lie; metres. The floor is y = 0.
namespace ir::scene::builtin::dominoes_parts {

constexpr float height = 0.056f, width = 0.028f, thickness = 0.0105f;
constexpr float sunk = 0.0003f;  ///< in the floor, so that nothing lies in its plane

/// A domino of the row: the middle of its lower front edge, the way that it looks and falls, and by how much
/// it has fallen.
struct Place {
    glm::vec2 foot;  ///< x, z
    float heading;   ///< radians; 0 looks along +x, a right angle along −z
    float fallen;    ///< radians; 0 stands
};

/// Angle at which a domino rests with its upper front edge on the back of the next one, which is `distance`
/// further along and has fallen by `next`.
float resting_angle(float distance, float next);

/// The row, in the order in which it falls.
std::vector<Place> row();

}  // namespace ir::scene::builtin::dominoes_parts
