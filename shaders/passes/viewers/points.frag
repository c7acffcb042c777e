// A disc with a darker rim, so that points are told from each other and from what is behind.

uniform uint layer_number;
uniform float point_px;

layout(location = 0) flat in vec3 colour;
layout(location = 1) flat in uint element;
layout(location = 0) out vec4 out_colour;
layout(location = 1) out uvec2 out_id;

void main() {
    float from_centre_px = length(gl_PointCoord - 0.5) * point_px;
    // a little less than half, so that points of three pixels lose their corners
    float radius_px = 0.5 * point_px - 0.1;
    if (point_px >= 2.5 && from_centre_px > radius_px) discard;
    // small points have no room for a rim, and would only be dark
    float rim = smoothstep(0.55, 0.95, from_centre_px / radius_px) * smoothstep(2.5, 7.0, point_px);
    out_colour = vec4(colour * mix(1.0, 0.35, rim), 1);
    out_id = uvec2(layer_number, element);
}
