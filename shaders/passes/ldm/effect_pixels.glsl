// The pixels that show what each direction does to the picture: a grid of them, or the one that is picked.

uniform sampler2D gbuffer_position;
uniform sampler2D gbuffer_normal;
uniform sampler2D gbuffer_geometric_normal;

uniform ivec2 first_pixel;  // negative: none
uniform ivec2 cells;        // of the grid
uniform int pixel_step;

uint pixel_count() { return uint(cells.x * cells.y); }

struct EffectSurface {
    bool exists;
    vec3 position, normal, geometric_normal;
};

ivec2 pixel_of(uint number) {
    ivec2 cell = ivec2(number % uint(cells.x), number / uint(cells.x));
    return min(first_pixel + pixel_step * cell, textureSize(gbuffer_geometric_normal, 0) - 1);
}

EffectSurface surface_of(uint number) {
    if (first_pixel.x < 0) return EffectSurface(false, vec3(0.0), vec3(0.0), vec3(0.0));
    ivec2 pixel = pixel_of(number);
    vec3 geometric_normal = texelFetch(gbuffer_geometric_normal, pixel, 0).xyz;
    return EffectSurface(geometric_normal != vec3(0.0), texelFetch(gbuffer_position, pixel, 0).xyz,
                         normalize(texelFetch(gbuffer_normal, pixel, 0).xyz), geometric_normal);
}
