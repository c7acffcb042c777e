// Adds what a surfel does to the surface at a place.
#include "methods/deep-screen-space/splatting/splat_common.glsl"
#include "methods/deep-screen-space/splatting/additive_share.glsl"

#if LIGHT
layout(location = 0) out vec4 add_diffuse;
#if MATERIALS != 2  // SCATTERING_LAMBERT
layout(location = 1) out vec4 add_glossy;
#endif
#else
layout(location = 0) out float add_occlusion;
#endif

void main() {
    vec4 position = own_position();
    if (position.w == 0.0) discard;
    Share share = share_of(surfels[surfel_index], surfel_index, level, own_pixel(), position.xyz, own_normal());
    if (!share.counts) discard;
#if LIGHT
    add_diffuse = vec4(share.diffuse, 0);
#if MATERIALS != 2
    add_glossy = vec4(share.glossy, 0);
#endif
#else
    add_occlusion = share.diffuse.x;
#endif
}
