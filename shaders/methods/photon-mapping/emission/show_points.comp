// Puts dots for those points over the map, at all steps, that survive the roulette or that do not.
layout(local_size_x = 64) in;
#include "methods/photon-mapping/emission/steps.glsl"

layout(rgba16f) uniform writeonly image2DArray picture;

uniform bool survive;
uniform vec3 colour;   // linear
uniform float radius;  // of a dot, in texels of the picture

void main() {
    ShownPoint s = shown_point(first_item + gl_GlobalInvocationID.x);
    if (!s.is_shown || s.survives != survive) return;
    ivec2 size = imageSize(picture).xy;
    int reach = int(radius);
    for (int step = 0; step < step_count; ++step) {
        take_step(s, step);
        ivec2 centre = min(ivec2(place_of(s.warped, step) * vec2(size)), size - 1);
        for (int y = -reach; y <= reach; ++y)
            for (int x = -reach; x <= reach; ++x) {
                ivec2 place = centre + ivec2(x, y);
                bool is_within = all(greaterThanEqual(place, ivec2(0))) && all(lessThan(place, size));
                if (is_within && length(vec2(x, y)) <= radius) imageStore(picture, ivec3(place, step), vec4(colour, 1));
            }
    }
}
