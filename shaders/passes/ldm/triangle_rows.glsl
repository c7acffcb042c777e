// Triangles in the maps of a chunk, for the compute rasterisers.
#include "passes/ldm/triangle.glsl"

/// u, v and depth of the frames of the chunk's maps. Software drivers load uniforms several times as fast as
/// buffers.
uniform vec4 frame_rows[3 * 32];

/// As ldm_texel_quanta(), of a map of the chunk.
float texel_quanta_of(uint map) {
    return length(frame_rows[3u * map + 2u].xyz) /
           min(length(frame_rows[3u * map].xyz), length(frame_rows[3u * map + 1u].xyz));
}

MapTriangle projected(vec3 a, vec3 b, vec3 c, uint map) {
    return projected(a, b, c, frame_rows[3u * map], frame_rows[3u * map + 1u], frame_rows[3u * map + 2u]);
}
