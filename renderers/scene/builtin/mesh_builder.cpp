#include "renderers/scene/builtin/mesh_builder.h"

#include <cmath>

namespace ir::scene::builtin {

std::uint32_t MeshBuilder::add(const Vertex& vertex) {
    mesh_.positions.push_back(glm::vec3(transform * glm::vec4(vertex.position, 1)));
    mesh_.normals.push_back(glm::normalize(glm::mat3(transform) * vertex.normal));
    mesh_.uv0.push_back(vertex.uv);
    return static_cast<std::uint32_t>(mesh_.positions.size() - 1);
}

/// Leaves out triangles without area, as at the poles of a sphere.
void MeshBuilder::add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const auto& p = mesh_.positions;
    if (glm::length(glm::cross(p[b] - p[a], p[c] - p[a])) < 1e-10f) return;
    mesh_.indices.insert(mesh_.indices.end(), {a, b, c});
}

void MeshBuilder::quad(glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d, glm::vec2 uv) {
    const glm::vec3 normal = glm::normalize(glm::cross(c - a, d - b));
    const glm::vec3 u = glm::normalize(glm::length(b - a) > 0 ? b - a : c - d);
    const glm::vec3 v = glm::cross(normal, u);
    std::uint32_t index[4];
    const glm::vec3 corners[4] = {a, b, c, d};
    for (int i = 0; i < 4; ++i) {
        const glm::vec3 offset = corners[i] - a;
        index[i] = add({corners[i], normal, uv + glm::vec2(glm::dot(offset, u), glm::dot(offset, v))});
    }
    add_triangle(index[0], index[1], index[2]);
    add_triangle(index[0], index[2], index[3]);
}

void MeshBuilder::box_face(BoxFace face, glm::vec3 lo, glm::vec3 hi) {
    const auto corner = [&](int x, int y, int z) {
        return glm::vec3(x ? hi.x : lo.x, y ? hi.y : lo.y, z ? hi.z : lo.z);
    };
    switch (face) {
        case BoxFace::pos_z:
            return quad(corner(0, 0, 1), corner(1, 0, 1), corner(1, 1, 1), corner(0, 1, 1), {lo.x, lo.y});
        case BoxFace::neg_z:
            return quad(corner(1, 0, 0), corner(0, 0, 0), corner(0, 1, 0), corner(1, 1, 0), {-hi.x, lo.y});
        case BoxFace::pos_x:
            return quad(corner(1, 0, 1), corner(1, 0, 0), corner(1, 1, 0), corner(1, 1, 1), {-hi.z, lo.y});
        case BoxFace::neg_x:
            return quad(corner(0, 0, 0), corner(0, 0, 1), corner(0, 1, 1), corner(0, 1, 0), {lo.z, lo.y});
        case BoxFace::pos_y:
            return quad(corner(0, 1, 1), corner(1, 1, 1), corner(1, 1, 0), corner(0, 1, 0), {lo.x, -hi.z});
        case BoxFace::neg_y:
            return quad(corner(0, 0, 0), corner(1, 0, 0), corner(1, 0, 1), corner(0, 0, 1), {lo.x, lo.z});
    }
}

void MeshBuilder::box(glm::vec3 lo, glm::vec3 hi) {
    for (const auto face :
         {BoxFace::pos_z, BoxFace::neg_z, BoxFace::pos_x, BoxFace::neg_x, BoxFace::pos_y, BoxFace::neg_y})
        box_face(face, lo, hi);
}

void MeshBuilder::cavity(glm::vec3 lo, glm::vec3 hi) {
    MeshBuilder outside;
    outside.transform = transform;
    outside.box(lo, hi);
    const auto first = static_cast<std::uint32_t>(mesh_.positions.size());
    const Mesh& other = outside.mesh_;
    for (std::size_t i = 0; i < other.positions.size(); ++i) {
        mesh_.positions.push_back(other.positions[i]);
        mesh_.normals.push_back(-other.normals[i]);
        mesh_.uv0.push_back(other.uv0[i]);
    }
    for (std::size_t i = 0; i < other.indices.size(); i += 3)
        add_triangle(first + other.indices[i], first + other.indices[i + 2], first + other.indices[i + 1]);
}

void MeshBuilder::beam(glm::vec3 a, glm::vec3 b, float width, float height, glm::vec3 up) {
    const glm::vec3 along = glm::normalize(b - a);
    const glm::vec3 across = glm::normalize(glm::cross(up, along));
    const glm::vec3 high = glm::cross(along, across);
    const glm::mat4 before = transform;
    transform =
        before * glm::mat4(glm::vec4(across, 0), glm::vec4(high, 0), glm::vec4(along, 0), glm::vec4(a, 1));
    box({-width / 2, -height / 2, 0}, {width / 2, height / 2, glm::length(b - a)});
    transform = before;
}

void MeshBuilder::grid(int columns, int rows, const std::function<Vertex(float, float)>& vertex) {
    const auto first = static_cast<std::uint32_t>(mesh_.positions.size());
    for (int j = 0; j <= rows; ++j)
        for (int i = 0; i <= columns; ++i) add(vertex(float(i) / columns, float(j) / rows));
    const auto at = [=](int i, int j) { return first + static_cast<std::uint32_t>(j * (columns + 1) + i); };
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i) {
            add_triangle(at(i, j), at(i + 1, j), at(i + 1, j + 1));
            add_triangle(at(i, j), at(i + 1, j + 1), at(i, j + 1));
        }
}

void MeshBuilder::surface(int columns, int rows, const std::function<glm::vec3(float, float)>& position,
                          glm::vec2 uv_scale) {
    const float h = 1e-3f;
    grid(columns, rows, [&](float u, float v) {
        const glm::vec3 du = position(u + h, v) - position(u - h, v);
        const glm::vec3 dv = position(u, v + h) - position(u, v - h);
        return Vertex{position(u, v), glm::normalize(glm::cross(du, dv)), glm::vec2(u, v) * uv_scale};
    });
}

Mesh MeshBuilder::take(const std::string& name, int material) {
    Mesh result = std::move(mesh_);
    mesh_ = {};
    result.name = name;
    result.material = material;
    return result;
}

void add_mesh(Scene& scene, Mesh mesh) {
    if (mesh.indices.empty()) return;
    Node node;
    node.name = mesh.name;
    node.meshes = {static_cast<int>(scene.meshes.size())};
    scene.nodes.push_back(node);
    scene.meshes.push_back(std::move(mesh));
}

int add_material(Scene& scene, const std::string& name, glm::vec3 base_colour, float roughness) {
    Material material;
    material.name = name;
    material.base_colour = glm::vec4(base_colour, 1);
    material.metallic = 0;
    material.roughness = roughness;
    scene.materials.push_back(material);
    return static_cast<int>(scene.materials.size()) - 1;
}

Light sun(glm::vec3 direction, float intensity, glm::vec3 colour) {
    Light light;
    light.name = "sun";
    light.type = LightType::directional;
    light.direction = glm::normalize(direction);
    light.colour = colour;
    light.intensity = intensity;
    return light;
}

void add_camera(Scene& scene, const std::string& name, glm::vec3 eye, glm::vec3 target, float fov_y,
                glm::vec3 up) {
    Camera camera;
    camera.name = name;
    camera.eye = eye;
    camera.target = target;
    camera.up = up;
    camera.fov_y = glm::radians(fov_y);
    scene.cameras.push_back(camera);
}

}  // namespace ir::scene::builtin
