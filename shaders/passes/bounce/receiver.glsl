// What a pixel shows, as a receiver of light. With LIGHT 1 also how it scatters: MATERIALS as
// Transport::Materials counts; see renderers/passes/bounce/receiver.h.

uniform sampler2D gbuffer_position;
uniform sampler2D gbuffer_normal;
uniform sampler2D gbuffer_geometric_normal;

struct Receiver {
    bool exists;
    vec3 position, normal, geometric_normal;
};

/// Half floats are not quite of unit length; where they differ from the triangle's normal by rounding alone,
/// they are the same, so that nothing of an open plane's hemisphere lies below it.
vec3 shading_normal(vec3 stored, vec3 geometric_normal) {
    float size = length(stored);
    if (size < 0.5) return geometric_normal;
    vec3 n = stored / size;
    return dot(n, geometric_normal) > 1.0 - 1e-6 ? geometric_normal : n;
}

Receiver receiver_at(ivec2 pixel) {
    vec3 geometric_normal = texelFetch(gbuffer_geometric_normal, pixel, 0).xyz;
    return Receiver(geometric_normal != vec3(0.0), texelFetch(gbuffer_position, pixel, 0).xyz,
                    shading_normal(texelFetch(gbuffer_normal, pixel, 0).xyz, geometric_normal), geometric_normal);
}

#if LIGHT
#include "lib/material.glsl"
#include "lib/scattering.glsl"

uniform sampler2D gbuffer_albedo;
uniform sampler2D gbuffer_material;
layout(std430) readonly buffer Materials { Material materials[]; };

uniform vec3 eye_ws;
uniform vec3 view_axis_ws;  // of an orthographic view; 0 for a perspective one
uniform float min_roughness;

bool is_unlit(vec4 material) { return material.z > 0.5; }

vec3 viewer_of(Receiver receiver) {
    return view_axis_ws == vec3(0.0) ? normalize(eye_ws - receiver.position) : -view_axis_ws;
}

// DEVIATION [Nalbach15 §3.1]: surfaces smoother than `min_roughness` are taken for this rough, here and where
// they reflect, since a mirror's direction has no density and its neighbours' directions would be of no use to
// it. The reference follows mirrors without counting them as a scattering. A metal in a white furnace, 0.12 degrees
// a pixel and a filter of radius 3, is right on average, but varies by 0.33 at roughness 0.05 and by 0.03 at 0.1.
Scatterer scatterer_of(Receiver receiver, vec3 colour, vec4 material) {
    int index = int(clamp(material.w + 0.5, 0.0, float(materials.length() - 1)));
    return make_scatterer(receiver.normal, receiver.geometric_normal, colour, material.x,
                          max(material.y, min_roughness), materials[index].ior, MATERIALS);
}

/// Neighbours take samples, too: where one is black and another bright, the black one's must not all be those of
/// its highlight, of which a diffuse surface can make little.
/// DEVIATION [Nalbach15 §3.1]: so darker surfaces choose like ones of this colour. Densities are those of the
/// choice, and what is reflected is not touched.
// C++: ir::passes::bounce::min_colour
const float MIN_COLOUR = 0.05;

/// By which the pixel's directions are chosen.
Scatterer chooser_of(Receiver receiver, ivec2 pixel, vec4 material) {
    return scatterer_of(receiver, max(texelFetch(gbuffer_albedo, pixel, 0).rgb, MIN_COLOUR), material);
}
#endif
