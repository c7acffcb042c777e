#pragma once

#include "renderers/graph/frame_inputs.h"
#include "renderers/methods/ldm-indirect/tracing/emission.h"
#include "renderers/passes/ldm/builder.h"
#include "renderers/passes/raytracing/bvh.h"
#include "renderers/passes/surface/surface.h"

namespace ir::methods::ldm_indirect {

/// Half-axes of what lies between a photon and its neighbours.
struct Spacing {
    float place;      ///< m
    float direction;  ///< as a length on the unit sphere
};

/// The surfaces at which rays on the host end, and what they make of a photon: what emit.comp does with what
/// lights see. Thread-safe.
class SendingSurfaces {
  public:
    SendingSurfaces(const graph::FrameInputs& inputs, const passes::ldm::MapsPointer& maps,
                    const Parameters& parameters);

    /// A photon that meets nothing.
    static Primary nothing(std::uint32_t source);
    /// Sets what the surface says; the photon's direction is known.
    void arrive(Primary& primary, const passes::Surface& at) const;
    /// Sets the differential. Places and directions spread independently over a way of `t`, so their second
    /// moments add: across the ray both are circles, and so is their sum.
    static void spread(Primary& primary, const Spacing& spacing, float t);

    const passes::SurfaceLookup& lookup() const { return surfaces_; }
    /// m: what finds where photons land does not see what lies nearer.
    float narrow() const { return narrow_; }

  private:
    glm::vec3 sent_part(const passes::Surface& s, float cosine) const;

    Transport transport_;
    Senders senders_;
    passes::ldm::MapsPointer maps_;
    passes::SurfaceLookup surfaces_;
    float narrow_ = 0;
};

/// "indirect.surfaces", made by the pass "sending surfaces".
graph::ObjectRef sending_surfaces(graph::GraphBuilder& builder, const passes::ldm::MapsPointer& maps,
                                  const Parameters& parameters);

}  // namespace ir::methods::ldm_indirect
