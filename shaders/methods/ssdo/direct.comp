// Direct light of lights and, with SKY, of the environment: as it is seen, and as it is sent on.
layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D direct_image;
uniform sampler2D sky_image;
uniform sampler2D gbuffer_material;
layout(rgba32f) uniform writeonly image2D seen;
layout(rgba32f) uniform writeonly image2D sent;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(seen)))) return;
    vec3 light = texelFetch(direct_image, pixel, 0).rgb;
#ifdef SKY
    light += texelFetch(sky_image, pixel, 0).rgb;
#endif
    bool is_unlit = texelFetch(gbuffer_material, pixel, 0).z > 0.5;
    imageStore(seen, pixel, vec4(light, 1.0));
    imageStore(sent, pixel, vec4(is_unlit ? vec3(0.0) : light, 1.0));
}
