// Accessibility as grey, turned to blue where own entries are missing and to orange-red where light may leak: two
// colours that people with any kind of colour vision tell apart (Okabe and Ito's blue and vermilion).
layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D accessibility;
uniform sampler2D counts;  // own entry found, queried, missing, perhaps another's
uniform sampler2D gbuffer_geometric_normal;
layout(rgba16f) uniform writeonly image2D overlay;

const vec3 GREY = vec3(0.6), BLUE = vec3(0.0, 0.168, 0.445), VERMILION = vec3(0.665, 0.112, 0.0);  // linear

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(overlay)))) return;
    vec3 colour = vec3(0.0);
    if (texelFetch(gbuffer_geometric_normal, pixel, 0).xyz != vec3(0.0)) {
        vec4 count = texelFetch(counts, pixel, 0);
        vec2 part = clamp(2.0 * count.zw / max(count.y, 1.0), 0.0, 1.0);  // more than half hardly occurs
        vec3 tint = mix(mix(GREY, BLUE, part.x), VERMILION, part.y);
        colour = tint * (0.3 + 0.7 * texelFetch(accessibility, pixel, 0).x);
    }
    imageStore(overlay, pixel, vec4(colour, 1.0));
}
