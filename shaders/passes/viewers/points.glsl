// Where points stand on the picture. Include after layer.glsl and project.glsl.

uniform float point_px;  // diameter, in samples of the picture

// At each sample: the nearest depth as a key that grows towards the viewer, and the element plus 1 of the
// point that has it; 0: none.
layout(std430) buffer NearestKeys { uint nearest_keys[]; };
layout(std430) buffer NearestElements { uint nearest_elements[]; };

// Centre in samples from the upper left corner, and depth; false where the point is not drawn.
bool point_place(vec3 position_ws, out vec2 centre_px, out float depth) {
    vec4 clip = clip_position(position_ws);
    centre_px = vec2(0);
    depth = 0.0;
    if (!(clip.w > 0.0)) return false;
    vec3 ndc = clip.xyz / clip.w;
    if (orthographic && (ndc.z < 0.0 || ndc.z > 1.0)) return false;
    // what is too near or too far for the depth's range is drawn all the same
    depth = clamp(ndc.z, 0.0, 1.0);
    centre_px = (vec2(ndc.x, -ndc.y) * 0.5 + 0.5) * size_px;
    return true;
}

// Points are round from three pixels on; a little less than half, so that those of three lose their corners.
bool is_round() { return point_px >= 2.5; }
float point_radius() { return is_round() ? 0.5 * point_px - 0.1 : 0.5 * point_px; }
