// Depths of the surfaces that a texel stands for.  [Smal19 §6.2.1]
//
// DEVIATION [Smal19 §6.2.1]: what the kernels are tested against are the depths of the closest and the farthest
// pixel, each moved along its own surface to the texel's middle. The depths themselves lie off an oblique
// surface by up to half a texel's slope, and kernels there would shrink: of those with 12 pixels' radius on a plane
// seen at 58 degrees 91 % of the flux would arrive at half and 62 % at quarter resolution; so it is all of it.
#include "methods/photon-mapping/splatting/splat_view.glsl"
#include "lib/pixel_rays.glsl"

uniform sampler2D gbuffer_position;
uniform sampler2D gbuffer_geometric_normal;

layout(location = 0) out float out_depth;
#ifdef LOW_RESOLUTION
layout(location = 1) out vec2 out_surfaces;
#endif

const float nothing = uintBitsToFloat(0x7f800000u);  // infinite

float depth_at(ivec2 pixel) {
    vec4 position = texelFetch(gbuffer_position, pixel, 0);
    return position.w > 0.0 ? view_depth(position.xyz) : nothing;
}

#ifdef LOW_RESOLUTION
/// Where the pixel's plane meets the ray through the texel's middle.
float moved_to_middle(ivec2 pixel, vec2 middle_px, vec2 range) {
    vec3 normal = texelFetch(gbuffer_geometric_normal, pixel, 0).xyz;
    vec3 to_point = texelFetch(gbuffer_position, pixel, 0).xyz - pixel_ray_origin(middle_px);
    float depth = dot(normal, to_point) / dot(normal, pixel_ray_direction(middle_px));
    return isnan(depth) ? range.x : clamp(depth, range.x, range.y);
}
#endif

void main() {
    ivec2 texel = ivec2(gl_FragCoord.xy);
#ifdef LOW_RESOLUTION
    float closest = nothing, farthest = 0.0;
    ivec2 closest_pixel = ivec2(0), farthest_pixel = ivec2(0);
    ivec2 end = min((texel + 1) * divisor, textureSize(gbuffer_position, 0));
    for (int y = texel.y * divisor; y < end.y; ++y)
        for (int x = texel.x * divisor; x < end.x; ++x) {
            float depth = depth_at(ivec2(x, y));
            if (depth < closest) closest = depth, closest_pixel = ivec2(x, y);
            if (depth < nothing && depth > farthest) farthest = depth, farthest_pixel = ivec2(x, y);
        }
    out_depth = closest;
    out_surfaces = vec2(nothing);
    if (closest < nothing) {
        vec2 middle_px = (vec2(texel) + 0.5) * float(divisor), range = vec2(closest, farthest);
        out_surfaces = vec2(moved_to_middle(closest_pixel, middle_px, range),
                            moved_to_middle(farthest_pixel, middle_px, range));
    }
    float stencil = out_surfaces.x;
#else
    out_depth = depth_at(texel);
    float stencil = out_depth;
#endif
    // 1 is in front of everything: no kernel is drawn on the background
    gl_FragDepth = stencil < nothing ? clamp(reversed_depth(stencil), 0.0, 1.0) : 1.0;
}
