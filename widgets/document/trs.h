#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>

namespace ir::widgets {

using Matrix = std::array<double, 16>;  ///< column-major

/// A transform as people give it: scaled along its own axes, then turned about the fixed x, then y, then z
/// axis, then moved.
struct Trs {
    glm::dvec3 translation{0};       ///< metres
    glm::dvec3 rotation_degrees{0};  ///< about x, y, z, in this order
    glm::dvec3 scale{1};
    bool operator==(const Trs&) const = default;
};

Matrix matrix_of(const Trs& trs);
/// Nothing where the matrix is something else (shear, projection, flattened): then it is not to be touched by
/// way of these numbers. "Equal" allows for rounding, 1e-12 of the largest element.
std::optional<Trs> trs_of(const Matrix& matrix);
/// Whether two matrices are equal up to that rounding.
bool nearly_equal(const Matrix& a, const Matrix& b);

}  // namespace ir::widgets
