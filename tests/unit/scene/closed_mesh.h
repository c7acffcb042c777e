#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include "renderers/core/error.h"
#include "renderers/scene/scene.h"

/// What tests of procedural scenes ask of their meshes.
namespace ir::scene::testing {

using Key = std::array<long, 3>;
/// A position to the micrometre.
inline Key key_of(glm::vec3 p) {
    return {std::lround(p.x * 1e6), std::lround(p.y * 1e6), std::lround(p.z * 1e6)};
}

/// How often the directed edges of triangles occur.
using Edges = std::map<std::pair<Key, Key>, int>;

inline void add_edges(Edges& edges, const Mesh& mesh) {
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
        for (int k = 0; k < 3; ++k)
            ++edges[{key_of(mesh.positions[mesh.indices[i + k]]),
                     key_of(mesh.positions[mesh.indices[i + (k + 1) % 3]])}];
}

/// Edges that are not passed as often in the other direction: none where all surfaces are closed and turned
/// the same way.
inline std::size_t open_edges(const Edges& edges) {
    std::size_t open = 0;
    for (const auto& [edge, count] : edges) {
        const auto opposite = edges.find({edge.second, edge.first});
        open += opposite == edges.end() || opposite->second != count;
    }
    return open;
}

inline std::size_t open_edges(const Mesh& mesh) {
    Edges edges;
    add_edges(edges, mesh);
    return open_edges(edges);
}

/// Signed: positive where the triangles face outwards.
inline double volume(const Mesh& mesh) {
    double sum = 0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const glm::dvec3 a = mesh.positions[mesh.indices[i]], b = mesh.positions[mesh.indices[i + 1]],
                         c = mesh.positions[mesh.indices[i + 2]];
        sum += glm::dot(a, glm::cross(b, c)) / 6;
    }
    return sum;
}

inline const Mesh& mesh_named(const Scene& scene, const std::string& name) {
    for (const auto& mesh : scene.meshes)
        if (mesh.name == name) return mesh;
    throw Error("no mesh " + name);
}

inline std::size_t triangles(const Scene& scene) {
    return scene.instanced_triangles();
}

/// Distance from a point to a triangle [Ericson, Real-Time Collision Detection, 5.1.5].
inline float distance_to(glm::vec3 p, glm::vec3 a, glm::vec3 b, glm::vec3 c) {
    const glm::vec3 ab = b - a, ac = c - a, ap = p - a;
    const float d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap);
    if (d1 <= 0 && d2 <= 0) return glm::length(ap);
    const glm::vec3 bp = p - b;
    const float d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp);
    if (d3 >= 0 && d4 <= d3) return glm::length(bp);
    const float vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return glm::distance(p, a + d1 / (d1 - d3) * ab);
    const glm::vec3 cp = p - c;
    const float d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
    if (d6 >= 0 && d5 <= d6) return glm::length(cp);
    const float vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return glm::distance(p, a + d2 / (d2 - d6) * ac);
    const float va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 >= d3 && d5 >= d6)
        return glm::distance(p, b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b));
    const float sum = va + vb + vc;
    return glm::distance(p, a + vb / sum * ab + vc / sum * ac);
}

}  // namespace ir::scene::testing
