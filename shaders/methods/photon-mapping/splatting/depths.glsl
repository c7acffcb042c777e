// Where the surfaces of the pixels are that texels are for.
#include "lib/pixel_rays.glsl"
#include "methods/photon-mapping/splatting/splat_view.glsl"

uniform sampler2D depths;  // infinite: no surface

vec3 surface_at(ivec2 texel) {
    vec2 middle_px = pixel_at(texel);
    return pixel_ray_origin(middle_px) + texelFetch(depths, texel, 0).x * pixel_ray_direction(middle_px);
}
