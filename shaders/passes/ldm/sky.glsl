// Adds some maps' directions to each pixel's environment light: Σ V cosθ L, L the mean radiance of the direction's
// region, and Σ cosθ. [Aalund15 §6] For programs of methods.
layout(local_size_x = 8, local_size_y = 8) in;
#include "passes/ldm/frames.glsl"
#include "passes/ldm/storage.glsl"
#include "passes/ldm/trace.glsl"
#include "passes/ldm/self_hit.glsl"

uniform sampler2D gbuffer_position;
uniform sampler2D gbuffer_normal;
uniform sampler2D gbuffer_geometric_normal;
layout(rgba32f) uniform image2D sky_sums;

/// Of the dispatch's maps; of each the regions of v and of -v.
uniform vec4 frame_rows[8 * 6];
uniform vec4 region_light[8 * 2];
uniform uint first_frame, first_map, map_count;  // among all maps; in the batch
uniform float sky_distance;                      // m: nearer hits close a direction; 0: all do
uniform bool sky_smooth;                         // they leave (d/d_max)² open

float sky_open(LdmHit hit, float metres_per_quantum) {
    if (!hit.found) return 1.0;
    float part = sky_smooth && sky_distance > 0.0 ? max(hit.distance, 0.0) * metres_per_quantum / sky_distance : 0.0;
    return part * part;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(sky_sums)))) return;
    vec3 geometric_normal = texelFetch(gbuffer_geometric_normal, pixel, 0).xyz;
    vec4 sum = first_frame == 0u ? vec4(0) : imageLoad(sky_sums, pixel);
    if (geometric_normal == vec3(0)) {
        imageStore(sky_sums, pixel, sum);
        return;
    }
    vec3 position_ws = texelFetch(gbuffer_position, pixel, 0).xyz;
    vec3 normal = normalize(texelFetch(gbuffer_normal, pixel, 0).xyz);
    const float unlimited = 1.0 / 0.0;
    for (uint i = 0u; i < map_count; ++i) {
        uint row = 6u * i;
        MapFrame frame = MapFrame(frame_rows[row], frame_rows[row + 1u], frame_rows[row + 2u], frame_rows[row + 3u],
                                  frame_rows[row + 4u], frame_rows[row + 5u]);
        float cosine = dot(normal, frame.direction.xyz);
        bool forward = cosine > 0.0;
        cosine = abs(cosine);
        sum.a += cosine;
        float facing = dot(geometric_normal, frame.direction.xyz);
        vec3 light = region_light[2u * i + (forward ? 0u : 1u)].rgb;
        if (cosine == 0.0 || light == vec3(0) || (forward ? facing <= 0.0 : facing >= 0.0)) continue;
        float reach = sky_distance > 0.0 ? sky_distance / frame.direction.w : unlimited;
        LdmHit hit = ldm_trace(frame, first_map + i, position_ws, geometric_normal, forward, reach);
        sum.rgb += sky_open(hit, frame.direction.w) * cosine * light;
    }
    imageStore(sky_sums, pixel, sum);
}
