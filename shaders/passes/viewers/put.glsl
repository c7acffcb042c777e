// What a fragment of a line or glyph leaves: its colour and what it is of. With TRANSLUCENT instead what it adds to the
// sums over all translucent fragments of its sample, which compose.frag makes a colour of, whatever their order.
// [McGuire13 §3]

#ifdef TRANSLUCENT
uniform float opacity;                // of the layer, below 1
uniform float near_plane, far_plane;  // m
uniform bool has_linear_depth;        // of an orthographic camera

layout(location = 0) out vec4 out_weighted;
layout(location = 1) out float out_optical_depth;

/// From 0 at the near plane to 1 at the far one.
float part_of_range(float depth) {
    return has_linear_depth ? depth : near_plane * depth / (far_plane - depth * (far_plane - near_plane));
}

// DEVIATION [McGuire13 eq. 7]: there the weight falls with the distance in scene units, clamped to 0.01 to 3000. Here
// the planes lie about what is drawn, and the nearest weighs 1024 times the farthest, in equal steps of a factor, so
// that scenes of any size look alike. By eq. 7 it weighs 36 times as much from 2 to 12 m, and the same from 2 to 12 cm,
// where all weights are clamped. Pictures were not compared.
void put(vec3 colour, uint layer_number, uint element, float depth) {
    float weight = opacity * exp2(-10.0 * part_of_range(depth));
    out_weighted = vec4(weight * colour, weight);
    out_optical_depth = -log(1.0 - opacity);
}
#else
layout(location = 0) out vec4 out_colour;
layout(location = 1) out uvec2 out_id;

void put(vec3 colour, uint layer_number, uint element, float depth) {
    out_colour = vec4(colour, 1);
    out_id = uvec2(layer_number, element);
}
#endif
