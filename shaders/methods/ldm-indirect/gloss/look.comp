// Where the interface of each pixel looks.
layout(local_size_x = 64) in;

#include "methods/ldm-indirect/gloss/path.glsl"
#include "passes/direct/device/seen_surface.glsl"

layout(std430) writeonly buffer Rays { Ray rays[]; };
layout(std430) writeonly buffer Paths { Path paths[]; };
layout(std430) writeonly buffer Spreads { float spreads[]; };

uniform bool along_mirror;  // whatever the lobe

/// Leaves the interface alone, which no Lambert surface has: a metal of its reflectance. Returns which part of the
/// surface that is. As keep_interface() on the host.
float keep_interface(inout Scatterer s, inout Glass glass) {
    float part = (1.0 - glass.part) * s.specular;
    s.diffuse = vec3(0);
    s.specular = 1.0;
    glass = NO_GLASS;
    return part;
}

/// Of the interface alone.
Scattered mirrored_by(Scatterer s, vec3 wo) {
    float cosine = dot(s.n, wo);
    return Scattered(normalize(2.0 * cosine * s.n - wo),
                     directional_albedo(s.f0, sqrt(s.alpha), clamp(cosine, 0.0, 1.0)), false, false);
}

Ray look(SeenSurface surface, ivec2 pixel, out Path path, out float spread) {
    path = Path(vec3(0), 0u, vec3(0), 0.0);
    spread = 0.0;
    if (!surface.exists) return no_ray();
    float part = keep_interface(surface.scatterer, surface.glass);
    if (!(part > 0.0)) return no_ray();
    Scattered next = along_mirror ? mirrored_by(surface.scatterer, surface.wo)
                                  : scattered_at(surface.scatterer, surface.glass, surface.wo, pixel, 0u);
    if (next.weight == vec3(0)) return no_ray();
    if (!along_mirror) spread = spread_of(next, surface.scatterer, surface.glass, surface.wo);
    path.throughput = part * next.weight;
    path.scatterings = surface.scatterer.alpha < MIRROR_ALPHA ? 0u : 1u;
    return ray_from(surface.position_ws, surface.geometric_n, next.direction_ws);
}

void main() {
    uint place = gl_GlobalInvocationID.x;
    ivec2 pixel;
    if (!pixel_of(place, pixel)) return;
    Path path;
    float spread;
    rays[ray_of_hit(place)] = look(seen_surface(pixel), pixel, path, spread);
    spreads[place] = signed_spread(path, spread);
    paths[place] = path;
}
