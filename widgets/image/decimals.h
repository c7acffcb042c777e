#pragma once

#include <glm/glm.hpp>

namespace ir::widgets {

/// What a hand sets has no more decimals than can be seen: rounded to a power of ten that is at most a
/// thousandth of `extent`, of the picture's height at the place, say.
double in_decimals(double value, double extent);
glm::dvec3 in_decimals(const glm::dvec3& place, double extent);
/// Parts that are as they were before keep their digits.
glm::dvec3 moved_in_decimals(const glm::dvec3& before, const glm::dvec3& now, double extent);

}  // namespace ir::widgets
