// Packs what the filters compare.
layout(local_size_x = 16, local_size_y = 16) in;

#include "passes/a_trous/surface.glsl"

uniform sampler2D gbuffer_position;
uniform sampler2D gbuffer_geometric_normal;
layout(rg32ui) uniform writeonly uimage2D surfaces;

uniform vec4 depth_row;  // distance along the view axis of a point in world space
uniform int first_row;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy) + ivec2(0, first_row);
    if (any(greaterThanEqual(pixel, imageSize(surfaces)))) return;
    FilterSurface s = FilterSurface(vec3(0, 0, 1), NO_SURFACE);
    vec4 position = texelFetch(gbuffer_position, pixel, 0);
    if (position.w > 0.0)
        s = FilterSurface(texelFetch(gbuffer_geometric_normal, pixel, 0).xyz, dot(depth_row, vec4(position.xyz, 1)));
    imageStore(surfaces, pixel, uvec4(packed_surface(s), 0u, 0u));
}
