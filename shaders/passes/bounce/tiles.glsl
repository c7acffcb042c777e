// A dispatch's share of the picture: tiles of 8 × 8 pixels, numbered by rows.
// renderers/passes/bounce/tiles.h sets the uniforms.
layout(local_size_x = 8, local_size_y = 8) in;

uniform int first_tile, tiles_across;

ivec2 tile_pixel() {
    int tile = first_tile + int(gl_WorkGroupID.x);
    return 8 * ivec2(tile % tiles_across, tile / tiles_across) + ivec2(gl_LocalInvocationID.xy);
}
