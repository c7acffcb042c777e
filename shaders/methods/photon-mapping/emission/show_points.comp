// Puts the points over the map, at all steps.
layout(local_size_x = 64) in;
#include "methods/photon-mapping/emission/steps.glsl"

layout(rgba16f) uniform writeonly image2DArray picture;

const vec3 LEAVES = vec3(1.0, 0.35, 0.02), ENDS = vec3(0.05, 0.35, 1.0);

void main() {
    ShownPoint s = shown_point(first_item + gl_GlobalInvocationID.x);
    if (!s.is_shown) return;
    ivec2 size = imageSize(picture).xy;
    for (int step = 0; step < step_count; ++step) {
        take_step(s, step);
        ivec2 place = min(ivec2(place_of(s.warped, step) * vec2(size)), size - 1);
        imageStore(picture, ivec3(place, step), vec4(s.survives ? LEAVES : ENDS, 1));
    }
}
