#include "app/engine/live_session.h"
#include "renderers/scene/light_sources.h"

namespace ir::engine {

SceneSummary summarise(const scene::Scene& scene) {
    SceneSummary summary;
    summary.name = scene.name;
    summary.content_hash = scene.content_hash;
    summary.triangles = scene.instanced_triangles();
    summary.textures = scene.textures.size();
    for (const auto& camera : scene.cameras) summary.cameras.push_back(camera.name);
    for (const auto& light : scene.lights) summary.lights.push_back(light.name);
    for (const auto& material : scene.materials) summary.materials.push_back(material.name);
    for (const auto& warning : scene.warnings) summary.warnings.push_back(warning.text);
    summary.sources = scene::light_sources(scene, scene.lights, scene.environment);
    for (const auto& node : scene.nodes) {
        SceneSummary::NodeRow row{node.name, node.parent, 0};
        for (const int mesh : node.meshes) row.triangles += scene.meshes[mesh].indices.size() / 3;
        summary.nodes.push_back(std::move(row));
    }
    const auto world = scene::flatten(scene, 0, 0);
    summary.bounds = world.bounds;
    summary.camera_values = world.cameras;
    return summary;
}

}  // namespace ir::engine
