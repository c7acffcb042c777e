#include "renderers/scene/light_sources.h"

#include <array>

namespace ir::scene {
namespace {

constexpr std::array type_names{"point light", "spot light", "directional light", "rectangle light",
                                "disk light"};

std::string named(const std::string& what, const std::string& name, std::size_t index) {
    return what + (name.empty() ? " " + std::to_string(index + 1) : " '" + name + "'");
}

LightSource source_of(const Light& light, std::size_t index) {
    return {is_flat(light) ? LightKind::lamp : LightKind::punctual,
            named(type_names[static_cast<std::size_t>(light.type)], light.name, index)};
}

}  // namespace

void for_each_light_source(const Scene& scene, const std::vector<Light>& lights,
                           const Environment& environment,
                           const std::function<void(const LightSource&, std::size_t)>& visit) {
    for (std::size_t i = 0; i < lights.size(); ++i)
        if (lights[i].intensity * lights[i].colour != glm::vec3(0)) visit(source_of(lights[i], i), i);
    std::vector<bool> is_used(scene.materials.size());
    for (const auto& mesh : scene.meshes) is_used[static_cast<std::size_t>(mesh.material)] = true;
    for (std::size_t i = 0; i < scene.materials.size(); ++i)
        if (is_used[i] && scene.materials[i].emission != glm::vec3(0))
            visit({LightKind::surface, named("emissive material", scene.materials[i].name, i)}, i);
    if (environment.map || environment.constant != glm::vec3(0))
        visit({LightKind::environment, "the environment"}, 0);
}

std::vector<LightSource> light_sources(const Scene& scene, const std::vector<Light>& lights,
                                       const Environment& environment) {
    std::vector<LightSource> sources;
    for_each_light_source(scene, lights, environment,
                          [&](const LightSource& source, std::size_t) { sources.push_back(source); });
    return sources;
}

}  // namespace ir::scene
