// A vertex is a patch of one point.
#define SCENE_POSITIONS
#define SCENE_INDICES
#include "passes/scene/scene.glsl"
#include "lib/triangle_plane.glsl"
#include "methods/deep-screen-space/surfels/patch.glsl"

layout(std430) readonly buffer Patches { Patch patches[]; };

out PatchVertex {
    vec3 a, ab, ac, normal_ws;
    float surfel_area;  // m²
    uvec4 words;        // triangle, m, place, index of the patch
    uint level;
} vertex;

void main() {
    Patch p = patches[gl_VertexID];
    uvec3 corners = scene_triangle(p.triangle);
    vec3 a = scene_position_ws(corners.x), b = scene_position_ws(corners.y), c = scene_position_ws(corners.z);
    vertex.a = a;
    vertex.ab = b - a;
    vertex.ac = c - a;
    vertex.normal_ws = triangle_plane(a, b, c).normal;
    float area = 0.5 * length(cross(b - a, c - a));
    vertex.surfel_area = area / (float(p.splits) * float(p.splits) * float(tessellated_points(p.level)));
    vertex.words = uvec4(p.triangle, p.splits, p.place, uint(gl_VertexID));
    vertex.level = p.level;
}
