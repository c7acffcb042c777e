#include "renderers/methods/photon-mapping/splatting/stages.h"

#include <cmath>

namespace ir::methods::photon_mapping {

Icosahedron icosahedron() {
    Icosahedron result{};
    const float golden = 0.5f * (1 + std::sqrt(5.0f));
    std::size_t vertex = 0;
    for (int axis = 0; axis < 3; ++axis)
        for (const float a : {-1.0f, 1.0f})
            for (const float b : {-golden, golden}) {
                glm::vec3 v(0);
                v[(axis + 1) % 3] = a;
                v[(axis + 2) % 3] = b;
                result.vertices[vertex++] = glm::normalize(v);
            }
    // Vertices that share an edge are the nearest to each other; three that do share a face.
    const float edge = 2 / std::sqrt(1 + golden * golden);
    const auto is_edge = [&](std::uint32_t a, std::uint32_t b) {
        return glm::distance(result.vertices[a], result.vertices[b]) < 1.1f * edge;
    };
    std::size_t corner = 0;
    for (std::uint32_t a = 0; a < 12; ++a)
        for (std::uint32_t b = a + 1; b < 12; ++b)
            for (std::uint32_t c = b + 1; c < 12; ++c) {
                if (!is_edge(a, b) || !is_edge(b, c) || !is_edge(a, c)) continue;
                const auto &p = result.vertices[a], &q = result.vertices[b], &r = result.vertices[c];
                const bool outwards = glm::dot(glm::cross(q - p, r - p), p) > 0;
                result.corners[corner++] = a;
                result.corners[corner++] = outwards ? b : c;
                result.corners[corner++] = outwards ? c : b;
            }
    return result;
}

}  // namespace ir::methods::photon_mapping
