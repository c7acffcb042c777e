// How a surface scatters that a ray met.
#include "passes/direct/device/samples.glsl"
#include "passes/raytracing/rays.glsl"
#include "passes/scene/highlights.glsl"
#include "passes/scene/hit_surface.glsl"

SeenSurface scatterer_of(HitSurface s, vec3 direction_ws) {
    SeenSurface seen;
    seen.exists = !s.is_unlit;
    seen.position_ws = s.position_ws;
    seen.wo = -direction_ws;
    seen.geometric_n = with_sign_of_zero(s.geometric_normal_ws);
    seen.scatterer = make_scatterer(with_sign_of_zero(s.shading_normal_ws), seen.geometric_n, s.base_colour, s.metallic,
                                    s.roughness, s.ior, MATERIALS);
    seen.glass = NO_GLASS;
    if (MATERIALS != SCATTERING_LAMBERT)
        seen.glass = make_glass(s.transmission * (1.0 - s.metallic), s.ior, hit_materials[s.material].thickness,
                                s.base_colour, s.is_front);
    return seen;
}

#ifdef HITS
/// Directions that the ray stands for, sr; 0: it is mirrored. Negative: what mirrors show of sources does not count.
layout(std430) buffer Spreads { float spreads[]; };

uniform bool normal_maps;

/// Which reflects light as LightRays has it. `all_lobes`: mirrors, too, are as rough as what the ray stands for.
SeenSurface surface_of_hit(Ray ray, RayHit hit, float spread, bool all_lobes) {
    SeenSurface none;
    none.exists = false;
    if (!(ray.far > 0.0) || !is_hit(hit)) return none;
    HitSurface s = hit_surface(hit.triangle, hit.u, hit.v, ray.direction_ws, normal_maps);
    float own = s.roughness;
    if (spread != 0.0 && (own * own >= MIRROR_ALPHA || (all_lobes && spread > 0.0))) {
        s.roughness = widened_roughness(own, slope_variance(hit.triangle, hit.distance, abs(spread)));
        float gain = widened_gain(own, s.roughness, dot(s.shading_normal_ws, -ray.direction_ws));
        s.base_colour *= mix(1.0, gain, s.metallic);  // of dielectrics most is diffuse
    }
    return scatterer_of(s, ray.direction_ws);
}
#endif
