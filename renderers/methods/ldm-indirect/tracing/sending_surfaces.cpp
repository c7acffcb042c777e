#include "renderers/methods/ldm-indirect/tracing/sending_surfaces.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "renderers/graph/pass_context.h"
#include "renderers/methods/ldm-indirect/tracing/first_hits.h"
#include "renderers/passes/gbuffer/glass.h"
#include "renderers/passes/scattering/microfacets.h"
#include "renderers/scene/frame.h"
#include "shaders/methods/ldm-indirect/tracing/differentials.glsl.h"
#include "shaders/methods/ldm-indirect/tracing/emit.comp.h"

namespace ir::methods::ldm_indirect {
SendingSurfaces::SendingSurfaces(const graph::FrameInputs& inputs, const passes::ldm::MapsPointer& maps,
                                 const Parameters& parameters)
    : transport_(parameters.transport),
      senders_(parameters.senders),
      maps_(maps),
      surfaces_(*inputs.scene, *inputs.world, parameters.transport.normal_maps),
      narrow_(ray_tracer(parameters) ? 0.0f : narrow_gap(*maps)) {}

Primary SendingSurfaces::nothing(std::uint32_t source) {
    Primary primary{};
    primary.source = source;
    primary.fate = primary_nothing;
    primary.direction_ws = {0, 0, 1};
    primary.normal_ws = primary.shading_ws = {0, 0, -1};
    primary.cosine_sum = primary.reached = 1;
    return primary;
}

/// As emit.comp.
glm::vec3 SendingSurfaces::sent_part(const passes::Surface& s, float cosine) const {
    using Materials = Transport::Materials;
    if (s.is_unlit) return glm::vec3(0);
    if (transport_.materials == Materials::lambert) return s.base_colour;
    if (s.transmission * (1 - s.metallic) > passes::mostly_glass) return glm::vec3(0);
    const auto diffuse = (1 - s.metallic) * s.base_colour;
    if (senders_ == Senders::diffuse) return diffuse;
    const float bounded = std::max(cosine, min_sender_cosine);
    if (transport_.materials == Materials::metalness_blend)
        return diffuse + s.metallic * passes::directional_albedo(s.base_colour, s.roughness, bounded);
    const auto f0 = glm::mix(glm::vec3(usual_f0), s.base_colour, s.metallic);
    const auto interface_albedo = passes::directional_albedo(f0, s.roughness, bounded);
    return (1.0f - interface_albedo) * diffuse + interface_albedo;
}

void SendingSurfaces::arrive(Primary& primary, const passes::Surface& at) const {
    primary.position_ws = at.position_ws;
    primary.normal_ws = at.geometric_normal_ws;
    primary.shading_ws = at.shading_normal_ws;
    primary.reflectance = sent_part(at, -glm::dot(primary.direction_ws, primary.shading_ws));
    primary.cosine_sum = 1e-20f;
    for (const auto& frame : maps_->frames)
        primary.cosine_sum += std::abs(glm::dot(primary.shading_ws, glm::vec3(frame.direction)));
    primary.fate =
        glm::dot(primary.direction_ws, primary.normal_ws) > -min_facing ? primary_degenerate : primary_splits;
}

void SendingSurfaces::spread(Primary& primary, const Spacing& spacing, float t) {
    const auto across = scene::frame_around(primary.direction_ws);
    const float radius = std::hypot(spacing.place, t * spacing.direction);
    const auto on_surface = [&](const glm::vec3& axis) {
        return radius * (axis - glm::dot(axis, primary.normal_ws) /
                                    glm::dot(primary.direction_ws, primary.normal_ws) * primary.direction_ws);
    };
    primary.axis_u = on_surface(across[0]);
    primary.axis_v = on_surface(across[1]);
    primary.turn_u = spacing.direction * across[0];
    primary.turn_v = spacing.direction * across[1];
}

graph::ObjectRef sending_surfaces(graph::GraphBuilder& builder, const passes::ldm::MapsPointer& maps,
                                  const Parameters& parameters) {
    const auto surfaces = builder.object({.text = {.key = "indirect.surfaces",
                                                   .label = "Sending surfaces",
                                                   .doc = "What rays on the host meet: places, "
                                                          "normals and reflectances."}});
    builder.pass("sending surfaces", graph::Queue::cpu)
        .writes(surfaces)
        .execute([=](graph::PassContext& context) {
            const auto made = std::make_shared<SendingSurfaces>(context.inputs(), maps, parameters);
            context.store(surfaces, made, made->lookup().bytes());
        });
    return surfaces;
}

}  // namespace ir::methods::ldm_indirect
