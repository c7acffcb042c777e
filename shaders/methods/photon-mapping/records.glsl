// Records that the passes of photon mapping hand on. Declare the buffers where they are used.

#include "lib/spaces.glsl"

/// A point from which photons leave: where light arrived first, after the roulette there; or, before mirrors and glass,
/// a place on its ray. 48 bytes.
/// DEVIATION [Smal19 table 5.1]: the table has 32 bytes with normal (6 bytes), seed and padding. The material, from
/// where the light came and the texel are here, too, as the first scattering needs them.
// C++: ir::methods::photon_mapping::SamplePoint
struct SamplePoint {
    vec3 position_ws;
    uint power;    // RGB9E5, in power units: of each photon that leaves, roulette included
    uint normal;   // shading normal, on the side of the light; octahedral, 2 x 16 bits SNORM (packed_direction)
    uint geometric_normal;  // likewise
    uint arrived_from;      // unit direction to where the light came from, likewise
    uint seed;     // index in the emission set: what all random numbers of its paths come from
    uint surface;  // packUnorm4x8: base colour, roughness
    uint light;    // bits 0-5 light_name(); 6: photons leave along the ray; 7: light samples find the source; 16-31 metalness, UNORM
    float ior;     // index of refraction
    uint origin;   // bits 0-9 texel x, 10-19 texel y, 20-25 layer of the RSM; or NO_TEXEL: traced from the light
};

/// Depths of photons and of the picture's surfaces agree but for the surface's slope within a pixel.
// C++: ir::methods::photon_mapping::depth_tolerance
const float DEPTH_TOLERANCE = 0.01;

/// Of points whose light has no image.
// C++: ir::methods::photon_mapping::no_texel
const uint NO_TEXEL = 0xffffffffu;

/// A photon where it arrived. 32 bytes.  [Smal19 table 4.1]
// C++: ir::methods::photon_mapping::Photon
struct Photon {
    vec3 position_ws;
    uint power;        // RGB9E5, in power units
    uint normal;       // geometric, on the side that was hit; stereographic, packHalf2x16
    uint direction;    // from the surface to where the photon came from; stereographic, packHalf2x16
    float ray_length;  // m
    uint bits;         // 0: normal is below z = 0; 1: direction is; 2-5 bounce, from 1; 6-11 light_name();
                       // 12-31 low bits of the path's seed
};

/// Where photons come from: a layer of the RSM; behind these, what their first hits are traced from.
// C++: ir::methods::photon_mapping::SourceData
struct Source {
    vec3 origin_ws;     // the light's place; directional lights: the middle of the map's near plane
    float perspective;  // 1, or 0 for what is infinitely far
    vec3 direction_ws;  // of travel: the light's axis
    uint light;         // light_name() of renderers/methods/photon-mapping/emission/sources.h
    vec3 intensity;     // W/sr; W/m² of a directional light; W/(m² sr) of what has an extent
    float flux;         // W of all channels' mean within the layer, before the surface
    uint first_point, points;  // of the frame's emission sets: first_point up to first_point + points
    uint is_traced;     // 1 behind the layers of the RSM
    uint unused;
};

// C++: ir::methods::photon_mapping::leaves_along_ray
const uint LEAVES_ALONG_RAY = 64u;
// C++: ir::methods::photon_mapping::has_light_samples
const uint HAS_LIGHT_SAMPLES = 128u;

uint light_of(SamplePoint point) { return point.light & 63u; }
float metalness_of(SamplePoint point) { return float(point.light >> 16u) / 65535.0; }
uint packed_light(uint light, float metalness) {
    return light | uint(round(clamp(metalness, 0.0, 1.0) * 65535.0)) << 16u;
}

uint bounce_of(Photon photon) { return photon.bits >> 2u & 15u; }
uint light_of(Photon photon) { return photon.bits >> 6u & 63u; }

/// Shared exponent: 9-bit mantissas over 2^(e - 24), rounded to nearest; at most 65408, negative and NaN are
/// 0.  [OpenGL 4.5 §8.25]
uint packed_power(vec3 power) {
    vec3 c = clamp(power, vec3(0), vec3(65408.0));
    c = mix(c, vec3(0), isnan(power));
    float largest = max(c.r, max(c.g, c.b));
    if (largest <= 0.0) return 0u;
    int exponent;
    frexp(largest, exponent);  // largest = m 2^exponent, m in [1/2, 1)
    int shared_exponent = max(-16, exponent - 1) + 16;
    if (roundEven(ldexp(largest, 24 - shared_exponent)) >= 512.0) ++shared_exponent;
    uvec3 mantissa = uvec3(roundEven(ldexp(c, ivec3(24 - shared_exponent))));
    return mantissa.r | mantissa.g << 9u | mantissa.b << 18u | uint(shared_exponent) << 27u;
}

vec3 unpacked_power(uint bits) {
    vec3 mantissa = vec3(bits & 511u, bits >> 9u & 511u, bits >> 18u & 511u);
    return ldexp(mantissa, ivec3(int(bits >> 27u) - 24));
}

/// Stereographic from the pole of the other hemisphere; `below` is kept apart.
uint packed_stereographic(vec3 n, out bool below) {
    below = n.z < 0.0;
    return packHalf2x16(stereographic_from_direction(vec3(n.xy, abs(n.z))));
}
vec3 unpacked_stereographic(uint xy, bool below) {
    vec3 n = direction_from_stereographic(unpackHalf2x16(xy));
    return below ? vec3(n.xy, -n.z) : n;
}

vec3 normal_of(Photon photon) { return unpacked_stereographic(photon.normal, (photon.bits & 1u) != 0u); }
vec3 direction_of(Photon photon) { return unpacked_stereographic(photon.direction, (photon.bits & 2u) != 0u); }
