// Reads what fill_bins.glsl wrote: work groups sum tiles, in rounds of their bins' lists. ir::passes::gather_tiles()
// runs what includes this.

/// Pixels along a side of a tile.
// C++: ir::passes::gathered_tile
const uint GATHERED_TILE = 16u;

layout(std430) readonly buffer Places { uint places[]; };
layout(std430) readonly buffer Lists { uint lists[]; };

uniform uint bins_across, tiles_across, first_tile;
uniform uint round_first, round_size;  // entries of each list

/// First pixel of the work group's tile.
uvec2 corner_of_tile() {
    uint tile = first_tile + gl_WorkGroupID.x;
    return uvec2(tile % tiles_across, tile / tiles_across) * GATHERED_TILE;
}

/// Of the bin of a pixel: the round's first entry in `lists`, and the end.
uvec2 entries_of(uvec2 pixel) {
    uint bin = pixel.y / BIN * bins_across + pixel.x / BIN;
    uint begin = (bin == 0u ? 0u : places[bin * COLUMNS - 1u]) + round_first;
    uint end = min(places[bin * COLUMNS + COLUMNS - 1u], uint(lists.length()));
    return uvec2(begin, min(end, begin + round_size));
}
