// What surfels store of reflected light: the part that is the same to all sides. Before it, include
// passes/scene/hit_surface.glsl and lib/brdf.glsl. MATERIALS: as Transport::Materials counts.

/// Albedo of the Lambert part, below its interface; unlit surfaces reflect nothing. [glTF2 B.3.5]
vec3 diffuse_albedo(HitSurface s) {
    if (s.is_unlit) return vec3(0);
#if MATERIALS == 2
    return s.base_colour;
#else
    return (1.0 - s.metallic) * (1.0 - s.transmission * (1.0 - s.metallic)) * s.base_colour;
#endif
}

/// What the interface lets through, both ways, towards the normal: the Lambert part of glTF depends on the
/// direction of view, by a few per cent of it as long as neither direction grazes.
vec3 below_interface(HitSurface s, vec3 to_light_ws) {
#if MATERIALS == 0
    vec3 f0 = layered_f0(s.ior, s.base_colour, s.metallic);
    vec3 h = normalize(to_light_ws + s.shading_normal_ws);
    return 1.0 - schlick_fresnel(f0, clamp(dot(s.shading_normal_ws, h), 0.0, 1.0));
#else
    return vec3(1);
#endif
}
