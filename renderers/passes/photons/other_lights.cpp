#include "renderers/passes/photons/other_lights.h"

#include "renderers/passes/scene/light_data.h"

namespace ir::passes {
namespace {

std::string counted(int count, const std::string& what) {
    return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

}  // namespace

void OtherLights::count(const scene::Scene& scene, const scene::World& world) {
    for (const auto& light : world.lights) areas += shadow_layers(light) == 0;
    emissive_triangles = static_cast<int>(scene::emissive_triangles(scene, world));
    has_environment = scene.environment.map != nullptr || scene.environment.constant != glm::vec3(0);
}

std::vector<std::string> OtherLights::notes(bool has_photons, const std::string& room) const {
    std::string missing;
    const auto add = [&](const std::string& part) { missing += (missing.empty() ? "" : ", ") + part; };
    if (areas > 0) add(counted(areas, "rectangle or disk light"));
    if (emissive_triangles > 0) add(counted(emissive_triangles, "emissive triangle"));
    if (has_environment) add("the environment");
    std::vector<std::string> result;
    if (!has_photons) result.push_back("no point, spot or directional light: there are no photons");
    if (!missing.empty())
        result.push_back("photons come from point, spot and directional lights only; none from " + missing);
    if (beyond > 0)
        result.push_back("photons come from the first " + room + "; " + counted(beyond, "light") +
                         " beyond emit none");
    return result;
}

}  // namespace ir::passes
