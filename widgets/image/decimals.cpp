#include "widgets/image/decimals.h"

#include <cmath>

namespace ir::widgets {

double in_decimals(double value, double extent) {
    if (!(extent > 0) || !std::isfinite(extent) || !std::isfinite(value)) return value;
    const int exponent = int(std::floor(std::log10(extent))) - 3;
    const double power = std::pow(10.0, std::abs(exponent));  // whole, so that 0.3 is 3 / 10
    return exponent < 0 ? std::round(value * power) / power : std::round(value / power) * power;
}

glm::dvec3 in_decimals(const glm::dvec3& place, double extent) {
    return {in_decimals(place.x, extent), in_decimals(place.y, extent), in_decimals(place.z, extent)};
}

glm::dvec3 moved_in_decimals(const glm::dvec3& before, const glm::dvec3& now, double extent) {
    constexpr double nothing = 1e-9;
    auto rounded = now;
    for (int i = 0; i < 3; ++i)
        if (std::abs(now[i] - before[i]) > nothing * extent) rounded[i] = in_decimals(now[i], extent);
    return rounded;
}

}  // namespace ir::widgets
