#include "renderers/passes/lights/shining.h"

#include <algorithm>

#include "renderers/passes/lights/punctual.h"

namespace ir::passes {
namespace {

bool shines(const graph::FrameInputs& inputs, const Transport& transport) {
    const auto sources = shining_sources(inputs, transport);
    return sources.environment || sources.emissive_meshes || !sources.lights.empty();
}

}  // namespace

EmissionOptions shining_sources(const graph::FrameInputs& inputs, const Transport& transport) {
    const auto& scene = *inputs.scene;
    const auto& lights = inputs.world->lights;
    const bool has_emitters = transport.emitters != Transport::Emitters::none;
    EmissionOptions sources;
    for (std::size_t i = 0; i < lights.size(); ++i)
        if (has_emitters || is_punctual(lights[i])) sources.lights.push_back(static_cast<int>(i));
    sources.environment =
        transport.environment_light && (scene.environment.map || scene.environment.constant != glm::vec3(0));
    sources.emissive_meshes =
        has_emitters && std::any_of(scene.materials.begin(), scene.materials.end(),
                                    [](const auto& m) { return m.emission != glm::vec3(0); });
    return sources;
}

void note_darkness(graph::GraphBuilder& builder, const Transport& transport) {
    if (shines(builder.inputs(), transport)) return;
    auto with_environment = transport;
    with_environment.environment_light = true;
    const bool without_environment = shines(builder.inputs(), with_environment),
               without_emitters = transport.emitters == Transport::Emitters::none;
    builder.note(std::string("nothing in the scene emits light, so the picture is black: ") +
                 (without_environment ? "switch environment_light on, or add a light"
                  : without_emitters  ? "emitters leaves them out; set it to all, or add a point light"
                                      : "add a light or an environment"));
}

}  // namespace ir::passes
