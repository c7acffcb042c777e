#include "renderers/scene/placed_mesh.h"

#include <algorithm>
#include <cmath>

#include "renderers/scene/frame.h"

namespace ir::scene {
namespace {

glm::vec3 unit_or(glm::vec3 v, glm::vec3 otherwise) {
    const float length = glm::length(v);
    return length > 0 && std::isfinite(length) ? v / length : otherwise;
}

}  // namespace

PlacedMesh::Transform::Transform(const glm::mat4& world_from_mesh) : matrix(world_from_mesh) {
    const glm::mat3 m(matrix);
    cofactors = glm::mat3(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
    mirrored = glm::dot(m[0], cofactors[0]) < 0;
    if (mirrored) cofactors *= -1.0f;
}

PlacedMesh::PlacedMesh(const Scene& scene, const Pose& pose, int node, int mesh)
    : mesh_(scene.meshes[static_cast<std::size_t>(mesh)]),
      whole_(pose.matrices[static_cast<std::size_t>(node)]) {
    const int skin = scene.nodes[static_cast<std::size_t>(node)].skin;
    if (skin >= 0 && !mesh_.influences.empty()) {
        const auto& bound = scene.skins[static_cast<std::size_t>(skin)];
        for (std::size_t j = 0; j < bound.joints.size(); ++j)
            joints_.push_back(pose.matrices[static_cast<std::size_t>(bound.joints[j])] *
                              bound.inverse_bind[j]);
    }
    const auto& weights = pose.weights[static_cast<std::size_t>(node)];
    const bool has_shape = std::ranges::any_of(weights, [](float weight) { return weight != 0; });
    if (!mesh_.targets.empty() && has_shape) weights_ = weights;
}

/// [glTF 2.0, 3.7.3.3: the joints' matrices are blended]
glm::mat4 PlacedMesh::blended(std::size_t vertex) const {
    const auto& influences = mesh_.influences[vertex];
    glm::mat4 matrix(0);
    for (std::size_t i = 0; i < Influences::max; ++i)
        if (influences.weights[i] > 0) matrix += influences.weights[i] * joints_[influences.joints[i]];
    return matrix;
}

/// [glTF 2.0, 3.7.2.2: weighted displacements are added, before the skin]
template <class Vector>
Vector PlacedMesh::morphed(Vector value, std::vector<glm::vec3> MorphTarget::*deltas,
                           std::size_t vertex) const {
    for (std::size_t t = 0; t < weights_.size(); ++t)
        if (const auto& delta = mesh_.targets[t].*deltas; weights_[t] != 0 && !delta.empty())
            for (int c = 0; c < 3; ++c) value[c] += weights_[t] * delta[vertex][c];
    return value;
}

glm::vec3 PlacedMesh::position(std::size_t vertex) const {
    const glm::vec4 p(morphed(mesh_.positions[vertex], &MorphTarget::positions, vertex), 1);
    return glm::vec3(is_skinned() ? blended(vertex) * p : whole_.matrix * p);
}

/// The vertices of faceted meshes stand in the order of their triangles.
glm::vec3 PlacedMesh::facet_normal(std::size_t vertex) const {
    const auto first = vertex / 3 * 3;
    const auto origin = position(first);
    const auto face = glm::cross(position(first + 1) - origin, position(first + 2) - origin);
    return unit_or(is_mirrored(first) ? -face : face, {0, 1, 0});
}

glm::vec3 PlacedMesh::normal(std::size_t vertex) const {
    if (mesh_.is_faceted && (is_skinned() || !weights_.empty())) return facet_normal(vertex);
    const auto normal = morphed(mesh_.normals[vertex], &MorphTarget::normals, vertex);
    return unit_or((is_skinned() ? Transform(blended(vertex)).cofactors : whole_.cofactors) * normal,
                   {0, 1, 0});
}

glm::vec4 PlacedMesh::tangent(std::size_t vertex, glm::vec3 normal_ws) const {
    if (mesh_.tangents.empty()) return glm::vec4(any_tangent(normal_ws), 1);
    const auto t = morphed(mesh_.tangents[vertex], &MorphTarget::tangents, vertex);
    const glm::mat3 matrix(is_skinned() ? blended(vertex) : whole_.matrix);
    return glm::vec4(unit_or(matrix * glm::vec3(t), any_tangent(normal_ws)),
                     is_mirrored(vertex) ? -t.w : t.w);
}

bool PlacedMesh::is_mirrored(std::size_t vertex) const {
    return is_skinned() ? Transform(blended(vertex)).mirrored : whole_.mirrored;
}

bool PlacedMesh::stands_like(const PlacedMesh& other) const {
    const bool same_place = is_skinned() ? joints_ == other.joints_ : whole_.matrix == other.whole_.matrix;
    return same_place && weights_ == other.weights_;
}

}  // namespace ir::scene
