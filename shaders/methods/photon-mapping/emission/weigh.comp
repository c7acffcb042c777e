// The map of emission probabilities, weighted by what photons of its texels met in earlier frames.  [Smal19 §5.4.2]
// DEVIATION [Smal19 §5.4.2]: printed is 1/10 + 9/10 x p, which sends points to texels that no photon leaves.
layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2DArray probability;
uniform sampler2DArray previous_position;  // x
layout(r32f) uniform writeonly image2DArray weighted;

/// So that all texels go on to be tried, and none gets a power without bound.
const float MIN_WEIGHT = 0.1;

void main() {
    ivec3 place = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(place.xy, textureSize(probability, 0).xy))) return;
    float p = texelFetch(probability, place, 0).r;
    float x = texelFetch(previous_position, place, 0).r;
#ifdef PRINTED
    float value = MIN_WEIGHT + (1.0 - MIN_WEIGHT) * x * p;
#else
    float value = p * (MIN_WEIGHT + (1.0 - MIN_WEIGHT) * x);
#endif
    imageStore(weighted, place, vec4(value));
}
