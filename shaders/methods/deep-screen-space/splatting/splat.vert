// Two triangles a surfel that cover its rectangle of places. Their edges lie between places, so that exactly
// those inside are covered.
layout(std430) readonly buffer Rectangles { uvec2 rectangles[]; };

uniform uint first_surfel;  // whose rectangle is the first
uniform vec2 framebuffer_size;

layout(location = 0) flat out uint surfel_index;

/// x and y of the corners, 0: first, 1: last.
const uint CORNER_X = 0x32u;  // of vertices 0 … 5: 0 1 0 0 1 1
const uint CORNER_Y = 0x2cu;  // 0 0 1 1 0 1

void main() {
    uint vertex = uint(gl_VertexID), corner = vertex % 6u;
    surfel_index = first_surfel + vertex / 6u;
    uvec2 word = rectangles[vertex / 6u];
    uint x = (CORNER_X >> corner & 1u) == 0u ? word.x & 0xffffu : word.y & 0xffffu;
    uint y = (CORNER_Y >> corner & 1u) == 0u ? word.x >> 16 : word.y >> 16;
    vec2 place = vec2(x, y) / framebuffer_size;
    gl_Position = vec4(2.0 * place.x - 1.0, 1.0 - 2.0 * place.y, 0, 1);
}
