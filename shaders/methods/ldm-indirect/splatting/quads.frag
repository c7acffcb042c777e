// Adds the kernel where it covers the pixel's surface; blending sums. [Aalund15 eqs. 5-7]
#include "methods/ldm-indirect/seen.glsl"
#include "methods/ldm-indirect/splatting/kernel.glsl"
#ifdef CLIPPED
#include "methods/ldm-indirect/splatting/clipping.glsl"
#endif

layout(location = 0) flat in vec3 centre_ws;
layout(location = 1) flat in vec3 row_p;
layout(location = 2) flat in vec3 row_q;
layout(location = 3) flat in vec3 row_n;
layout(location = 4) flat in vec3 peak;
layout(location = 5) flat in vec4 to_source_ws;  // w: per_cosine
layout(location = 6) flat in vec2 beam;          // distance, map

layout(location = 0) out vec4 added;  // A: photons
layout(location = 1) out vec4 added_direction;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec3 normal_ws = texelFetch(gbuffer_geometric_normal, pixel, 0).xyz, irradiance;
    vec3 position_ws = texelFetch(gbuffer_position, pixel, 0).xyz;
    Kernel k = Kernel(centre_ws, row_p, row_q, row_n, peak, to_source_ws.xyz, to_source_ws.w, beam.x, uint(beam.y));
    if (normal_ws == vec3(0) || !add_kernel(k, position_ws, normal_ws, irradiance)) discard;
#ifdef CLIPPED
    if (!is_lit(k, pixel, textureSize(gbuffer_position, 0), position_ws)) discard;
#endif
    added = vec4(irradiance, 1);
    added_direction = vec4(direction_of(k, irradiance), 0);
}
