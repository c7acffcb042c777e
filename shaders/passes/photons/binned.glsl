// Reads what fill_bins.glsl wrote.

layout(std430) readonly buffer Places { uint places[]; };
layout(std430) readonly buffer Lists { uint lists[]; };

uniform uint bins_across;
uniform uint round_first, round_size;  // entries of each list

/// Of the bin of a pixel: the round's first entry in `lists`, and the end.
uvec2 entries_of(uvec2 pixel) {
    uint bin = pixel.y / BIN * bins_across + pixel.x / BIN;
    uint begin = (bin == 0u ? 0u : places[bin * COLUMNS - 1u]) + round_first;
    uint end = min(places[bin * COLUMNS + COLUMNS - 1u], uint(lists.length()));
    return uvec2(begin, min(end, begin + round_size));
}
