// What the surfels that rays met send towards the pixels. [Nalbach15 §3.2]
// BLACK_BACKS: nothing from behind; GLOSSY_SENDERS: with highlights. MATERIALS: as Transport::Materials counts.
#include "methods/deep-screen-space/records.glsl"
#include "passes/bounce/tiles.glsl"

layout(std430) readonly buffer Surfels { Surfel surfels[]; };
layout(std430) readonly buffer SurfelLights { SurfelLight surfel_lights[]; };

uniform usampler2DArray nearest;
uniform sampler2DArray directions;
layout(rgba32f) uniform writeonly image2DArray incoming;

#if GLOSSY_SENDERS
#include "methods/deep-screen-space/splatting/resolve_glossy.glsl"
#endif

vec3 sent(uint surfel, vec3 direction_ws) {
    Surfel s = surfels[surfel];
    bool is_front = dot(s.normal_ws, direction_ws) <= 0.0;
#if BLACK_BACKS
    if (!is_front) return vec3(0);
#endif
    vec3 radiance = light_of_side(surfel_lights[surfel], is_front);
#if GLOSSY_SENDERS
    radiance = max(radiance + sent_to_one_side(s, direction_ws), 0.0);
#endif
    return radiance;
}

void main() {
    ivec2 pixel = tile_pixel();
    ivec3 size = imageSize(incoming);
    if (any(greaterThanEqual(pixel, size.xy))) return;
    for (int i = 0; i < size.z; ++i) {
        ivec3 at = ivec3(pixel, i);
        uint winner = texelFetch(nearest, at, 0).x;
        vec3 radiance = vec3(0);
        if (winner != 0u) radiance = sent(winner - 1u, texelFetch(directions, at, 0).xyz);
        imageStore(incoming, at, vec4(radiance, winner != 0u ? 1 : 0));
    }
}
