// A surface under a light at the eye.

#include "lib/coverage.glsl"
#include "lib/material.glsl"

layout(std430) readonly buffer Materials { Material materials[]; };

uniform vec3 eye_ws, view_axis_ws;  // axis: of an orthographic view, else 0
uniform vec3 tint;                  // mean colour of the material
uniform int material_index;
uniform bool is_masked;

layout(location = 0) in vec3 position_ws;
layout(location = 1) in vec3 normal_ws;
layout(location = 2) in vec4 colour;
layout(location = 3) in vec4 uv01;
layout(location = 0) out vec4 out_colour;

// What grazes is not black, so that shapes read everywhere.
const float AMBIENT = 0.15;

void main() {
    if (is_masked) {
        vec2 mask_uv = uv_of_slot(materials[material_index].base_colour_slot, uv01.xy, uv01.zw);
        if (!is_covered(uint(material_index), mask_uv)) discard;
    }
    vec3 to_viewer = view_axis_ws == vec3(0) ? normalize(eye_ws - position_ws) : -view_axis_ws;
    float size = length(normal_ws);
    float facing = size > 0.0 ? abs(dot(normal_ws, to_viewer)) / size : 1.0;
    out_colour = vec4(tint * colour.rgb * (AMBIENT + (1.0 - AMBIENT) * facing), 1);
}
