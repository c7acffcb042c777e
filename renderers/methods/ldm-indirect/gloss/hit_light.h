#pragma once

#include <optional>
#include <vector>

#include "renderers/passes/direct/extended_light.h"
#include "renderers/passes/direct/light_estimate.h"
#include "renderers/passes/direct/panes.h"
#include "renderers/passes/scattering/bsdf.h"

namespace ir::methods::ldm_indirect {

/// Direct light that surfaces reflect which rays meet: of lights without extent with a ray for each, of the
/// others one sample. Keeps references. Thread-safe.
class HitLight {
  public:
    /// `sources`: null where nothing else shines.
    HitLight(const graph::FrameInputs& inputs, const passes::Bvh& bvh, const passes::SurfaceLookup& surfaces,
             const passes::ExtendedEmitters* sources, const passes::ExtendedLightOptions& options);

    /// W/(m² sr) towards unit `wo`; `bsdf` is the surface's for light of sources without extent.
    glm::vec3 reflected(const passes::Surface& surface, const passes::Bsdf& bsdf, glm::vec3 wo,
                        const passes::PathSampler& sampler) const;

  private:
    glm::vec3 of_punctual(const passes::Surface& surface, const passes::Bsdf& bsdf, glm::vec3 wo) const;
    /// Fraction of the light from there that arrives.
    glm::vec3 arriving(glm::vec3 origin, glm::vec3 direction, float far) const;

    const passes::Bvh& bvh_;
    passes::Panes panes_;
    std::vector<scene::Light> punctual_;
    std::optional<passes::LightEstimate> extended_;
};

}  // namespace ir::methods::ldm_indirect
