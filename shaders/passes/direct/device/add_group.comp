// Adds the mean of a group of samples to the sums of a band's pixels; after the last one the light, its variance, and
// what is filtered: passes::LightSampling (renderers/passes/direct/extended_light.cpp).
layout(local_size_x = 64) in;

#include "lib/luminance.glsl"
#include "passes/direct/device/seen_surface.glsl"

layout(std430) buffer GroupLight { vec4 group_light[]; };
/// How many groups each pixel has, and which frame was the last that added some.
layout(std430) readonly buffer ProgressBefore { uvec2 progress_before[]; };
layout(std430) writeonly buffer Progress { uvec2 progress[]; };

uniform sampler2D sums_before;
layout(rgba32f) uniform image2D sums;
layout(rgba32f) uniform writeonly image2D unfiltered_image;
layout(r32f) uniform writeonly image2D variance_image;
layout(rgba32f) uniform writeonly image2D even_image;
layout(rgba16f) uniform writeonly image2D reflectance_image;

uniform uint group, groups, samples_of_group;
uniform uint frame;
uniform bool stands_still;
uniform float min_reflectance;

/// A frame in which nothing wanted the light leaves a gap.
bool continues() { return stands_still && progress_before[0].y + 1u == frame; }

void main() {
    uint place = gl_GlobalInvocationID.x;
    ivec2 pixel;
    if (!pixel_of(place, pixel)) return;
    vec4 sum = group > 0u ? imageLoad(sums, pixel) : continues() ? texelFetch(sums_before, pixel, 0) : vec4(0);
    vec3 mean = group_light[place].rgb / float(samples_of_group);
    float l = luminance(mean);
    sum += vec4(mean, l * l);
    imageStore(sums, pixel, sum);
    group_light[place] = vec4(0);
    if (group + 1u < groups) return;

    uint all = groups + (continues() ? progress_before[0].x : 0u);
    if (first_pixel + place == 0u) progress[0] = uvec2(all, frame);
    float count = float(all);
    mean = sum.rgb / count;
    l = luminance(mean);
    float variance = all > 1u ? max(sum.a / count - l * l, 0.0) / (count - 1.0) : l * l;
    SeenSurface surface = seen_surface(pixel);
    vec3 reflectance = surface.exists ? albedo_of(surface.scatterer, surface.glass) : vec3(0);
    vec3 divisor = max(reflectance, min_reflectance);
    l = luminance(divisor);
    imageStore(unfiltered_image, pixel, vec4(mean, 1));
    imageStore(variance_image, pixel, vec4(variance));
    imageStore(even_image, pixel, vec4(mean / divisor, variance / (l * l)));
    imageStore(reflectance_image, pixel, vec4(divisor, 0));
}
