// Vertices of the scene; renderers/passes/preview/preview.cpp draws.

uniform mat4 clip_from_world;

layout(location = 0) in vec3 vertex_ws;
layout(location = 1) in vec3 vertex_normal_ws;
layout(location = 2) in vec4 vertex_colour;
layout(location = 3) in vec2 vertex_uv0;
layout(location = 4) in vec2 vertex_uv1;
layout(location = 0) out vec3 position_ws;
layout(location = 1) out vec3 normal_ws;
layout(location = 2) out vec4 colour;
layout(location = 3) out vec4 uv01;

void main() {
    position_ws = vertex_ws;
    normal_ws = vertex_normal_ws;
    colour = vertex_colour;
    uv01 = vec4(vertex_uv0, vertex_uv1);
    gl_Position = clip_from_world * vec4(vertex_ws, 1);
}
