// Takes the samples of the pixel that a person points at once more, and writes what became of each. One work group.
layout(local_size_x = 64) in;
#include "methods/ssdo/samples.glsl"

/// position 3, role, step, sent 3, sky 3, sample
layout(std430) writeonly buffer Ends { uint ends[]; };
/// start 3, end 3, role, distance, sent 3, pixel 2, sample
layout(std430) writeonly buffer Lines { uint lines[]; };
layout(std430) buffer EndCount { uint end_count; };
layout(std430) buffer LineCount { uint line_count; };

uniform ivec2 picked;  // negative: none

const uint END_WORDS = 12u, LINE_WORDS = 14u;

void write_end(uint i, Point x, Sample s, vec3 sent, vec3 sky) {
    uint word = END_WORDS * i;
    if (word + END_WORDS > uint(ends.length())) return;
    for (uint k = 0u; k < 3u; ++k) {
        ends[word + k] = floatBitsToUint(s.end[k]);
        ends[word + 5u + k] = floatBitsToUint(sent[k]);
        ends[word + 8u + k] = floatBitsToUint(sky[k]);
    }
    ends[word + 3u] = s.role;
    ends[word + 4u] = floatBitsToUint(distance(s.end, x.position));
    ends[word + 11u] = i;
}

void write_line(uint i, Point x, Sample s, vec3 sent) {
    uint word = LINE_WORDS * i;
    if (word + LINE_WORDS > uint(lines.length())) return;
    for (uint k = 0u; k < 3u; ++k) {
        lines[word + k] = floatBitsToUint(x.position[k]);
        lines[word + 3u + k] = floatBitsToUint(s.occluder[k]);
        lines[word + 8u + k] = floatBitsToUint(sent[k]);
    }
    lines[word + 6u] = s.role;
    lines[word + 7u] = floatBitsToUint(s.distance);
    lines[word + 11u] = uint(s.pixel.x);
    lines[word + 12u] = uint(s.pixel.y);
    lines[word + 13u] = i;
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
