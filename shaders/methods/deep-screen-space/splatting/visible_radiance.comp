// LIT: surfels send light, else nothing. The stored radiance of the winners of every level, on the side that was hit: at their places, or (UNSHUFFLED)
// where the pixels are.
layout(local_size_x = 8, local_size_y = 8) in;

#include "methods/deep-screen-space/records.glsl"
#include "methods/deep-screen-space/splatting/places.glsl"

layout(std430) readonly buffer Surfels { Surfel surfels[]; };
#if LIT
layout(std430) readonly buffer SurfelLights { SurfelLight surfel_lights[]; };
#endif

#ifdef UNSHUFFLED
uniform usampler2DArray places;
#else
uniform usampler2DArray layout_texture;
#endif
uniform usampler2DArray winners;
uniform sampler2DArray directions;
layout(rgba32f) uniform writeonly image2DArray radiance_image;

uniform int levels;

struct Place {
    ivec2 place, pixel;
};

Place place_of(ivec3 at) {
#ifdef UNSHUFFLED
    return Place(unpacked_place(texelFetch(places, ivec3(at.xy, at.z % levels), 0).x), at.xy);
#else
    return Place(at.xy, unpacked_place(texelFetch(layout_texture, ivec3(at.xy, at.z % levels), 0).x));
#endif
}

void main() {
    ivec3 at = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(at, imageSize(radiance_image)))) return;
    Place p = place_of(at);
    uint winner = texelFetch(winners, ivec3(p.place, at.z), 0).x;
    vec4 radiance = vec4(0);
    if (winner != 0u) {
        Surfel s = surfels[winner - 1u];
        bool is_front = dot(s.normal_ws, texelFetch(directions, ivec3(p.pixel, at.z / levels), 0).xyz) <= 0.0;
        radiance.a = 1.0;
#if LIT
        radiance.rgb = light_of_side(surfel_lights[winner - 1u], is_front);
#endif
    }
    imageStore(radiance_image, at, radiance);
}
