// One level of the pyramid of positions' bounds. Sides are halved and rounded down, as mip levels are: the last
// texel of an odd row also covers what would be left over.
layout(local_size_x = 8, local_size_y = 8) in;

#ifdef FIRST
uniform sampler2D gbuffer_position;
#else
layout(rgba32f) uniform readonly image2D finer_min;
layout(rgba32f) uniform readonly image2D finer_max;
#endif
uniform writeonly image2D min_image;
uniform writeonly image2D max_image;

const vec4 NOTHING = vec4(3e38);

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy), size = imageSize(min_image);
    if (any(greaterThanEqual(texel, size))) return;
    vec4 least = NOTHING, most = -NOTHING;
#ifdef FIRST
    vec4 position = texelFetch(gbuffer_position, texel, 0);
    if (position.w > 0.0) least = most = vec4(position.xyz, 1);
#else
    ivec2 finer_size = imageSize(finer_min);
    ivec2 begin = 2 * texel;
    ivec2 end = mix(min(begin + 2, finer_size), finer_size, equal(texel, size - 1));
    for (int y = begin.y; y < end.y; ++y)
        for (int x = begin.x; x < end.x; ++x) {
            least = min(least, imageLoad(finer_min, ivec2(x, y)));
            most = max(most, imageLoad(finer_max, ivec2(x, y)));
        }
#endif
    imageStore(min_image, texel, vec4(least.xyz, 1));
    imageStore(max_image, texel, vec4(most.xyz, 1));
}
