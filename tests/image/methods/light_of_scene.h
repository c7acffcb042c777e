#pragma once

#include <string>
#include <utility>
#include <vector>

#include "tests/image/methods/every_method.h"

namespace ir::test {

/// A node of its own with a quadrilateral, counter-clockwise from its front.
inline void add_quad(scene::Scene& scene, int material, const std::vector<glm::vec3>& corners,
                     glm::vec3 shading_normal) {
    scene::Mesh mesh;
    mesh.material = material;
    mesh.positions = corners;
    mesh.normals.assign(4, shading_normal);
    mesh.uv0.assign(4, {0, 0});
    mesh.indices = {0, 1, 2, 0, 2, 3};
    scene::Node node;
    node.meshes = {static_cast<int>(scene.meshes.size())};
    scene.meshes.push_back(std::move(mesh));
    scene.nodes.push_back(node);
}

/// What a method makes of light that is scattered twice, seen by the scene's first camera: one frame.
inline Image once_bounced_light(const std::string& method, const scene::Scene& scene, Settings settings,
                                int width, int height) {
    settings["paths"] = std::string("indirect");
    settings["max_bounces"] = std::int64_t{1};
    auto& machine = test::machine();
    const auto world = scene::flatten(scene, 0, 0);
    graph::Graph graph(machine.device(), &machine.context(), &machine.programs());
    graph::FrameInputs inputs;
    inputs.scene = &scene;
    inputs.world = &world;
    inputs.view = inputs.previous_view = scene::make_view(scene.cameras[0], width, height, world.bounds);
    inputs.seed = 3;
    const auto& all = methods::all_methods();
    const auto found =
        std::ranges::find_if(all, [&](const auto* each) { return each->description.id == method; });
    graph.run(**found, completed((*found)->description.parameters, settings), inputs, {});
    return graph.read_image("radiance").value();
}

}  // namespace ir::test
