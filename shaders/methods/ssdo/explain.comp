// Takes the samples of the pixel that a person points at once more, and writes what became of each. One work group.
layout(local_size_x = 64) in;
#include "lib/floats.glsl"
#include "methods/ssdo/samples.glsl"

// C++: ir::methods::ssdo::SampleEnd
struct SampleEnd {
    float position[3];
    uint role;
    float step, sent[3], sky[3];
    uint sample_;
};
layout(std430) writeonly buffer Ends { SampleEnd ends[]; };
// C++: ir::methods::ssdo::LineToOccluder
struct LineToOccluder {
    float start[3], end[3];
    uint role;
    float distance, sent[3];
    int pixel[2];
    uint sample_, layer;
};
layout(std430) writeonly buffer Lines { LineToOccluder lines[]; };
layout(std430) buffer EndCount { uint end_count; };
layout(std430) buffer LineCount { uint line_count; };

uniform ivec2 picked;  // negative: none

void write_end(uint i, Point x, Sample s, vec3 sent, vec3 sky) {
    uint role = s.is_outside ? OUTSIDE : OPEN;
    if (s.is_occluded) role = occluder_of(x, s, s.layers - 1).role;
    for (int layer = 0; layer < s.layers; ++layer)
        if (sends(s, occluder_of(x, s, layer))) role = SENDS;
    if (i < uint(ends.length()))
        ends[i] = SampleEnd(floats(s.end), role, distance(s.end, x.position), floats(sent), floats(sky), i);
}

/// To a layer before the step's end, or along the step.
void write_line(uint i, Point x, Sample s, int layer) {
    uint line = i * uint(LAYERS) + uint(layer);
    if (line >= uint(lines.length())) return;
    Occluder o = Occluder(s.is_outside ? OUTSIDE : OPEN, s.end, vec3(0.0), s.direction, 0.0, 0.0, layer);
    if (layer < s.layers) o = occluder_of(x, s, layer);
    if (o.role == SENDS && !sends(s, o)) o.role = OPEN;  // passed, as published
    lines[line] = LineToOccluder(floats(x.position), floats(o.position), o.role, o.distance,
                                 floats(sent_by_layer(x, s, o)), int[2](s.pixel.x, s.pixel.y), i, uint(layer) + 1u);
}

void main() {
    if (picked.x < 0) return;
    Point x = point_at(picked);
    if (!x.exists) return;
    uint all = uint(params.samples);
    if (gl_LocalInvocationID.x == 0u) {
        end_count = all;
        line_count = all * uint(LAYERS);
    }
    for (uint i = gl_LocalInvocationID.x; i < all; i += 64u) {
        Sample s = sender_sample_of(x, int(i));
        write_end(i, x, s, sent_by(x, s).rgb, sky_of(x, sky_sample_of(x, int(i))));
        for (int layer = 0; layer < LAYERS; ++layer) write_line(i, x, s, layer);
    }
}
