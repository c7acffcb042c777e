#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "renderers/core/transport.h"
#include "renderers/passes/surface/surface.h"
#include "renderers/scene/scene.h"

namespace ir::passes {

/// A direction chosen by a Bsdf. All factors are included: the light that leaves towards the viewer is
/// `weight` times the radiance that arrives from `wi`.
struct BsdfSample {
    glm::vec3 wi{0};  ///< unit, away from the surface
    glm::vec3 weight{
        0};  ///< f |cosθ| / pdf; for a mirror or glass event the colour it leaves, over its probability
    float pdf = 0;                ///< 1/sr, of all lobes together; 0 for a specular event
    bool is_specular = false;     ///< mirror or glass: one direction only, does not count as a scattering
    bool is_transmitted = false;  ///< to the other side of the geometric surface
};

/// How a surface reflects and transmits: the model that Transport::materials names. Directions are unit
/// vectors that point away from the surface; cosines are taken with the shading normal; directions that are
/// above one of the two normals and below the other carry nothing.
class Bsdf {
  public:
    /// `material` is the scene's entry for surface.material; its index of refraction and volume count.
    Bsdf(const Surface& surface, const scene::Material& material, Transport::Materials model);

    /// f(wo, wi) |cosθi|, in 1/sr; specular parts left out.
    glm::vec3 evaluate(glm::vec3 wo, glm::vec3 wi) const;
    /// Density per solid angle with which sample() chooses wi, given wo; specular parts left out.
    float pdf(glm::vec3 wo, glm::vec3 wi) const;
    /// `lobe` and `u` uniform in [0, 1). Nothing when the event carries no light.
    std::optional<BsdfSample> sample(glm::vec3 wo, float lobe, glm::vec2 u) const;

    /// Whether evaluate() is not 0 everywhere, so that light sources are worth sampling.
    bool has_smooth_part() const;
    /// Reflectance for light from everywhere, roughly: for G-buffer-like pictures and roulette.
    glm::vec3 albedo() const;

    /// Fraction that survives `distance` metres inside the material (1 where it has no volume).
    /// [glTF2 KHR_materials_volume]
    static glm::vec3 transmittance(const scene::Material& material, float distance);

  private:
    friend struct BsdfLobes;
    glm::vec3 n_{0}, geometric_n_{0};
    glm::vec3 base_colour_{0};
    float metallic_ = 0, alpha_ = 1, ior_ = 1.5f, transmission_ = 0;
    bool is_front_ = true, is_thin_ = true, is_dark_ = false;
    Transport::Materials model_ = Transport::Materials::gltf;
};

}  // namespace ir::passes
