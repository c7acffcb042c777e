// Adds some maps' directions to each pixel's sums: Σ V cosθ and Σ cosθ. [Aalund15 eq. 2]
// With LDM_VIEWS instead: how often x's own entry was found, how many directions were queried, how often it was
// missing, and how often something else may have been taken for it.
layout(local_size_x = 8, local_size_y = 8) in;
#include "passes/ldm/frames.glsl"
#include "passes/ldm/storage.glsl"
#include "passes/ldm/trace.glsl"
#include "passes/ldm/self_hit.glsl"
#include "methods/ldm-ao/visibility.glsl"
#ifdef EXACT_HITS
#include "methods/ldm-ao/exact.glsl"
#endif

uniform sampler2D gbuffer_position;
uniform sampler2D gbuffer_normal;
uniform sampler2D gbuffer_geometric_normal;
#ifdef LDM_VIEWS
layout(rgba32f) uniform image2D sums;
#else
layout(rg32f) uniform image2D sums;
#endif

/// Of the dispatch's maps. Uniforms cost software drivers one load for all invocations, buffers one for each.
uniform vec4 frame_rows[16 * 6];
uniform uint first_frame, first_map, map_count;  // among all maps; in the batch

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(sums)))) return;
    vec3 geometric_normal = texelFetch(gbuffer_geometric_normal, pixel, 0).xyz;
    vec4 sum = first_frame == 0u ? vec4(0.0) : imageLoad(sums, pixel);
    if (geometric_normal == vec3(0.0)) {
        imageStore(sums, pixel, sum);
        return;
    }
    vec3 position_ws = texelFetch(gbuffer_position, pixel, 0).xyz;
    vec3 normal = normalize(texelFetch(gbuffer_normal, pixel, 0).xyz);
    const float unlimited = 1.0 / 0.0;
    for (uint i = 0u; i < map_count; ++i) {
        uint row = 6u * i;
        MapFrame frame = MapFrame(frame_rows[row], frame_rows[row + 1u], frame_rows[row + 2u],
                                  frame_rows[row + 3u], frame_rows[row + 4u], frame_rows[row + 5u]);
        float cosine = dot(normal, frame.direction.xyz);
        bool forward = cosine > 0.0;
        cosine = abs(cosine);
#ifndef LDM_VIEWS
        sum.y += cosine;
#endif
        float facing = dot(geometric_normal, frame.direction.xyz);
        if (cosine == 0.0 || (forward ? facing <= 0.0 : facing >= 0.0)) continue;  // below the surface: closed
        float reach = params.max_distance > 0.0 ? params.max_distance / frame.direction.w : unlimited;
#ifdef EXACT_HITS
        float exact_up_to = exact_reach(frame);
        float exact = exact_distance(uint(pixel.y * imageSize(sums).x + pixel.x), first_map + i, exact_up_to);
        if (exact >= 0.0 || exact_texels < 0.0) {
            sum.x += cosine * (exact < 0.0 ? 1.0 : isinf(reach) ? 0.0 : visibility(exact));
            continue;
        }
        LdmHit hit = ldm_trace_beyond(frame, first_map + i, params.resolution, position_ws, geometric_normal,
                                      forward, reach, ldm_rule(), exact_up_to / frame.direction.w,
                                      params.self_hit == SELF_HIT_TANGENT_PLANE);
#else
        LdmHit hit = ldm_trace(frame, first_map + i, position_ws, geometric_normal, forward, reach);
#endif
#ifdef LDM_VIEWS
        if (!hit.outside) sum += vec4(hit.own ? 1.0 : 0.0, 1.0, hit.own ? 0.0 : 1.0, hit.rejected);
#else
        float open = 1.0;
        if (hit.found) open = isinf(reach) ? 0.0 : visibility(max(hit.distance, 0.0) * frame.direction.w);
        sum.x += open * cosine;
#endif
    }
    imageStore(sums, pixel, sum);
}
