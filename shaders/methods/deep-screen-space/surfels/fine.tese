// A fine surfel for each point of the tessellated patch. [Nalbach15 §4.3, fig. 6 b]
layout(triangles, equal_spacing, point_mode) in;
#include "lib/constants.glsl"
#include "lib/random.glsl"
#include "methods/deep-screen-space/surfels/ideal.glsl"
#include "methods/deep-screen-space/surfels/patch.glsl"

in PatchControl {
    vec3 a, ab, ac, normal_ws;
    float surfel_area;
    uvec4 words;
} from[];

uniform uint seed;

out vec3 fine_centre;
flat out uint fine_triangle;
out vec3 fine_normal;
out float fine_radius;
flat out uint fine_barycentrics, fine_identity, fine_patch;
out float fine_ideal_part;

/// Uniform on the triangle with corners 0, (1, 0) and (0, 1).
vec2 uniform_on_triangle(vec2 u) { return u.x + u.y > 1.0 ? 1.0 - u : u; }

void main() {
    // The pattern's points lie far more than 1/4096 apart, which is far more than devices differ by.
    uvec2 place = uvec2(round(gl_TessCoord.yz * 4095.0));
    uvec4 words = from[0].words;
    uvec4 random = pcg4d(uvec4(words.x, words.y ^ seed, words.z, place.x | place.y << 12u));
#if RANDOM_PLACEMENT
    // DEVIATION [Nalbach15 §4.3]: the point's place in its triangle is hashed instead of its position in the
    // world, which would be the same for points on both sides of an edge; no texture of random numbers. Surfels
    // are placed uniformly on the part of the triangle that was tessellated.
    vec2 uv = uniform_on_triangle(unit_float(random.xy));
#else
    vec2 uv = gl_TessCoord.yz;
#endif
    vec2 weights = patch_weights(Patch(words.x, words.y, words.z, 0u), uv);
    fine_centre = from[0].a + weights.x * from[0].ab + weights.y * from[0].ac;
    fine_triangle = words.x;
    fine_normal = from[0].normal_ws;
    fine_radius = sqrt(from[0].surfel_area / PI);
    fine_barycentrics = packUnorm2x16(weights);
    fine_identity = random.z ^ pcg(random.w);
    fine_patch = words.w;
    fine_ideal_part = from[0].surfel_area / ideal_area(fine_centre);
    gl_Position = vec4(fine_centre, 1);
}
