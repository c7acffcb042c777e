// What a surfel does to the surface at a pixel: its form factor, or the light that it sends there, if the surface lies
// in the surfel's shell of the level. LIGHT, GLOSSY_SENDERS, MATERIALS. Include records.glsl before it, and the surfels.
// [Nalbach15 §4.1; Nalbach14]
#include "lib/constants.glsl"
#include "methods/deep-screen-space/splatting/influence.glsl"
#if LIGHT
#include "passes/bounce/receiver.glsl"
#if GLOSSY_SENDERS
#include "methods/deep-screen-space/surfels/sent.glsl"
#include "methods/deep-screen-space/splatting/resolve_glossy.glsl"
#endif

uniform bool black_backs;
layout(std430) readonly buffer SurfelLights { SurfelLight surfel_lights[]; };
#else
uniform float falloff_distance;  // m, of the smooth fall-off; 0: hard
#endif

struct Share {
    bool counts;   // else there is none
    float distance_m;
    vec3 diffuse;  // reflected by a white Lambert part, W/(m² sr); or occlusion, in all three
    vec3 glossy;   // reflected by the microfacets
};

/// ∫ of |cos| at the sender over the disc's solid angle, so that times the receiver's cosine over π it is the form
/// factor from a point to the disc: exact for discs that face the point on their axis, where it is
/// R² / (x² + R²), and for small ones; never more than π.  [Wallace89; Bunnell05]
float solid_angle(float area, float squared_distance, float sender_cosine) {
    return area * sender_cosine / (squared_distance + area / PI);
}

/// On level l a surfel is splatted into one of 4^l sub-images, where it stands for 4^l of its kind.
// DEVIATION [Nalbach15 §4.1]: one disc of 4^l times the area in their place would hide itself, A being grown in
// the denominator, too: sums of levels would be too small in expectation, by up to 4 ε of a level. Measured where
// ε is 0.23 (a corner, d = 1/16 m): RMSE 0.076 against 0.050; none where ε is 0.01.
float surfels_stood_for(int level) {
    return ldexp(1.0, 2 * level);
}

#if LIGHT
vec3 sent_along(Surfel surfel, uint index, vec3 l) {
    bool is_front = dot(surfel.normal_ws, l) < 0.0;
    if (!is_front && black_backs) return vec3(0);
    vec3 sent = light_of_side(surfel_lights[index], is_front);
#if GLOSSY_SENDERS
    sent = max(sent + sent_to_one_side(surfel, l, 0.0), 0.0);
#endif
    return sent;
}

void add_light(Surfel surfel, uint index, ivec2 pixel, vec3 l, float omega, inout Share share) {
    vec4 material = texelFetch(gbuffer_material, pixel, 0);
    if (is_unlit(material)) return;
    Receiver receiver = receiver_at(pixel);
    Scatterer s = scatterer_of(receiver, texelFetch(gbuffer_albedo, pixel, 0).rgb, material);
    if (!is_above(s, l)) return;
    vec3 sent = sent_along(surfel, index, l);
    // The diffuse part without its colour, so that blurring leaves textures alone.
    float n_dot_l = dot(s.n, l);
    Scatterer diffuse = s;
    diffuse.diffuse = vec3(1);
    diffuse.specular = 0.0;
    vec3 viewer = viewer_of(receiver);
    share.counts = true;
    share.diffuse = scattering_value(diffuse, seen_from(diffuse, viewer), l, n_dot_l) * sent * omega;
#if MATERIALS != 2  // SCATTERING_LAMBERT
    s.diffuse = vec3(0);
    share.glossy = scattering_value(s, seen_from(s, viewer), l, n_dot_l) * sent * omega;
#endif
}
#else
void add_form_factor(vec3 normal_ws, vec3 l, float omega, inout Share share) {
    float cosine = dot(normal_ws, l);
    if (cosine <= 0.0) return;
    float relative = falloff_distance > 0.0 ? min(share.distance_m / falloff_distance, 1.0) : 0.0;
    share.counts = true;
    share.diffuse = vec3(cosine * omega / PI * (1.0 - relative * relative));
}
#endif

/// `x_ws` and the shading normal are of the surface at `pixel`.
Share share_of(Surfel surfel, uint index, int level, ivec2 pixel, vec3 x_ws, vec3 normal_ws) {
    vec3 way = surfel.centre_ws - x_ws;
    float squared = dot(way, way);
    Share share = Share(false, sqrt(squared), vec3(0), vec3(0));
    Shell shell = shell_of(surfel.radius, level);
    if (share.distance_m <= shell.inner || share.distance_m > shell.outer) return share;
    vec3 l = way / share.distance_m;
    float area = PI * surfel.radius * surfel.radius;
    float omega = surfels_stood_for(level) * solid_angle(area, squared, abs(dot(surfel.normal_ws, l)));
#if LIGHT
    add_light(surfel, index, pixel, l, omega, share);
#else
    add_form_factor(normal_ws, l, omega, share);
#endif
    return share;
}
