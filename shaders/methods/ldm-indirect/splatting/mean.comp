// The mean over the frames so far.
layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D irradiance_now;
uniform sampler2D direction_now;
uniform sampler2D irradiance_before;
uniform sampler2D direction_before;  // a: frames in the mean
layout(rgba32f) uniform writeonly image2D irradiance;
layout(rgba32f) uniform writeonly image2D direction;

uniform bool continues;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(irradiance)))) return;
    vec4 e = texelFetch(irradiance_now, pixel, 0), d = vec4(texelFetch(direction_now, pixel, 0).xyz, 1);
    if (continues) {
        vec4 e_before = texelFetch(irradiance_before, pixel, 0), d_before = texelFetch(direction_before, pixel, 0);
        float frames = d_before.a + 1.0;
        e = e_before + (e - e_before) / frames;
        d = vec4(d_before.xyz + (d.xyz - d_before.xyz) / frames, frames);
    }
    imageStore(irradiance, pixel, e);
    imageStore(direction, pixel, d);
}
