// What the programs that explain one pixel share.
#include "lib/floats.glsl"
#include "passes/ldm/frames.glsl"
#include "passes/ldm/storage.glsl"
#define LDM_VIEWS
#include "passes/ldm/trace.glsl"
#include "passes/ldm/self_hit.glsl"
#include "passes/ldm/way_out.glsl"

uniform sampler2D gbuffer_position;
uniform sampler2D gbuffer_normal;
uniform sampler2D gbuffer_geometric_normal;

uniform ivec2 pixel;  // negative: none

struct Surface {
    bool exists;
    vec3 position, normal, geometric_normal;
};

Surface explained_surface() {
    if (pixel.x < 0) return Surface(false, vec3(0.0), vec3(0.0), vec3(0.0));
    vec3 geometric_normal = texelFetch(gbuffer_geometric_normal, pixel, 0).xyz;
    return Surface(geometric_normal != vec3(0.0), texelFetch(gbuffer_position, pixel, 0).xyz,
                   normalize(texelFetch(gbuffer_normal, pixel, 0).xyz), geometric_normal);
}

float reach_quanta(MapFrame frame) {
    return params.max_distance > 0.0 ? params.max_distance / frame.direction.w : LDM_FAR_QUANTA;
}

/// Metres to the end of what is drawn of a ray that hits nothing: d_max, or where it leaves the scene's bounds.
float open_length(vec3 position_ws, vec3 direction) {
    return params.max_distance > 0.0 ? params.max_distance : way_out(position_ws, direction);
}
