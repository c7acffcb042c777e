// Light from infinity: passes::EnvironmentLight (renderers/passes/lights/environment_light.h).
#include "lib/constants.glsl"
#include "lib/spaces.glsl"
#include "passes/lights/sources.glsl"

uniform sampler2D environment_map;      // radiance, W/(m² sr)
uniform sampler2D environment_columns;  // cumulative distribution over each row's texels, after each
/// Cumulative distribution over the rows (height + 1), cosines to +Y of their edges (height + 1), and the edges'
/// differences (height).
layout(std430) readonly buffer EnvironmentRows { float environment_rows[]; };

/// Where a direction lies in an equirectangular map, (0, 0) its upper left corner.
vec2 equirectangular_uv(vec3 direction_ws) {
    float u = atan(-direction_ws.z, -direction_ws.x) / (2.0 * PI);
    float horizontal = length(direction_ws.xz);  // acos is coarse at the poles
    return vec2(u < 0.0 ? u + 1.0 : u, atan(horizontal, direction_ws.y) / PI);
}
/// The unit direction at the horizontal coordinate u with this cosine to +Y.
vec3 equirectangular_direction(float u, float cos_theta) {
    float sin_theta = sqrt(max((1.0 - cos_theta) * (1.0 + cos_theta), 0.0)), phi = 2.0 * PI * u;
    return vec3(-cos(phi) * sin_theta, cos_theta, -sin(phi) * sin_theta);
}

bool has_map(SourceTotals sources) { return sources.map_width > 0; }

/// Columns go round; rows beyond a pole continue on its other side.
vec3 environment_texel(SourceTotals sources, int x, int y) {
    if (y < 0 || y >= sources.map_height) {
        y = clamp(y, 0, sources.map_height - 1);
        x += sources.map_width / 2;
    }
    x = (x + sources.map_width) % sources.map_width;
    return texelFetch(environment_map, ivec2(x, y), 0).rgb;
}

vec3 environment_radiance(SourceTotals sources, vec3 direction_ws) {
    if (!has_map(sources)) return sources.sky;
    vec2 p = equirectangular_uv(direction_ws) * vec2(sources.map_width, sources.map_height) - 0.5;
    vec2 corner = floor(p), f = p - corner;
    int x = int(corner.x), y = int(corner.y);
    return mix(mix(environment_texel(sources, x, y), environment_texel(sources, x + 1, y), f.x),
               mix(environment_texel(sources, x, y + 1), environment_texel(sources, x + 1, y + 1), f.x), f.y);
}

float column_below(int x, int y) { return x > 0 ? texelFetch(environment_columns, ivec2(x - 1, y), 0).r : 0.0; }

float texel_pdf(SourceTotals sources, int x, int y) {
    float row = environment_rows[y + 1] - environment_rows[y], column = column_below(x + 1, y) - column_below(x, y);
    float height = environment_rows[2 * (sources.map_height + 1) + y];
    return row * column / (2.0 * PI / float(sources.map_width) * height);
}

float pdf_of_sky(SourceTotals sources, vec3 normal_ws, vec3 direction_ws) {
    if (!has_map(sources)) return max(dot(normal_ws, direction_ws), 0.0) / PI;
    vec2 uv = equirectangular_uv(direction_ws);
    ivec2 size = ivec2(sources.map_width, sources.map_height);
    ivec2 texel = clamp(ivec2(uv * vec2(size)), ivec2(0), size - 1);
    return texel_pdf(sources, texel.x, texel.y);
}

vec3 cosine_on_hemisphere(vec3 normal_ws, vec2 u) {
    float radius = sqrt(u.y), phi = 2.0 * PI * u.x;
    return normalize(frame_around(normal_ws) * vec3(radius * cos(phi), radius * sin(phi), sqrt(1.0 - u.y)));
}

/// Of an item with cumulative distribution from `low` to `high`.
float rest_of(float u, float low, float high) { return clamp((u - low) / (high - low), 0.0, 0.99999994); }

/// A direction by u in [0, 1)². Constant: by the cosine to the normal. Map: each texel by its light, uniformly within
/// in solid angle; the density is that of the texel drawn, since built-in functions that look directions up may be
/// off by enough to find its neighbour.
LightSample sample_sky(SourceTotals sources, vec3 normal_ws, vec2 u) {
    LightSample s = NO_LIGHT_SAMPLE;
    s.distance = uintBitsToFloat(0x7f800000u);
    if (!has_map(sources)) {
        s.direction_ws = cosine_on_hemisphere(normal_ws, u);
        s.pdf = pdf_of_sky(sources, normal_ws, s.direction_ws);
    } else {
        int row = 0, column = 0;
        for (int end = sources.map_height; end - row > 1;) {
            int middle = (row + end) / 2;
            if (environment_rows[middle] <= u.y) row = middle;
            else end = middle;
        }
        for (int end = sources.map_width; end - column > 1;) {
            int middle = (column + end) / 2;
            if (column_below(middle, row) <= u.x) column = middle;
            else end = middle;
        }
        float across = rest_of(u.x, column_below(column, row), column_below(column + 1, row));
        float down = rest_of(u.y, environment_rows[row], environment_rows[row + 1]);
        int edges = sources.map_height + 1;
        float cos_theta = environment_rows[edges + row] - down * environment_rows[2 * edges + row];
        s.direction_ws = equirectangular_direction((float(column) + across) / float(sources.map_width), cos_theta);
        s.pdf = texel_pdf(sources, column, row);
    }
    s.radiance = environment_radiance(sources, s.direction_ws);
    return s;
}
