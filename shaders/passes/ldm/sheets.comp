// Of each point of the maps shown the part of its surface that its texel stands for: the texel's outline, tilted as the
// triangle lies.
layout(local_size_x = 64) in;
#include "lib/floats.glsl"
#include "passes/ldm/frames.glsl"
#include "passes/ldm/point.glsl"

layout(std430) readonly buffer LdmPoints { uint points[]; };
layout(std430) readonly buffer PointCount { uint point_count; };
// C++: ir::passes::ldm::Sheet
struct Sheet {
    float centre[3], axis_u[3], axis_v[3];
    float facing, depth;
    uint layer, map;
};
layout(std430) writeonly buffer Sheets { Sheet sheets[]; };
layout(std430) buffer SheetCount { uint sheet_count; };

uniform uint first_item, end_item, room;  // room: elements that both buffers hold

/// Half a texel's side, moved along the map's direction into the plane of a surface.
vec3 half_side(vec3 step_ws, vec3 normal, vec3 direction, float steepest_ws) {
    float facing = dot(normal, direction);
    float gain_ws = facing == 0.0 ? 0.0 : -dot(normal, step_ws) / facing;
    return 0.5 * (step_ws + clamp(gain_ws, -steepest_ws, steepest_ws) * direction);
}

void main() {
    uint point = first_item + gl_GlobalInvocationID.x;
    if (point == 0u) sheet_count = point_count;
    if (point >= min(end_item, min(point_count, room))) return;
    uint word = POINT_WORDS * point;
    vec3 position, normal;
    for (uint i = 0u; i < 3u; ++i) {
        position[i] = uintBitsToFloat(points[word + i]);
        normal[i] = uintBitsToFloat(points[word + POINT_NORMAL + i]);
    }
    MapFrame frame = ldm_frames[points[word + POINT_MAP]];
    vec3 direction = frame.direction.xyz;
    float steepest_ws = ldm_steepest_drawn_ws(frame);
    sheets[point] = Sheet(floats(position), floats(half_side(frame.step_u.xyz, normal, direction, steepest_ws)),
                          floats(half_side(frame.step_v.xyz, normal, direction, steepest_ws)),
                          uintBitsToFloat(points[word + POINT_FACING]), uintBitsToFloat(points[word + POINT_DEPTH]),
                          points[word + POINT_LAYER], points[word + POINT_MAP]);
}
