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
    uint sample_;
};
layout(std430) writeonly buffer Lines { LineToOccluder lines[]; };
layout(std430) buffer EndCount { uint end_count; };
layout(std430) buffer LineCount { uint line_count; };

uniform ivec2 picked;  // negative: none

void write_end(uint i, Point x, Sample s, vec3 sent, vec3 sky) {
    if (i < uint(ends.length()))
        ends[i] = SampleEnd(floats(s.end), s.role, distance(s.end, x.position), floats(sent), floats(sky), i);
}

void write_line(uint i, Point x, Sample s, vec3 sent) {
    if (i < uint(lines.length()))
        lines[i] = LineToOccluder(floats(x.position), floats(s.occluder), s.role, s.distance, floats(sent),
                                  int[2](s.pixel.x, s.pixel.y), i);
}

void main() {
    if (picked.x < 0) return;
    Point x = point_at(picked);
    if (!x.exists) return;
    uint all = uint(params.samples);
    if (gl_LocalInvocationID.x == 0u) end_count = line_count = all;
    for (uint i = gl_LocalInvocationID.x; i < all; i += 64u) {
        Sample s = sender_sample_of(x, int(i));
        vec3 sent = sent_by(x, s);
        write_end(i, x, s, sent, sky_of(x, sky_sample_of(x, int(i))));
        write_line(i, x, s, sent);
    }
}
