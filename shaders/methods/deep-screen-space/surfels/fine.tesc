// The same level along all sides and inside: how many points that makes is known.
layout(vertices = 1) out;

in PatchVertex {
    vec3 a, ab, ac, normal_ws;
    float surfel_area;
    uvec4 words;
    uint level;
} from[];

out PatchControl {
    vec3 a, ab, ac, normal_ws;
    float surfel_area;
    uvec4 words;
} to[];

void main() {
    to[gl_InvocationID].a = from[gl_InvocationID].a;
    to[gl_InvocationID].ab = from[gl_InvocationID].ab;
    to[gl_InvocationID].ac = from[gl_InvocationID].ac;
    to[gl_InvocationID].normal_ws = from[gl_InvocationID].normal_ws;
    to[gl_InvocationID].surfel_area = from[gl_InvocationID].surfel_area;
    to[gl_InvocationID].words = from[gl_InvocationID].words;
    float level = float(from[0].level);
    gl_TessLevelOuter[0] = gl_TessLevelOuter[1] = gl_TessLevelOuter[2] = level;
    gl_TessLevelInner[0] = level;
}
