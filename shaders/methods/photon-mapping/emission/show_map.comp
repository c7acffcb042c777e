// The map behind the points: at each step as coarse as the step sees it.
layout(local_size_x = 8, local_size_y = 8) in;
#include "methods/photon-mapping/emission/steps.glsl"

layout(rgba16f) uniform writeonly image2DArray picture;

void main() {
    ivec3 place = ivec3(gl_GlobalInvocationID);
    int size = imageSize(picture).x;
    if (any(greaterThanEqual(place.xy, ivec2(size)))) return;
    int levels = findMSB(textureSize(probability_map, 0).x);
    int level = levels - 1 - (place.z + 1) / 2;  // -1: the map itself
    uvec2 cell = uvec2(place.xy) * (1u << uint((place.z + 1) / 2)) / uint(size);
    float value = scaling_at(cell, shown_source, level);
    float mean = mean_probability(shown_source, levels);
    // linear, and dark enough for the dots in front
    float grey = mean > 0.0 ? min(0.25, 0.02 * value / mean) : 0.0;
    imageStore(picture, place, vec4(vec3(grey), 1));
}
