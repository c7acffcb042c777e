// Russian roulette at a surface: how likely a photon goes on, and what it is expected to keep.
#include "lib/brdf.glsl"

/// A photon that meets this reflectance goes on with this probability; one power for all channels, which is
/// multiplied by reflectance / probability.  [Smal19 eq. 4.9]
float survival_probability(vec3 reflectance) {
    return clamp(max(reflectance.r, max(reflectance.g, reflectance.b)), 0.0, 1.0);
}

/// Reflectance for light from everywhere, roughly: what the roulette before the first scattering, and the map
/// of emission probabilities, go by. Positive wherever the surface reflects, as Bsdf::albedo() on the host is.
/// Only a probability comes from it, so that its error is variance and no bias.
vec3 first_reflectance(vec3 base_colour, float metallic, float ior, int model) {
    if (model == SCATTERING_LAMBERT) return base_colour;
    if (model == SCATTERING_METALNESS_BLEND) return base_colour;  // (1 - metallic) c + metallic F, F >= c
    vec3 f0 = layered_f0(ior, base_colour, metallic);
    return (1.0 - f0) * (1.0 - metallic) * base_colour + f0;
}

/// Whether photons that arrive from a light leave along its ray, to be scattered where that meets the surface again:
/// by mirrors and glass, which need more of the surface than a sample point holds.
bool is_met_again(float opaque, float metallic, float roughness, int model, bool follows_mirrors) {
    if (model == SCATTERING_LAMBERT || !follows_mirrors) return false;
    bool has_interface = model == SCATTERING_GLTF || metallic > 0.0;
    return opaque < 1.0 || (has_interface && roughness * roughness < MIRROR_ALPHA);
}
