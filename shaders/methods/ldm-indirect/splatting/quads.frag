// Adds the kernel where it covers the pixel's surface; blending sums. [Aalund15 eqs. 5-7]
#include "methods/ldm-indirect/splatting/kernel.glsl"

uniform sampler2D gbuffer_position;
uniform sampler2D gbuffer_geometric_normal;

layout(location = 0) flat in vec3 centre_ws;
layout(location = 1) flat in vec3 row_p;
layout(location = 2) flat in vec3 row_q;
layout(location = 3) flat in vec3 row_n;
layout(location = 4) flat in vec3 peak;
layout(location = 5) flat in vec4 to_source_ws;  // w: per_cosine

layout(location = 0) out vec4 added;  // A: photons
layout(location = 1) out vec4 added_direction;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec3 normal_ws = texelFetch(gbuffer_geometric_normal, pixel, 0).xyz, irradiance;
    Kernel k = Kernel(centre_ws, row_p, row_q, row_n, peak, to_source_ws.xyz, to_source_ws.w);
    if (normal_ws == vec3(0) || !add_kernel(k, texelFetch(gbuffer_position, pixel, 0).xyz, normal_ws, irradiance)) discard;
    added = vec4(irradiance, 1);
    added_direction = vec4(direction_of(k, irradiance), 0);
}
