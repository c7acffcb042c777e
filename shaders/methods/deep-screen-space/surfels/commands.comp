// Draws of consecutive patches with about as many points each: all points that there is room for are divided among
// the commands, and a patch belongs to the one that has its first point.
layout(local_size_x = 64) in;

/// What the device reads of an indirect draw.
// C++: ir::methods::deep_screen_space::DrawCommand
struct Command {
    uint vertices, instances, first_vertex, base_instance;
};
layout(std430) readonly buffer Points { uint points[]; };  // before each patch
layout(std430) readonly buffer PatchCount { uint patch_count; };
layout(std430) writeonly buffer Commands { Command commands[]; };
layout(std430) writeonly buffer WordCount { uint word_count; };

layout(std430) readonly buffer FineCount { uint fine_count; };

uniform uint command_count;
uniform uint capacity, fine_capacity;  // of patches, of fine surfels

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
    uint share = (min(fine_count, fine_capacity) + command_count - 1u) / command_count;
    uint first = patch_at(item * share), end = patch_at((item + 1u) * share);
    commands[item] = Command(end - first, 1u, first, 0u);
}
