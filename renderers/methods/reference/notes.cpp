#include "renderers/methods/reference/passes.h"

#include <algorithm>

#include "renderers/methods/reference/path_rules.h"
#include "renderers/passes/lights/punctual.h"
#include "renderers/passes/lights/shining.h"

namespace ir::methods::reference {
namespace {

/// Materials among these that the world's triangles have.
std::ptrdiff_t materials_in(const scene::World& world, const std::vector<bool>& chosen) {
    std::vector<bool> used(chosen.size());
    for (const auto& range : world.ranges)
        if (range.triangle_count > 0) used[static_cast<std::size_t>(range.material)] = true;
    std::ptrdiff_t count = 0;
    for (std::size_t i = 0; i < used.size(); ++i) count += used[i] && chosen[i];
    return count;
}

void note_caustics(graph::GraphBuilder& builder, const PathRules& rules, const std::vector<bool>& specular) {
    const auto& world = *builder.inputs().world;
    const auto materials = materials_in(world, specular);
    if (materials == 0 || rules.max_scatterings() == 0 ||
        std::none_of(world.lights.begin(), world.lights.end(), passes::is_punctual))
        return;
    builder.note("light from point, spot and directional lights over mirrors or through glass (" +
                 std::to_string(materials) +
                 " materials are such, at least in places) is traced from the lights; where the camera sees "
                 "it in a mirror or through glass it is missing");
}

}  // namespace

void note_limits(graph::GraphBuilder& builder, const Parameters& parameters,
                 const SharpMaterials& materials) {
    const auto& transport = parameters.transport;
    if (transport.paths == Transport::Paths::ao) return;
    passes::note_darkness(builder, transport);
    if (transport.paths != Transport::Paths::direct && transport.min_bounces > transport.max_bounces) {
        builder.note("min_bounces is " + std::to_string(transport.min_bounces) + ", max_bounces " +
                     std::to_string(transport.max_bounces) + ": no indirect light counts; raise max_bounces");
    }
    note_caustics(builder, PathRules(transport), materials.specular);
}

}  // namespace ir::methods::reference
