// Where a spot shines. Include after passes/shadow/texel.glsl.
uniform vec3 cone_axis_ws;
uniform float cone_cosine;  // of its outer half-angle; below -1: the light has no cone

/// Where a spot does not shine its map stays empty.
bool is_outside_cone() {
    vec3 direction = texel_direction();
    return dot(direction, cone_axis_ws) < cone_cosine * length(direction);
}
