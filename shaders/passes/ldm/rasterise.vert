// Raster builder: one instance of all triangles per map, drawn onto one another; only the buffers tell the
// maps apart.
#include "passes/ldm/triangle.glsl"
#ifdef MASKED
#include "passes/ldm/mask.glsl"
#endif

uniform uint first_map;  // of the chunk, among all frames
uniform int resolution;

flat out uint map;
noperspective out float depth_quanta;
#ifdef MASKED
noperspective out vec2 uv0;
noperspective out vec2 uv1;
#endif

void main() {
    uint vertex = uint(gl_VertexID);
    vec3 position = scene_position_ws(vertex);
    map = uint(gl_InstanceID);
    vec4 u = ldm_frames[first_map + map].u, v = ldm_frames[first_map + map].v;
    vec4 depth = ldm_frames[first_map + map].depth;
    vec2 texel = vec2(dot(position, u.xyz) + u.w, dot(position, v.xyz) + v.w);
    depth_quanta = dot(position, depth.xyz) + depth.w;
#ifdef MASKED
    uv0 = scene_uv0[vertex];
    uv1 = scene_uv1[vertex];
#endif
    vec2 ndc = 2.0 * texel / float(resolution) - 1.0;
    gl_Position = vec4(ndc.x, -ndc.y, 0.5, 1.0);  // row 0 is at y = +1
}
