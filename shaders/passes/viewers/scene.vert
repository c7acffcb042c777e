// The flat-shaded scene.
uniform mat4 clip_from_world;

layout(location = 0) in vec3 vertex_ws;
layout(location = 0) out vec3 position_ws;

void main() {
    position_ws = vertex_ws;
    gl_Position = clip_from_world * vec4(vertex_ws, 1);
}
