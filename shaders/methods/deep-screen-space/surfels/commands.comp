// Draws of consecutive patches that the tessellator makes of, each, about as many points: those whose first point
// is one of the command's. At most POINTS_OF_DRAW, and what the last patch has beyond them.
layout(local_size_x = 64) in;

struct Command {
    uint vertices, instances, first_vertex, base_instance;
};
layout(std430, binding = 0) readonly buffer Points { uint points[]; };  // before each patch
layout(std430, binding = 1) readonly buffer PatchCount { uint patch_count; };
layout(std430, binding = 2) writeonly buffer Commands { Command commands[]; };
layout(std430, binding = 3) writeonly buffer WordCount { uint word_count; };

uniform uint command_count, capacity;

/// The first patch that has so many points before it.
uint patch_at(uint point) {
    uint first = 0u, end = min(patch_count, capacity);
    while (first < end) {
        uint middle = (first + end) / 2u;
        if (points[middle] < point)
            first = middle + 1u;
        else
            end = middle;
    }
    return first;
}

void main() {
    uint item = gl_GlobalInvocationID.x;
    if (item == 0u) word_count = patch_count;
    if (item >= command_count) return;
    uint first = patch_at(item * POINTS_OF_DRAW);
    commands[item] = Command(patch_at((item + 1u) * POINTS_OF_DRAW) - first, 1u, first, 0u);
}
