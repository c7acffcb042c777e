// Colours of elements. Include after layer.glsl.

uniform sampler2D colour_map;  // 256 × 1, linear RGB

const vec3 colour_of_no_number = vec3(0.02);

vec3 element_colour(uint base, vec3 position_ws) {
    if (layer.colour_mode == COLOUR_SINGLE) return vec3(layer.red, layer.green, layer.blue);
    float x = colour_number(base, position_ws);
    if (!is_finite(x)) return colour_of_no_number;
    float range = layer.high - layer.low;
    float t = range != 0.0 ? clamp((x - layer.low) / range, 0.0, 1.0) : 0.5;
    return textureLod(colour_map, vec2((t * 255.0 + 0.5) / 256.0, 0.5), 0.0).rgb;
}
