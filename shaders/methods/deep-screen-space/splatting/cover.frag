// How many splats cover a place, and how many of them have its surface within reach.
#include "methods/deep-screen-space/splatting/splat_common.glsl"

layout(location = 0) out vec2 out_cover;

void main() {
    vec4 position = own_position();
    Surfel surfel = surfels[surfel_index];
    bool is_reached = position.w > 0.0 && distance(position.xyz, surfel.centre_ws) <=
                                              shell_of(surfel.radius, level).outer;
    out_cover = vec2(1, is_reached ? 1 : 0);
}
