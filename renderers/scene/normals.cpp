#include <algorithm>
#include <cmath>

#include "renderers/scene/frame.h"
#include "renderers/scene/scene.h"

namespace ir::scene {
namespace {

/// Angle between two edges; 0 for an edge without length.
float angle(glm::vec3 a, glm::vec3 b) {
    const float lengths = glm::length(a) * glm::length(b);
    if (!(lengths > 0)) return 0;
    return std::acos(std::clamp(glm::dot(a, b) / lengths, -1.0f, 1.0f));
}

/// dP/du and dP/dv of a triangle, unit length; false where the texture coordinates span no area.
/// [Lengyel01 eq. 7.38]
bool texture_axes(const Mesh& mesh, const std::uint32_t* corner, glm::vec3& du, glm::vec3& dv) {
    const auto e1 = mesh.positions[corner[1]] - mesh.positions[corner[0]];
    const auto e2 = mesh.positions[corner[2]] - mesh.positions[corner[0]];
    const auto t1 = mesh.uv0[corner[1]] - mesh.uv0[corner[0]];
    const auto t2 = mesh.uv0[corner[2]] - mesh.uv0[corner[0]];
    const float area = t1.x * t2.y - t2.x * t1.y;
    if (area == 0 || !std::isfinite(area)) return false;
    const float sign = area < 0 ? -1.0f : 1.0f;
    const auto u = sign * (e1 * t2.y - e2 * t1.y), v = sign * (e2 * t1.x - e1 * t2.x);
    const float lu = glm::length(u), lv = glm::length(v);
    if (!(lu > 0 && lv > 0 && std::isfinite(lu) && std::isfinite(lv))) return false;
    du = u / lu;
    dv = v / lv;
    return true;
}

/// [glTF 2.0, 3.7.2.1: bitangent = cross(normal, tangent.xyz) * tangent.w]; it points up in the image,
/// towards -v.
glm::vec4 tangent_of(glm::vec3 normal, glm::vec3 du, glm::vec3 dv) {
    const auto projected = du - normal * glm::dot(normal, du);
    const float length = glm::length(projected);
    if (!(length > 1e-6f)) return glm::vec4(any_tangent(normal), 1);
    const auto tangent = projected / length;
    return glm::vec4(tangent, glm::dot(glm::cross(normal, tangent), dv) > 0 ? -1.0f : 1.0f);
}

}  // namespace

void generate_normals(Mesh& mesh) {
    mesh.normals.assign(mesh.positions.size(), glm::vec3(0));
    for (std::size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
        const auto* corner = &mesh.indices[t];
        const auto p = [&](int i) { return mesh.positions[corner[i % 3]]; };
        const auto cross = glm::cross(p(1) - p(0), p(2) - p(0));
        const float length = glm::length(cross);
        if (!(length > 0) || !std::isfinite(length)) continue;
        for (int i = 0; i < 3; ++i)
            mesh.normals[corner[i]] += cross / length * angle(p(i + 1) - p(i), p(i + 2) - p(i));
    }
    for (auto& normal : mesh.normals) {
        const float length = glm::length(normal);
        normal = length > 0 ? normal / length : glm::vec3(0, 1, 0);
    }
}

void generate_tangents(Mesh& mesh) {
    const auto count = mesh.positions.size();
    std::vector<glm::vec3> du(count, glm::vec3(0)), dv(count, glm::vec3(0));
    for (std::size_t t = 0; t + 2 < mesh.indices.size() && mesh.uv0.size() == count; t += 3) {
        glm::vec3 u, v;
        if (!texture_axes(mesh, &mesh.indices[t], u, v)) continue;
        for (int i = 0; i < 3; ++i) {
            du[mesh.indices[t + i]] += u;
            dv[mesh.indices[t + i]] += v;
        }
    }
    mesh.tangents.resize(count);
    for (std::size_t i = 0; i < count; ++i) mesh.tangents[i] = tangent_of(mesh.normals[i], du[i], dv[i]);
}

}  // namespace ir::scene
