// Divides what rays add to the picked pixel by the shares of all, so that together they are the pixel.
layout(local_size_x = 256) in;

#include "passes/bounce/ray_line.glsl"

layout(std430) buffer OwnLines { Line own_lines[]; };
layout(std430) buffer OwnCount { uint own_count; };
layout(std430) buffer OtherLines { Line other_lines[]; };
layout(std430) buffer OtherCount { uint other_count; };
layout(std430) readonly buffer Shares { float shares; };

void main() {
    if (shares == 0.0) return;
    uint own = min(own_count, uint(own_lines.length())), others = min(other_count, uint(other_lines.length()));
    for (uint i = gl_LocalInvocationIndex; i < own; i += 256u)
        for (int c = 0; c < CHANNELS; ++c) own_lines[i].contribution[c] /= shares;
    for (uint i = gl_LocalInvocationIndex; i < others; i += 256u)
        for (int c = 0; c < CHANNELS; ++c) other_lines[i].contribution[c] /= shares;
}
