// A disc with a darker rim, so that points are told from each other and from what is behind.

uniform uint layer_number;
uniform float point_px;

layout(location = 0) flat in vec3 colour;
layout(location = 1) flat in uint element;
layout(location = 0) out vec4 out_colour;
layout(location = 1) out uvec2 out_id;

void main() {
    float from_centre_px = length(gl_PointCoord - 0.5) * point_px;
    if (point_px >= 2.5 && from_centre_px > 0.5 * point_px) discard;
    // small points have no room for a rim of a whole pixel
    float rim_px = clamp(0.25 * point_px, 0.0, 1.5);
    float rim = smoothstep(0.5 * point_px - rim_px - 0.75, 0.5 * point_px - 0.25, from_centre_px);
    out_colour = vec4(colour * (point_px >= 2.5 ? mix(1.0, 0.35, rim) : 1.0), 1);
    out_id = uvec2(layer_number, element);
}
