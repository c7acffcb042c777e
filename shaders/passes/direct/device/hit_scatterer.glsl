// How a surface scatters that a ray met.
#include "passes/direct/device/samples.glsl"
#include "passes/raytracing/rays.glsl"
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
uniform bool normal_maps;

SeenSurface surface_of_hit(Ray ray, RayHit hit) {
    SeenSurface none;
    none.exists = false;
    if (!(ray.far > 0.0) || !is_hit(hit)) return none;
    return scatterer_of(hit_surface(hit.triangle, hit.u, hit.v, ray.direction_ws, normal_maps), ray.direction_ws);
}
#endif
