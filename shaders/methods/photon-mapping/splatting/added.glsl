// What a photon adds to a texel that its kernel covers, for sums and for what explains them.
#include "methods/photon-mapping/splatting/photon_kernel.glsl"
#include "methods/photon-mapping/splatting/inside.glsl"

/// Least roughness² of an interface for photons, which are few and would be dots in narrower lobes. In a picture that
/// converges it shrinks like the radii.
// C++: ir::methods::photon_mapping::least_photon_alpha
const float LEAST_PHOTON_ALPHA = 0.2;

struct Added {
    vec3 irradiance;  // W/m². REFLECTS: on the surface as it is shaded, below its interface
    vec3 direction;   // to the light, weighted by the sum of its channels. REFLECTS: what the interface reflects, RGB,
                      // W/(m² sr), over highlight_scale()
};

#ifdef REFLECTS

/// The whole BRDF. The irradiance is still to be multiplied by that of the Lambert part.  [Smal19 §7.4]
Added added_by(Kernel k, vec3 to_light, SeenSurface seen) {
    Receiver r = seen.receiver;
    vec3 irradiance = k.irradiance;
    if (directional) irradiance *= directional_factor(to_light, r.n, seen.normal);
    Added added = Added(irradiance, vec3(0));
#if MATERIALS == 0
    added.irradiance *= below_interface(r, to_light);
#endif
    float alpha = max(r.roughness * r.roughness, max(LEAST_PHOTON_ALPHA * shrinking, MIRROR_ALPHA));
    if (dot(r.n, to_light) > 0.0)
        added.direction = interface_brdf(r, to_light, alpha) / highlight_scale(r) * irradiance;
    return added;
}

#else

Added added_by(Kernel k, vec3 to_light, SeenSurface seen) {
    return Added(k.irradiance, dot(k.irradiance, vec3(1)) * to_light);
}

#endif
