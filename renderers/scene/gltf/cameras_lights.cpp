#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <set>

#include "renderers/core/error.h"
#include "renderers/core/limits.h"
#include "renderers/scene/gltf/scene_parts.h"
#include "renderers/scene/placement.h"

namespace ir::scene::gltf {
namespace {

std::string unique_name(std::set<std::string>& taken, const std::string& wanted) {
    auto name = wanted;
    for (int i = 2; !taken.insert(name).second; ++i) name = wanted + " " + std::to_string(i);
    return name;
}

Camera camera_of(Document& document, const tinygltf::Camera& source) {
    Camera camera;
    camera.orthographic = source.type == "orthographic";
    if (camera.orthographic) {
        camera.height = static_cast<float>(2 * std::abs(source.orthographic.ymag));
        return camera;
    }
    const double min = glm::radians(min_fov_degrees), max = glm::radians(max_fov_degrees);
    camera.fov_y = static_cast<float>(std::clamp(source.perspective.yfov, min, max));
    if (source.perspective.yfov < min || source.perspective.yfov > max)
        document.warnings.add("a camera's yfov was clamped to what can be drawn (above 0, below π rad)");
    return camera;
}

/// Candela and lux are read one to one as W/sr and W/m².
Light light_of(Document& document, const tinygltf::Light& source, LightType type) {
    Light light;
    light.type = type;
    for (std::size_t i = 0; i < source.color.size() && i < 3; ++i)
        light.colour[static_cast<int>(i)] = std::max(0.0f, static_cast<float>(source.color[i]));
    light.intensity = std::max(0.0f, static_cast<float>(source.intensity));
    light.direction = {0, 0, -1};
    light.range = std::max(0.0f, static_cast<float>(source.range));
    if (type != LightType::spot) return light;
    const float widest = glm::half_pi<float>();
    light.outer_angle = std::clamp(static_cast<float>(source.spot.outerConeAngle), 1e-4f, widest);
    light.inner_angle = std::clamp(static_cast<float>(source.spot.innerConeAngle), 0.0f, light.outer_angle);
    if (source.spot.innerConeAngle > source.spot.outerConeAngle ||
        source.spot.outerConeAngle > widest * 1.0001)
        document.warnings.add("a spot light's cone angles were clamped to 0 <= inner <= outer <= pi/2");
    return light;
}

}  // namespace

void load_cameras(Document& document, Scene& scene, const std::vector<int>& nodes) {
    std::set<std::string> names;
    const auto matrices = world_matrices(scene, 0);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const auto& node = document.model.nodes[i];
        if (nodes[i] < 0 || node.camera < 0) continue;
        const auto& source = document.model.cameras[node.camera];
        auto camera = camera_of(document, source);
        const auto given = !source.name.empty() ? source.name : node.name;
        camera.name =
            unique_name(names, given.empty() ? "camera " + std::to_string(names.size() + 1) : given);
        camera.node = nodes[i];
        scene.cameras.push_back(placed(camera, matrices[nodes[i]]));
    }
}

void load_lights(Document& document, Scene& scene, const std::vector<int>& nodes) {
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const auto& node = document.model.nodes[i];
        const auto extension = node.extensions.find("KHR_lights_punctual");
        if (nodes[i] < 0 || extension == node.extensions.end()) continue;
        const auto& source = document.model.lights[extension->second.Get("light").GetNumberAsInt()];
        const auto type = source.type == "point"         ? LightType::point
                          : source.type == "spot"        ? LightType::spot
                          : source.type == "directional" ? LightType::directional
                                                         : LightType::rectangle;
        if (type == LightType::rectangle) {
            document.warnings.add("a light of unknown type " + one_line(source.type) + " was ignored");
            continue;
        }
        auto light = light_of(document, source, type);
        light.name = !source.name.empty() ? source.name : node.name;
        light.node = nodes[i];
        scene.lights.push_back(light);
    }
}

}  // namespace ir::scene::gltf
