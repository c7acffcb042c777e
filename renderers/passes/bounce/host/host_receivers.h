#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>

#include "renderers/graph/pass_context.h"
#include "renderers/passes/bounce/receiver.h"

namespace ir::passes::bounce {

/// What a pixel shows: Receiver of shaders/passes/bounce/receiver.glsl.
struct HostReceiver {
    glm::vec3 position, normal, geometric_normal;
    glm::vec3 stored_normal;  ///< not quite of unit length
};

/// Lobes of shaders/lib/scattering.glsl's Scatterer.
struct HostLobes {
    glm::vec3 diffuse, f0;
    float specular;
};

/// How a pixel scatters light towards the viewer.
struct HostScatterer {
    glm::vec3 colour, viewer;
    float n_dot_v, metallic, roughness, ior;
    HostLobes lobes;
};

/// As shading_normal() of receiver.glsl.
glm::vec3 shading_normal(glm::vec3 stored, glm::vec3 geometric_normal);

/// receiver.glsl on the host, one pixel at a time, for passes of the cpu queue. Keeps references.
class HostReceivers {
  public:
    HostReceivers(const graph::PassContext& context, const Receivers& receivers);
    static void declare_reads(graph::PassBuilder& pass, const Receivers& receivers);

    /// Nothing where the pixel shows no surface.
    std::optional<HostReceiver> at(std::size_t pixel) const;
    /// With light only; nothing where the surface is unlit.
    std::optional<HostScatterer> scatterer_at(std::size_t pixel, const HostReceiver& receiver) const;
    HostLobes lobes_of(glm::vec3 colour, float metallic, float ior) const;

  private:
    float ior_of(float stored_material) const;

    const scene::Scene& scene_;
    ReceiverConstants constants_;
    Transport::Materials model_;
    std::span<const glm::vec4> positions_, geometric_normals_;
    std::span<const std::uint64_t> normals_, albedos_, materials_;
};

}  // namespace ir::passes::bounce
