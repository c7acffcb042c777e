#include "renderers/scene/scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "renderers/core/hash.h"
#include "renderers/scene/placed_mesh.h"

namespace ir::scene {

std::string Environment::hash_of_map() const {
    if (!map || !map_hash.empty()) return map_hash;
    return hash_of(*map);
}

bool Environment::operator==(const Environment& other) const {
    if (constant != other.constant || (map == nullptr) != (other.map == nullptr)) return false;
    return map == other.map || (map->width == other.map->width && hash_of_map() == other.hash_of_map());
}

std::string hash_of(const Image& image) {
    const auto bytes = std::as_bytes(std::span(image.pixels));
    return hash_bytes({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

Environment map_environment(std::shared_ptr<const Image> map) {
    auto hash = hash_of(*map);
    return {glm::vec3(0), std::move(map), std::move(hash)};
}

float Scene::duration() const {
    float last = 0;
    for (const auto& channel : animation)
        if (!channel.times.empty()) last = std::max(last, channel.times.back());
    return last;
}

std::size_t Scene::primitive_triangles() const {
    std::size_t count = 0;
    for (const auto& mesh : meshes) count += mesh.indices.size() / 3;
    return count;
}

std::size_t Scene::instanced_triangles() const {
    std::size_t count = 0;
    for (const auto& node : nodes)
        for (const int mesh : node.meshes) count += meshes[mesh].indices.size() / 3;
    return count;
}

const Camera* Scene::find_camera(const std::string& camera) const {
    const auto same = [&](const Camera& c) { return c.name == camera; };
    const auto found = std::find_if(cameras.begin(), cameras.end(), same);
    return found == cameras.end() ? nullptr : &*found;
}

Scene load_scene(const std::string& name) {
    const std::string builtin = "builtin:";
    if (name.compare(0, builtin.size(), builtin) == 0) return make_builtin(name);
    return load_gltf(name);
}

Bounds bounds_of(const Scene& scene, double time) {
    const auto pose = pose_at(scene, time);
    constexpr float infinity = std::numeric_limits<float>::infinity();
    Bounds bounds{glm::vec3(infinity), glm::vec3(-infinity)};
    for (std::size_t n = 0; n < scene.nodes.size(); ++n)
        for (const int mesh : scene.nodes[n].meshes) {
            const PlacedMesh placed(scene, pose, static_cast<int>(n), mesh);
            for (std::size_t i = 0; i < placed.vertices(); ++i) {
                const auto p = placed.position(i);
                bounds.min = glm::min(bounds.min, p);
                bounds.max = glm::max(bounds.max, p);
            }
        }
    return bounds.min.x <= bounds.max.x ? bounds : Bounds{};
}

}  // namespace ir::scene
