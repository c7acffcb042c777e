#include "renderers/methods/reference/passes.h"

#include <algorithm>

#include "renderers/methods/reference/light_tracer.h"
#include "renderers/passes/lights/punctual.h"

namespace ir::methods::reference {
namespace {

bool has_environment(const scene::Environment& environment) {
    return environment.map || environment.constant != glm::vec3(0);
}

bool shines(const graph::FrameInputs& inputs, const Transport& transport) {
    const auto& scene = *inputs.scene;
    const auto& lights = inputs.world->lights;
    if (transport.environment_light && has_environment(scene.environment)) return true;
    if (transport.emitters == Transport::Emitters::none)
        return std::any_of(lights.begin(), lights.end(), passes::is_punctual);
    return !lights.empty() || std::any_of(scene.materials.begin(), scene.materials.end(),
                                          [](const auto& m) { return m.emission != glm::vec3(0); });
}

/// Materials among these that the world's triangles have.
std::ptrdiff_t materials_in(const scene::World& world, const std::vector<bool>& chosen) {
    std::vector<bool> used(chosen.size());
    for (const auto& range : world.ranges)
        if (range.triangle_count > 0) used[static_cast<std::size_t>(range.material)] = true;
    std::ptrdiff_t count = 0;
    for (std::size_t i = 0; i < used.size(); ++i) count += used[i] && chosen[i];
    return count;
}

void note_darkness(graph::GraphBuilder& builder, const Transport& transport) {
    if (shines(builder.inputs(), transport)) return;
    const bool without_environment =
                   !transport.environment_light && has_environment(builder.inputs().scene->environment),
               without_emitters = transport.emitters == Transport::Emitters::none;
    builder.note(std::string("nothing in the scene emits light, so the picture is black: ") +
                 (without_environment ? "switch environment_light on, or add a light"
                  : without_emitters  ? "emitters leaves them out; set it to all, or add a point light"
                                      : "add a light or an environment, or choose the paths ao"));
}

void note_caustics(graph::GraphBuilder& builder, const PathRules& rules,
                   const std::vector<bool>& specular_materials) {
    const auto& world = *builder.inputs().world;
    if (!LightTracer::has_paths(world, rules, specular_materials)) return;
    builder.note(
        "light from point, spot and directional lights over mirrors or through glass (" +
        std::to_string(materials_in(world, specular_materials)) +
        " materials are such, at least in places) is traced from the lights; where the camera sees it "
        "in a mirror or through glass it is missing");
}

}  // namespace

void note_limits(graph::GraphBuilder& builder, const Parameters& parameters,
                 const std::vector<bool>& specular) {
    const auto& transport = parameters.transport;
    if (transport.paths == Transport::Paths::ao) return;
    note_darkness(builder, transport);
    if (transport.paths != Transport::Paths::direct && transport.min_bounces > transport.max_bounces) {
        builder.note("min_bounces is " + std::to_string(transport.min_bounces) + ", max_bounces " +
                     std::to_string(transport.max_bounces) + ": no indirect light counts; raise max_bounces");
    }
    note_caustics(builder, PathRules(transport), specular);
}

}  // namespace ir::methods::reference
