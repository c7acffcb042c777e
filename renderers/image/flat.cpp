#include "renderers/image/flat.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

#include "renderers/image/comparison.h"

namespace ir {
namespace {

constexpr int heights_per_reach = 75;
constexpr float min_cosine = 0.9f, max_slope = 0.2f;

glm::vec3 vector_at(const Image& image, int x, int y) {
    return {image.at(x, y, 0), image.at(x, y, 1), image.at(x, y, 2)};
}

bool is_flat(const Image& normal, const Image& position, int x, int y, int reach) {
    const auto n = vector_at(normal, x, y), p = vector_at(position, x, y);
    for (int v = std::max(0, y - reach); v <= std::min(normal.height - 1, y + reach); ++v)
        for (int u = std::max(0, x - reach); u <= std::min(normal.width - 1, x + reach); ++u) {
            // Not the opposite comparison: what is not a number is not flat.
            if (!(glm::dot(n, vector_at(normal, u, v)) >= min_cosine)) return false;
            const auto step = vector_at(position, u, v) - p;
            if (!(std::abs(glm::dot(n, step)) <= max_slope * glm::length(step))) return false;
        }
    return true;
}

}  // namespace

Image flat_pixels(const Image& normal, const Image& position) {
    Image flat(normal.width, normal.height, 1);
    const int reach = std::max(1, (normal.height + heights_per_reach / 2) / heights_per_reach);
    for_each_row(normal.height, [&](int y) {
        for (int x = 0; x < normal.width; ++x) flat.at(x, y) = is_flat(normal, position, x, y, reach) ? 1 : 0;
    });
    return flat;
}

}  // namespace ir
