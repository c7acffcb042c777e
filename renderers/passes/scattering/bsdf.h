#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "renderers/core/transport.h"
#include "renderers/passes/scattering/opaque_lobes.h"
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

/// What a Bsdf does between two directions.
struct BsdfValue {
    glm::vec3 value{0};  ///< f |cosθi|, 1/sr
    float pdf = 0;       ///< 1/sr
};

/// How a surface reflects and transmits: the model that Transport::materials names. Directions are unit
/// vectors that point away from the surface; cosines are taken with the shading normal; light from
/// directions that are above one of the two normals and below the other does not count. A viewer below the
/// shading normal sees what one at n·v = 1e-4 would.
///
/// - gltf: Lambert below a GGX interface, as gltf_brdf() of shaders/lib/brdf.glsl.  [glTF2 B.3.5] As
/// specified
///   it does not conserve energy: a white dielectric seen at cosθ = 0.05 reflects 1.32 times what arrives at
///   roughness 0.3 and 1.08 times at 0.6 (1.12 and 1.02 at cosθ = 0.3).
/// - metalness-blend: f = k f_Lambert + (1 - k) f_CookTorrance, k = 1 - metallic, with GGX's D, Smith's G as
///   the product of two maskings, Schlick's F from the base colour, α = roughness²; a dielectric has no
///   highlight at all.  [Smal19 eqs. 3.4-3.8; 3.7 with tan² of the angle to the macroscopic normal]
/// - lambert: base colour / π and opaque, whatever metallic, roughness and transmission say.
///
/// Below α = 1e-3 the interface is a mirror, a specular event; rasterisation keeps a highlight of α = 1e-3
/// there instead, so lights without extent show in its picture and not in this one.
///
/// Transmission is that of a dielectric. The fraction transmission (1 - metallic) of the surface is glass,
/// the rest the opaque model above. Smooth glass (below that α) is a specular event; rough glass scatters at
/// GGX microfacets, to both sides, and a rough sheet as if its reflection went on behind it. With thickness 0
/// light passes straight through a sheet, all reflections between its two sides counted; otherwise it is
/// refracted, and leaves total internal reflection. Radiance is scaled by 1/η² where a path from the camera
/// is refracted into a medium of relative index η, and back where it leaves; power is not. Base colour tints
/// what passes, once for each crossing. [glTF2 KHR_materials_transmission, KHR_materials_volume]
class Bsdf {
  public:
    /// `material` is the scene's entry for surface.material; its index of refraction and volume count.
    Bsdf(const Surface& surface, const scene::Material& material, Transport::Materials model);

    /// f(wo, wi) |cosθi|, in 1/sr; specular parts left out.
    glm::vec3 evaluate(glm::vec3 wo, glm::vec3 wi) const { return evaluate_with_pdf(wo, wi).value; }
    /// Density per solid angle with which sample() chooses wi, given wo; specular parts left out.
    float pdf(glm::vec3 wo, glm::vec3 wi) const { return evaluate_with_pdf(wo, wi).pdf; }
    /// Both at the price of one.
    BsdfValue evaluate_with_pdf(glm::vec3 wo, glm::vec3 wi) const;
    /// `lobe` and `u` uniform in [0, 1). Nothing when the event carries no light.
    std::optional<BsdfSample> sample(glm::vec3 wo, float lobe, glm::vec2 u) const;
    /// sample() in two steps, for those who look first what is where it goes: weight and pdf are only those
    /// of specular events until weighted() gives the others theirs.
    std::optional<BsdfSample> choose(glm::vec3 wo, float lobe, glm::vec2 u) const;
    std::optional<BsdfSample> weighted(glm::vec3 wo, const BsdfSample& chosen) const;

    /// For many directions at a time: all of it as `wo` sees it, where there is neither glass nor mirror.
    std::optional<OpaqueLobes> opaque(glm::vec3 wo) const;

    /// The same for paths from light sources, where power takes the place of radiance: nothing is divided by
    /// η², and shading normals are corrected for.  [Veach97 §5.3, Walter07]
    ///
    /// Of power that arrives from `wi` the radiance that leaves to `wo`, times the geometric cosine there and
    /// the lit area, 1/sr.
    glm::vec3 evaluate_importance(glm::vec3 wi, glm::vec3 wo) const;
    /// Where power that arrives from `wi` goes on to; `weight` is the part that does, over the probability.
    std::optional<BsdfSample> sample_importance(glm::vec3 wi, float lobe, glm::vec2 u) const;

    /// For the weights of paths that are traced from both ends; directions on any side of the surface.
    ///
    /// Density per solid angle with which the surface that is met along `from` sends a path on to `to`;
    /// specular parts left out.
    float pdf_from_any_side(glm::vec3 from, glm::vec3 to) const;
    /// dω(from) / dω(to) of a specular event: 1 of mirrors, by Snell's law of glass. 0 where `to` does not
    /// lead back to `from`, because one of them is below the shading normal's horizon.
    float specular_spread(glm::vec3 from, glm::vec3 to) const;

    /// Of light from behind, towards `wo`, the fraction that a sheet of clear glass lets pass straight on, as
    /// often as sample() chooses it; 0 of anything else.
    glm::vec3 passed_straight(glm::vec3 wo) const;

    /// Rough glass: evaluate() is not 0 for directions on the other side.
    bool scatters_through() const;
    /// Whether evaluate() is not 0 everywhere, so that light sources are worth sampling.
    bool has_smooth_part() const;
    /// Reflectance for light from everywhere, roughly: for G-buffer-like pictures and roulette.
    glm::vec3 albedo() const;

    /// Fraction that survives `distance` metres inside the material (1 where it has no volume).
    /// [glTF2 KHR_materials_volume]
    static glm::vec3 transmittance(const scene::Material& material, float distance);

  private:
    friend struct BsdfLobes;
    Bsdf from_behind() const;
    glm::vec3 n_{0}, geometric_n_{0};
    glm::vec3 diffuse_{0};    ///< albedo of the Lambert part, without the interface above it
    glm::vec3 f0_{0};         ///< reflectance of the microfacets at normal incidence
    float specular_ = 0;      ///< weight of the microfacets
    float alpha_ = 1;         ///< roughness²
    float transmission_ = 0;  ///< fraction that is glass
    float eta_ = 1.5f;        ///< index behind the surface over that in front of it
    glm::vec3 tint_{1};       ///< of what passes through the glass
    bool is_thin_ = true, is_dark_ = false;
    bool is_layered_ = false;  ///< the Lambert part lies below the microfacets, not beside them
};

}  // namespace ir::passes
