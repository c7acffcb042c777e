#include "renderers/passes/ldm/directions.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <numbers>
#include <numeric>
#include <random>

#include "renderers/core/error.h"

namespace ir::passes::ldm {
namespace {

using std::numbers::pi;

/// Colatitude at which a cap around the pole holds `covered` of `regions` equal areas.
double cap_colatitude(double covered, int regions) {
    return std::acos(std::clamp(1 - 2 * covered / regions, -1.0, 1.0));
}

/// Turns a collar against the one above it, so that their borders stay as far apart as they can.
/// [Leopardi06 §3.4]
double turned(double offset, int above, int below) {
    const double common = std::gcd(above, below);
    offset += 0.5 * (1.0 / below - 1.0 / above) + common / (2.0 * above * below);
    return offset - std::floor(offset);
}

void add_collar(std::vector<Direction>& result, double top, double bottom, int count, int kept,
                double offset) {
    const double step = 2 * pi / count, middle = 0.5 * (top + bottom);
    for (int i = 0; i < kept; ++i) {
        const double begin = 2 * pi * offset + i * step;
        result.push_back({on_sphere(middle, begin + 0.5 * step), top, bottom, begin, begin + step});
    }
}

}  // namespace

glm::dvec3 on_sphere(double colatitude, double longitude) {
    return {std::sin(colatitude) * std::cos(longitude), std::cos(colatitude),
            std::sin(colatitude) * std::sin(longitude)};
}

std::vector<int> collar_counts(int regions) {
    if (regions < 2 || regions % 2 != 0) throw UsageError("the sphere is cut into an even number of regions");
    if (regions == 2) return {};
    const double ideal_angle = std::sqrt(4 * pi / regions);
    const double cap = cap_colatitude(1, regions);
    const int collars = std::max(1, static_cast<int>(std::lround((pi - 2 * cap) / ideal_angle)));
    const double angle = (pi - 2 * cap) / collars;
    // Rounding with the running remainder is rounding of the running sum. The lower half mirrors the upper
    // one, so that no tie is rounded differently there.
    std::vector<int> counts(collars);
    int placed = 0;
    for (int i = 0; i < collars / 2; ++i) {
        const double covered = 0.5 * regions * (1 - std::cos(cap + (i + 1) * angle)) - 1;
        counts[i] = counts[collars - 1 - i] = static_cast<int>(std::lround(covered)) - placed;
        placed += counts[i];
    }
    if (collars % 2 == 1) counts[collars / 2] = regions - 2 - 2 * placed;
    return counts;
}

std::vector<Direction> leopardi_directions(int count) {
    if (count < 1) throw UsageError("directions: " + std::to_string(count) + " is less than 1");
    const int regions = 2 * count;
    std::vector<Direction> result;
    double top = cap_colatitude(1, regions);
    result.push_back({glm::dvec3(0, 1, 0), 0, top, 0, 2 * pi});
    const auto counts = collar_counts(regions);
    const int collars = static_cast<int>(counts.size());
    double covered = 1, offset = 0;
    for (int i = 0; i < (collars + 1) / 2; ++i) {
        const bool equatorial = collars % 2 == 1 && i == collars / 2;
        covered += counts[i];
        const double bottom = equatorial ? pi - top : cap_colatitude(covered, regions);
        if (i > 0) offset = turned(offset, counts[i - 1], counts[i]);
        add_collar(result, top, bottom, counts[i], equatorial ? counts[i] / 2 : counts[i], offset);
        top = bottom;
    }
    return result;
}

glm::dmat3 tilt() {
    const auto about = [](double angle, const glm::dvec3& axis) { return glm::angleAxis(angle, axis); };
    return glm::mat3_cast(about(0.63, {1, 0, 0}) * about(0.41, {0, 0, 1}));
}

glm::dmat3 random_rotation(std::uint64_t seed, int frame) {
    std::seed_seq words{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32),
                        static_cast<std::uint32_t>(frame)};
    std::mt19937_64 random(words);
    // 53 random bits; std::uniform_real_distribution may differ between libraries.
    const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
    // A uniform rotation as a unit quaternion of three uniform numbers. [Shoemake92]
    const double a = uniform(), b = 2 * pi * uniform(), c = 2 * pi * uniform();
    const double s = std::sqrt(1 - a), t = std::sqrt(a);
    return glm::mat3_cast(glm::dquat(t * std::cos(c), s * std::sin(b), s * std::cos(b), t * std::sin(c)));
}

}  // namespace ir::passes::ldm
