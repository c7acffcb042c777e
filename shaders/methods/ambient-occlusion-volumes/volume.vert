// A triangle is a point here; its volume is made of it.
#include "methods/ambient-occlusion-volumes/triangle.glsl"

layout(std430) readonly buffer Occluders { Occluder occluders[]; };

layout(location = 0) flat out uint triangle;
layout(location = 1) flat out uint drawn;
layout(location = 2) flat out vec3 a_ws;
layout(location = 3) flat out vec3 b_ws;
layout(location = 4) flat out vec3 c_ws;

void main() {
    triangle = uint(gl_VertexID);
    drawn = occluders[triangle].drawn;
    mat3 corners = corners_ws(triangle);
    a_ws = corners[0];
    b_ws = corners[1];
    c_ws = corners[2];
    gl_Position = vec4(0.0);
}
