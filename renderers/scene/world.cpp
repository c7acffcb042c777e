#include "renderers/scene/world.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "renderers/core/error.h"
#include "renderers/scene/opacity.h"
#include "renderers/scene/placed_mesh.h"
#include "renderers/scene/placement.h"

namespace ir::scene {
namespace {

struct Instance {
    int node = 0, mesh = 0;
};

bool is_masked(const Scene& scene, int material) {
    return scene.materials[material].alpha_mode == AlphaMode::mask;
}

/// All drawn meshes: opaque ones first, then masked ones, each by material.
std::vector<Instance> sorted_instances(const Scene& scene) {
    std::vector<Instance> instances;
    for (std::size_t n = 0; n < scene.nodes.size(); ++n)
        for (const int mesh : scene.nodes[n].meshes) instances.push_back({static_cast<int>(n), mesh});
    const auto key = [&](const Instance& i) {
        const int material = scene.meshes[i.mesh].material;
        return std::pair{is_masked(scene, material), material};
    };
    std::stable_sort(instances.begin(), instances.end(),
                     [&](const Instance& a, const Instance& b) { return key(a) < key(b); });
    return instances;
}

std::uint32_t packed(glm::vec4 colour) {
    std::uint32_t result = 0;
    for (int i = 0; i < 4; ++i) {
        const float level = std::clamp(colour[i], 0.0f, 1.0f) * 255.0f + 0.5f;
        result |= static_cast<std::uint32_t>(level) << (8 * i);
    }
    return result;
}

class Flattener {
  public:
    Flattener(const Scene& scene, World& world) : scene_(scene), world_(world) {}

    void reserve(const std::vector<Instance>& instances) {
        // Vertices and triangles are counted in 32 bits, three indices to each triangle.
        constexpr std::size_t limit = std::size_t{1} << 30;
        std::size_t vertices = 0, indices = 0;
        for (const auto& instance : instances) {
            vertices += scene_.meshes[instance.mesh].positions.size();
            indices += scene_.meshes[instance.mesh].indices.size();
        }
        if (vertices > limit || indices > limit)
            throw InputError(scene_.name, "",
                             "instances add up to more than 2^30 vertices or indices; use fewer");
        world_.positions.reserve(vertices);
        world_.normals.reserve(vertices);
        world_.tangents.reserve(vertices);
        world_.uv0.reserve(vertices);
        world_.uv1.reserve(vertices);
        world_.colours.reserve(vertices);
        world_.indices.reserve(indices);
        world_.triangle_materials.reserve(indices / 3);
    }

    void add(const Mesh& mesh, const PlacedMesh& now, const PlacedMesh& before) {
        const auto first_vertex = world_.positions.size();
        add_vertices(mesh, now);
        add_triangles(mesh, now, static_cast<std::uint32_t>(first_vertex));
        if (now.stands_like(before)) return;
        world_.to_previous.resize(first_vertex, glm::vec3(0));
        for (std::size_t i = 0; i < now.vertices(); ++i)
            world_.to_previous.push_back(before.position(i) - world_.positions[first_vertex + i]);
    }

    void finish() {
        if (!world_.to_previous.empty()) world_.to_previous.resize(world_.positions.size(), glm::vec3(0));
    }

  private:
    void add_vertices(const Mesh& mesh, const PlacedMesh& placed) {
        for (std::size_t i = 0; i < placed.vertices(); ++i) {
            const auto normal = placed.normal(i);
            world_.positions.push_back(placed.position(i));
            world_.normals.push_back(normal);
            world_.tangents.push_back(placed.tangent(i, normal));
            world_.uv0.push_back(mesh.uv0.empty() ? glm::vec2(0) : mesh.uv0[i]);
            world_.uv1.push_back(mesh.uv1.empty() ? glm::vec2(0) : mesh.uv1[i]);
            world_.colours.push_back(mesh.colours.empty() ? 0xffffffffu : packed(mesh.colours[i]));
        }
    }

    /// Mirrored triangles are turned round, so that winding and normals agree on the front.
    void add_triangles(const Mesh& mesh, const PlacedMesh& placed, std::uint32_t first_vertex) {
        const auto count = static_cast<std::uint32_t>(mesh.indices.size() / 3);
        const auto first = static_cast<std::uint32_t>(world_.triangles());
        for (std::size_t t = 0; t < count; ++t) {
            const auto* corner = &mesh.indices[3 * t];
            const bool mirrored = placed.is_mirrored(corner[0]);
            world_.indices.push_back(first_vertex + corner[0]);
            world_.indices.push_back(first_vertex + corner[mirrored ? 2 : 1]);
            world_.indices.push_back(first_vertex + corner[mirrored ? 1 : 2]);
        }
        world_.triangle_materials.resize(first + count, static_cast<std::uint32_t>(mesh.material));
        if (!is_masked(scene_, mesh.material)) world_.opaque_triangles += count;
        if (world_.ranges.empty() || world_.ranges.back().material != mesh.material)
            world_.ranges.push_back({mesh.material, first, 0});
        world_.ranges.back().triangle_count += count;
    }

    const Scene& scene_;
    World& world_;
};

/// Throws where a transform took a position beyond the range of a float.
Bounds bounds_of_triangles(const World& world, const std::string& name) {
    if (world.indices.empty()) return {};
    Bounds bounds{world.positions[world.indices[0]], world.positions[world.indices[0]]};
    float check = 0;
    for (const auto index : world.indices) {
        const auto p = world.positions[index];
        bounds.min = glm::min(bounds.min, p);
        bounds.max = glm::max(bounds.max, p);
        check += 0 * (p.x + p.y + p.z);  // NaN as soon as one of them is not finite
    }
    if (std::isnan(check) || !std::isfinite(bounds.radius()))
        throw InputError(name, "nodes",
                         "a transform takes positions beyond the range of a float; scale it down");
    return bounds;
}

}  // namespace

int node_of_triangle(const Scene& scene, std::size_t triangle) {
    for (const auto& instance : sorted_instances(scene)) {
        const auto count = scene.meshes[instance.mesh].indices.size() / 3;
        if (triangle < count) return instance.node;
        triangle -= count;
    }
    return -1;
}

World flatten(const Scene& scene, double time, double previous_time) {
    World world;
    const auto current = pose_at(scene, time);
    const auto previous = previous_time == time ? current : pose_at(scene, previous_time);
    const auto instances = sorted_instances(scene);
    Flattener flattener(scene, world);
    flattener.reserve(instances);
    for (const auto& instance : instances)
        flattener.add(scene.meshes[instance.mesh], PlacedMesh(scene, current, instance.node, instance.mesh),
                      PlacedMesh(scene, previous, instance.node, instance.mesh));
    flattener.finish();
    world.bounds = bounds_of_triangles(world, scene.name);
    build_opacity(scene, world);
    for (const auto& light : scene.lights)
        world.lights.push_back(light.node >= 0 ? placed(light, current.matrices[light.node]) : light);
    for (const auto& camera : scene.cameras)
        world.cameras.push_back(camera.node >= 0 ? placed(camera, current.matrices[camera.node]) : camera);
    return world;
}

std::size_t memory_bytes(const World& world) {
    const auto of = [](const auto&... arrays) { return (... + (arrays.size() * sizeof(arrays[0]))); };
    return of(world.positions, world.normals, world.tangents, world.uv0, world.uv1, world.colours,
              world.to_previous, world.indices, world.triangle_materials, world.opacity_words);
}

std::size_t emissive_triangles(const Scene& scene, const World& world) {
    std::size_t count = 0;
    for (const auto& range : world.ranges) {
        const auto& emission = scene.materials.at(static_cast<std::size_t>(range.material)).emission;
        if (std::max({emission.r, emission.g, emission.b}) > 0) count += range.triangle_count;
    }
    return count;
}

}  // namespace ir::scene
