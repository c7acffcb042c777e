layout(location = 0) flat in vec3 colour;
layout(location = 0) out vec4 out_colour;
layout(location = 1) out uvec2 out_id;  // masked: what is marked stays what can be picked

void main() {
    out_colour = vec4(colour, 1);
    out_id = uvec2(0);
}
