// What cover.frag counts, with 1 + a surfel's index for each splat, which tells surfels apart.
#include "methods/deep-screen-space/splatting/splat_common.glsl"

layout(location = 0) out vec2 out_cover;

void main() {
    vec4 position = own_position();
    Surfel surfel = surfels[surfel_index];
    bool is_reached = position.w > 0.0 && distance(position.xyz, surfel.centre_ws) <=
                                              shell_of(surfel.radius, level).outer;
    out_cover = float(surfel_index + 1u) * vec2(1, is_reached ? 1 : 0);
}
