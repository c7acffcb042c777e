// Records that the passes of photon mapping hand on, as renderers/methods/photon-mapping/records.h describes
// them. Declare the buffers where they are used.

#include "lib/spaces.glsl"

/// A point from which photons leave: where light arrived first, after the roulette there. 32 bytes.
/// DEVIATION [Smal19 table 5.1]: the table has normal (6 bytes), seed and padding; the material and the texel take
/// their place, as the first scattering needs them.
// C++: ir::methods::photon_mapping::SamplePoint
struct SamplePoint {
    vec3 position_ws;
    uint power;    // RGB9E5, in power units: of each photon that leaves, roulette included
    uint normal;   // shading normal, on the side of the light; octahedral, 2 x 16 bits SNORM (packed_direction)
    uint surface;  // packUnorm4x8: base colour, roughness
    uint origin;   // bits 0-9 texel x, 10-19 texel y, 20-25 layer of the RSM, 26-31 metalness in 63rds
    uint seed;     // index in the emission set: what all random numbers of its paths come from
};

/// A photon where it arrived. 32 bytes.  [Smal19 table 4.1]
// C++: ir::methods::photon_mapping::Photon
struct Photon {
    vec3 position_ws;
    uint power;        // RGB9E5, in power units
    uint normal;       // geometric, on the side that was hit; stereographic, packHalf2x16
    uint direction;    // from the surface to where the photon came from; stereographic, packHalf2x16
    float ray_length;  // m
    uint bits;         // 0: normal is below z = 0; 1: direction is; 2-5 bounce, from 1; 6-11 light;
                       // 12-31 low bits of the path's seed
};

/// Where photons come from: a layer of the RSM, or a light whose rays are traced.
// C++: ir::methods::photon_mapping::SourceData
struct Source {
    vec3 origin_ws;     // the light's place; directional lights: the middle of the map's near plane
    float perspective;  // 1, or 0 for a directional light
    vec3 direction_ws;  // of travel: the light's axis
    uint light;         // index into "scene.lights"
    vec3 intensity;     // W/sr, or W/m² of a directional light
    float flux;         // W of all channels' mean within the layer, before the surface
    uint first_point, points;  // of the emission set, found on the device: first_point up to first_point + points
    uint unused[2];
};

uint source_of(SamplePoint point) { return point.origin >> 20u & 63u; }
float metalness_of(SamplePoint point) { return float(point.origin >> 26u) / 63.0; }

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
