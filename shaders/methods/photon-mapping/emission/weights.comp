// Weights of texels for the next frame, as places of masses on springs that this frame's counts pull.
// [Smal19 §5.4.2]
// DEVIATION [Smal19 §5.4.2]: C_m is for the photons that a texel emits in the mean, so that it depends on neither the
// number of photons nor the map's resolution. Counts are those of one frame. At 0 and 1 there is no velocity outwards,
// which would hold x there for as long as it had grown.
// DEVIATION [Smal19 §5.4.2]: printed, x moves by the old velocity, which swings up for springs beyond the drag.
layout(local_size_x = 8, local_size_y = 8) in;
#include "methods/photon-mapping/records.glsl"

layout(std430) readonly buffer Sources { Source sources[]; };
layout(std430) readonly buffer Sums { int sums[]; };
uniform sampler2DArray previous_velocity;
uniform sampler2DArray previous_position;
layout(r32f) uniform writeonly image2DArray counts;
layout(r32f) uniform writeonly image2DArray velocity;
layout(r32f) uniform writeonly image2DArray position;

uniform float force, spring, drag;  // C_m times photons of a texel, k, C_d
uniform float photons_per_point;

void main() {
    ivec3 place = ivec3(gl_GlobalInvocationID);
    ivec2 size = textureSize(previous_position, 0).xy;
    if (any(greaterThanEqual(place.xy, size))) return;
    float photons = float(sources[place.z].points) * photons_per_point / float(size.x * size.y);
    float m = float(sums[(place.z * size.y + place.y) * size.x + place.x]);
    float v = texelFetch(previous_velocity, place, 0).r, x = texelFetch(previous_position, place, 0).r;
    float a = (photons > 0.0 ? m * force / photons : 0.0) - spring * x - drag * v;
#ifdef PRINTED
    x = clamp(x + v, 0.0, 1.0);
    v += a;
#else
    v += a;
    x = clamp(x + v, 0.0, 1.0);
#endif
    if (x <= 0.0) v = max(v, 0.0);
    if (x >= 1.0) v = min(v, 0.0);
    imageStore(counts, place, vec4(m));
    imageStore(velocity, place, vec4(v));
    imageStore(position, place, vec4(x));
}
