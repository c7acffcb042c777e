#include <algorithm>
#include <cmath>
#include <limits>

#include "app/engine/live_session.h"
#include "renderers/passes/raytracing/bvh.h"
#include "renderers/passes/surface/triangle_plane.h"
#include "renderers/scene/placed_mesh.h"

namespace ir::engine {
namespace {

/// Above the nodes of each part of several stands one more.
int part_of(const scene::Scene& scene, int node, std::size_t parts) {
    if (parts == 1) return 0;
    const auto& nodes = scene.nodes;
    int top = node;
    while (nodes[std::size_t(top)].parent >= 0) top = nodes[std::size_t(top)].parent;
    return int(std::count_if(nodes.begin(), nodes.begin() + top,
                             [](const scene::Node& each) { return each.parent < 0; }));
}

}  // namespace

/// A scene at one moment, for rays.
struct LiveSession::SurfaceTree {
    std::string scene;  ///< content hash
    double time;        ///< 0 where nothing moves
    passes::Bvh bvh;
};

const passes::Bvh& LiveSession::surface_tree(const Execution& execution, const scene::World& world) {
    const auto& scene = execution.scene();
    // The world's own: the execution's may be that of a frame that has not run yet.
    const double time = !scene.is_animated()       ? 0
                        : execution.inputs().scene ? execution.inputs().time
                                                   : execution.time();
    if (!surface_tree_ || surface_tree_->scene != scene.content_hash || surface_tree_->time != time) {
        surface_tree_.reset();  // makes room
        surface_tree_.reset(
            new SurfaceTree{scene.content_hash, time, {scene, world, machine_.options().threads}});
        ++surface_trees_;
    }
    return surface_tree_->bvh;
}

void LiveSession::drop_unused_tree() {
    const auto uses = [&](const auto& each) {
        return each.second.execution && each.second.execution->scene().content_hash == surface_tree_->scene;
    };
    if (surface_tree_ && std::ranges::none_of(entries_, uses)) surface_tree_.reset();
}

SurfaceResult LiveSession::find_surface(const SurfaceRequest& request) {
    SurfaceResult result{request.tag, {}, {}, request.asker};
    const auto found = entries_.find(request.tag);
    const double length = glm::length(request.direction);
    if (found == entries_.end() || !found->second.execution || !(length > 0)) {
        result.error = "nothing is rendered yet";
        return result;
    }
    const auto& execution = *found->second.execution;
    const bool has_world = execution.inputs().scene != nullptr;
    const auto made =
        has_world ? scene::World() : scene::flatten(execution.scene(), execution.time(), execution.time());
    const auto& world = has_world ? execution.world() : made;
    const auto& bvh = surface_tree(execution, world);

    constexpr float infinite = std::numeric_limits<float>::infinity();
    const auto direction = request.direction / length;
    const auto hit = bvh.closest_hit(request.origin, direction, 0, infinite);
    if (!hit.is_hit()) return result;
    const auto corner = [&](std::uint32_t c) { return world.positions[world.indices[3 * hit.triangle + c]]; };
    const auto by_winding = passes::triangle_normal(corner(0), corner(1), corner(2));
    const auto normal = glm::dot(glm::dvec3(by_winding), direction) > 0 ? -by_winding : by_winding;
    const auto position = request.origin + double(hit.distance) * direction;
    constexpr float own_surface = 1e-4f;  // part of the distance, in which single precision may lie
    const float free_way = bvh.closest(position, normal, own_surface * hit.distance, infinite);
    const auto& scene = execution.scene();
    const int node = scene::node_of_triangle(scene, hit.triangle);
    result.point = {position,
                    glm::normalize(glm::dvec3(normal)),
                    free_way,
                    part_of(scene, node, execution.experiment().composition().size()),
                    node,
                    scene.nodes[std::size_t(node)].name,
                    scene.materials[world.triangle_materials[hit.triangle]].name};
    return result;
}

}  // namespace ir::engine
