// The box of all that a tile of the picture shows.
layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D gbuffer_position;
layout(rgba32f) uniform writeonly image2D low;   // xyz; w: 1 where the tile shows anything
layout(rgba32f) uniform writeonly image2D high;

uniform int side;

void main() {
    ivec2 tile = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(tile, imageSize(low)))) return;
    ivec2 first = tile * side, end = min(first + side, textureSize(gbuffer_position, 0));
    vec3 least = vec3(3e38), most = vec3(-3e38);
    float any_seen = 0.0;
    for (int y = first.y; y < end.y; ++y)
        for (int x = first.x; x < end.x; ++x) {
            vec4 p = texelFetch(gbuffer_position, ivec2(x, y), 0);
            if (p.w <= 0.0) continue;
            least = min(least, p.xyz);
            most = max(most, p.xyz);
            any_seen = 1.0;
        }
    imageStore(low, tile, vec4(any_seen > 0.0 ? least : vec3(0.0), any_seen));
    imageStore(high, tile, vec4(any_seen > 0.0 ? most : vec3(0.0), any_seen));
}
