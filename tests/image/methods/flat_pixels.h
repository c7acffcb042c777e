#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <vector>

#include "renderers/image/image.h"

namespace ir::test {

/// Pixels all of whose neighbours, up to `reach` pixels away, lie in one plane up to `tolerance` m; none at
/// the picture's border. From a G-buffer's geometric normals and positions.
inline std::vector<glm::ivec2> flat_pixels(const Image& normal, const Image& position, int reach,
                                           float tolerance) {
    const auto vector = [](const Image& image, int x, int y) {
        return glm::vec3(image.at(x, y, 0), image.at(x, y, 1), image.at(x, y, 2));
    };
    const auto is_flat = [&](int x, int y) {
        const auto n = vector(normal, x, y), p = vector(position, x, y);
        if (n == glm::vec3(0)) return false;
        for (int v = y - reach; v <= y + reach; ++v)
            for (int u = x - reach; u <= x + reach; ++u)
                if (glm::dot(n, vector(normal, u, v)) < 0.99f ||
                    std::abs(glm::dot(n, vector(position, u, v) - p)) > tolerance)
                    return false;
        return true;
    };
    std::vector<glm::ivec2> flat;
    for (int y = reach; y < normal.height - reach; ++y)
        for (int x = reach; x < normal.width - reach; ++x)
            if (is_flat(x, y)) flat.emplace_back(x, y);
    return flat;
}

}  // namespace ir::test
