// Adds the blocks up, and the numbers of photons to counters.
layout(local_size_x = 32) in;
#include "lib/floats.glsl"
#include "methods/ldm-indirect/tracing/energy.glsl"

layout(std430) readonly buffer Blocks { Row blocks[]; };
layout(std430) writeonly buffer Table { Row table[]; };
layout(std430) buffer EmittedCounter { uint emitted_counter; };
layout(std430) buffer BelowCounter { uint below_counter; };
layout(std430) buffer LeftCounter { uint left_counter; };
layout(std430) buffer OutsideCounter { uint outside_counter; };
layout(std430) buffer HiddenCounter { uint hidden_counter; };
layout(std430) buffer BackCounter { uint back_counter; };
layout(std430) buffer DegenerateCounter { uint degenerate_counter; };

uniform uint block_count;

void main() {
    uint row = gl_GlobalInvocationID.x;
    if (row >= ENERGY_ROWS) return;
    precise vec3 sum = vec3(0), lost = vec3(0);  // compensated summation
    uint photons = 0u;
    for (uint block = 0u; block < block_count; ++block) {
        Row one = blocks[block * ENERGY_ROWS + row];
        precise vec3 next = vec3(one.flux[0], one.flux[1], one.flux[2]) - lost;
        precise vec3 total = sum + next;
        lost = (total - sum) - next;
        sum = total;
        photons += one.photons;
    }
    Row first = blocks[row];
    table[row] = Row(first.cause, first.leg, photons, floats(sum));
    uint cause = row - ROW_INDIRECT;
    if (row == ROW_EMITTED) atomicAdd(emitted_counter, photons);
    if (row == ROW_DEGENERATE) atomicAdd(degenerate_counter, photons);
    if (row < ROW_INDIRECT || row >= ROW_DIRECT) return;
    if (cause == 0u) atomicAdd(below_counter, photons);
    if (cause == 1u) atomicAdd(left_counter, photons);
    if (cause == 2u) atomicAdd(outside_counter, photons);
    if (cause == 3u) atomicAdd(hidden_counter, photons);
    if (cause == 4u) atomicAdd(back_counter, photons);
    if (cause == 5u) atomicAdd(degenerate_counter, photons);
}
