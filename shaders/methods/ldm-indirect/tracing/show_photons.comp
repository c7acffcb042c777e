// Stored photons as glyphs, with their legs told apart.
layout(local_size_x = 64) in;
#include "lib/floats.glsl"
#include "lib/luminance.glsl"
#include "lib/spaces.glsl"
#include "methods/ldm-indirect/records.glsl"

layout(std430) readonly buffer Photons { Photon photons[]; };
layout(std430) readonly buffer StoredCount { uint stored_count; };
// C++: ir::methods::ldm_indirect::ShownPhoton
struct ShownPhoton {
    float centre[3], axis_u[3], axis_v[3], normal[3], flux[3];
    float luminance, path_length;
    uint map;
    int side;
    uint light, direct, source;
};
layout(std430) writeonly buffer AllShown { ShownPhoton shown[]; };
layout(std430) buffer ShownCount { uint shown_count; };

uniform uint first_item, end_item, capacity, shown_capacity;

void main() {
    uint index = first_item + gl_GlobalInvocationID.x;
    if (index == 0u) shown_count = stored_count;
    if (index >= min(end_item, min(stored_count, capacity)) || index >= shown_capacity) return;
    Photon p = photons[index];
    shown[index] = ShownPhoton(floats(p.centre_ws), floats(p.axis_u), floats(p.axis_v),
                               floats(unpacked_direction(p.normal)), floats(p.flux),
                               luminance(p.flux), p.path_length, p.leg & LEG_MAP,
                               (p.leg & LEG_ALONG) != 0u ? 1 : -1, p.leg >> LEG_LIGHT_SHIFT,
                               uint((p.leg & LEG_DIRECT) != 0u), p.source);
}
