// From counts of directions to parts of the directions that were queried.
layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D counts;  // own entry found, queried, missing, perhaps another's
layout(r32f) uniform writeonly image2D found;
layout(r32f) uniform writeonly image2D missing;
layout(r32f) uniform writeonly image2D suspect;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(found)))) return;
    vec4 count = texelFetch(counts, pixel, 0);
    float scale = count.y > 0.0 ? 1.0 / count.y : 0.0;
    imageStore(found, pixel, vec4(count.x * scale));
    imageStore(missing, pixel, vec4(count.z * scale));
    imageStore(suspect, pixel, vec4(count.w * scale));
}
