// Sorts photons into bins, squares of BIN pixels, so that each bin's list is in the order of the photons on every
// device: the photons are cut into COLUMNS equal parts, one invocation goes through one part in order, and no
// other writes to its column of counts. What includes this has `uint stored`, and seen_pixels().

layout(local_size_x = 64) in;

uniform uint first_of_column, end_of_column;  // which photons of each column
uniform uint bins_across;

void visit(uint slot, uint photon);

void visit_bins(uint column, uint i) {
    uvec4 pixels;  // first and last
    if (!seen_pixels(i, pixels)) return;
    uvec4 bins = pixels / BIN;
    for (uint y = bins.y; y <= bins.w; ++y)
        for (uint x = bins.x; x <= bins.z; ++x) visit((y * bins_across + x) * COLUMNS + column, i);
}

void main() {
    uint column = gl_GlobalInvocationID.x, per_column = (stored + COLUMNS - 1u) / COLUMNS;
    if (column >= COLUMNS) return;
    uint first = column * per_column;
    for (uint k = first_of_column; k < min(end_of_column, per_column); ++k)
        if (first + k < stored) visit_bins(column, first + k);
}
