// Draws the picture of regions that sphere.comp made: coloured, with thin dark borders and centres as dots.
#include "lib/pixel_rays.glsl"
#include "passes/viewers/layer.glsl"
#include "passes/viewers/colour.glsl"
#include "passes/viewers/project.glsl"
#include "passes/viewers/shade.glsl"
#include "passes/viewers/sphere.glsl"

uniform usampler2D regions;
uniform int selected;  // element, or -1
uniform bool show_centres;
uniform float mean_region_px;  // pixels of the picture to a region
uniform int pixel_samples;     // samples along a side of a pixel

layout(location = 0) out vec4 out_colour;
layout(location = 1) out uvec2 out_id;

const vec3 no_region = vec3(0.27);
const float dot_px = 2.2;  // radius, in pixels

uint region_at(ivec2 pixel) {
    return texelFetch(regions, clamp(pixel, ivec2(0), ivec2(size_px) - 1), 0).r;
}

// Part of the neighbours at this distance whose region is another; beyond the sphere there is none.
float other_neighbours(ivec2 pixel, uint own, int distance_px) {
    float others = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 step = distance_px * ivec2(i < 2 ? 2 * i - 1 : 0, i < 2 ? 0 : 2 * i - 5);
        uint there = region_at(pixel + step);
        if (there != own && there != NOT_ON_SPHERE) others += 0.25;
    }
    return others;
}

// 1 on the selected region's inner edge, -1 just outside of it.
int selection_edge(ivec2 pixel, uint own) {
    uint wanted = uint(selected + 1);
    for (int y = -3; y <= 3; ++y)
        for (int x = -3; x <= 3; ++x) {
            if (x * x + y * y > 10) continue;
            bool is_wanted = region_at(pixel + pixel_samples * ivec2(x, y)) == wanted;
            if (own == wanted && !is_wanted) return 1;
            if (own != wanted && is_wanted && x * x + y * y <= 5) return -1;
        }
    return 0;
}

float centre_dot(uint element) {
    vec4 clip = clip_position(normalize(vector_at(element_base(element), layer.place[0])));
    vec2 ndc = clip.xy / clip.w;
    vec2 centre_px = (vec2(ndc.x, -ndc.y) * 0.5 + 0.5) * size_px;
    return 1.0 - smoothstep(dot_px - 0.5, dot_px + 0.5, distance(centre_px, gl_FragCoord.xy) / float(pixel_samples));
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    uint own = region_at(pixel);
    vec3 point;
    if (own == NOT_ON_SPHERE || !sphere_point(gl_FragCoord.xy, point)) discard;
    vec3 colour = own == 0u ? no_region : element_colour(element_base(own - 1u), point);
    // one colour for the whole sphere says nothing, and would shout
    if (own != 0u && layer.colour_mode == COLOUR_SINGLE) colour = mix(vec3(0.7), colour, 0.12);
    colour *= mix(0.6, 1.0, light_shade(point, point));
    // borders of regions of few pixels would leave nothing of their colours
    float border = min(1.0, 2.0 * other_neighbours(pixel, own, 1)) * smoothstep(20.0, 120.0, mean_region_px);
    colour = mix(colour, vec3(0.015), 0.85 * border);
    if (show_centres && own != 0u && mean_region_px > 60.0) colour = mix(colour, vec3(0.01), centre_dot(own - 1u));
    if (selected >= 0) {
        int edge = selection_edge(pixel, own);
        if (edge != 0) colour = vec3(edge > 0 ? 1.0 : 0.0);
    }
    vec4 clip = clip_position(point);
    gl_FragDepth = clamp(clip.z / clip.w, 0.0, 1.0);
    out_colour = vec4(colour, 1);
    out_id = own == 0u ? uvec2(0) : uvec2(layer.number, own - 1u);
}
