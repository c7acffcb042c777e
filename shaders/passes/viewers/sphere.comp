// The region of the sphere at each pixel: the first whose bounds contain the direction, or, without bounds,
// that of the nearest centre. A tile of pixels first sorts out the elements that none of it can see.
#include "lib/constants.glsl"
#include "lib/pixel_rays.glsl"
#include "passes/viewers/layer.glsl"
#include "passes/viewers/sphere.glsl"

layout(local_size_x = 16, local_size_y = 16) in;
layout(r32ui) writeonly uniform uimage2D regions;

uniform ivec2 picture_size;

const uint chunk = 256u;

shared uint nearest_to_middle;    // distance² in the upper bits, invocation in the lower eight
shared vec3 axis;                 // a direction in the tile
shared uint reach_bits;           // longest chord from the axis to a direction of the tile
shared uint bound_bits;           // shortest chord from the axis to a centre
shared uint colatitude_low, colatitude_high;  // of the tile, as bits (not negative)
shared uint longitude_low, longitude_high;    // relative to the axis, plus pi, as bits
shared uint candidates[chunk];
shared uint candidate_count;

float longitude_of(vec3 d) { return atan(d.z, d.x); }
// Drivers' acos may be off by 1e-4, their atan is not.
float colatitude_of(vec3 d) { return atan(length(d.xz), d.y); }
// In [0, 2 pi).
float wrapped(float angle) { return angle - 2.0 * PI * floor(angle / (2.0 * PI)); }

bool has_bounds() { return layer.colatitude >= 0; }

bool usable(uint base) {
    return is_finite(vector_at(base, layer.place[0])) && (!has_bounds() || passes_filters(base));
}

bool contains(uint base, vec3 d) {
    float colatitude = colatitude_of(d);
    if (!(colatitude >= float_at(base, layer.colatitude) && colatitude <= float_at(base, layer.colatitude + 1)))
        return false;
    float from = float_at(base, layer.longitude), to = float_at(base, layer.longitude + 1);
    return wrapped(longitude_of(d) - from) <= to - from;
}

bool may_reach_tile(uint base) {
    if (!has_bounds())
        return distance(vector_at(base, layer.place[0]), axis) <=
               uintBitsToFloat(bound_bits) + 2.0 * uintBitsToFloat(reach_bits) + 1e-5;
    float margin = 1e-5;
    if (float_at(base, layer.colatitude) > uintBitsToFloat(colatitude_high) + margin ||
        float_at(base, layer.colatitude + 1) < uintBitsToFloat(colatitude_low) - margin)
        return false;
    float a = longitude_of(axis) - PI + uintBitsToFloat(longitude_low) - margin,
          b = longitude_of(axis) - PI + uintBitsToFloat(longitude_high) + margin;
    float from = float_at(base, layer.longitude), to = float_at(base, layer.longitude + 1);
    // brings the region's beginning to within a turn after a, and to within a turn before it
    float begin = a + wrapped(from - a);
    return begin <= b || begin - 2.0 * PI + (to - from) >= a;
}

void begin_tile(bool on_sphere, vec3 d) {
    uint me = gl_LocalInvocationIndex;
    if (me == 0u) {
        nearest_to_middle = 0xffffffffu;
        reach_bits = colatitude_high = longitude_high = 0u;
        bound_bits = colatitude_low = longitude_low = 0x7f7fffffu;
    }
    barrier();
    ivec2 from_middle = 2 * ivec2(gl_LocalInvocationID.xy) - 15;
    if (on_sphere) atomicMin(nearest_to_middle, uint(from_middle.x * from_middle.x + from_middle.y * from_middle.y) << 8 | me);
    barrier();
    if (on_sphere && (nearest_to_middle & 255u) == me) axis = d;
    barrier();
    if (!on_sphere) return;
    atomicMax(reach_bits, floatBitsToUint(distance(d, axis)));
    float colatitude = colatitude_of(d), longitude = wrapped(longitude_of(d) - longitude_of(axis) + PI);
    atomicMin(colatitude_low, floatBitsToUint(colatitude));
    atomicMax(colatitude_high, floatBitsToUint(colatitude));
    atomicMin(longitude_low, floatBitsToUint(longitude));
    atomicMax(longitude_high, floatBitsToUint(longitude));
}

// The chord from the axis to the nearest centre.
void find_bound() {
    float bound = uintBitsToFloat(0x7f7fffffu);
    for (uint i = gl_LocalInvocationIndex; i < layer.drawn; i += chunk) {
        uint base = element_base(i * layer.step);
        if (usable(base)) bound = min(bound, distance(vector_at(base, layer.place[0]), axis));
    }
    atomicMin(bound_bits, floatBitsToUint(bound));
}

// The element of the first `count` candidates that holds direction d; replaces the best so far.
void look_through(uint count, vec3 d, inout uint best, inout float best_distance) {
    for (uint k = 0u; k < count; ++k) {
        uint i = candidates[k];
        uint base = element_base(i);
        if (has_bounds()) {
            if (i < best && contains(base, d)) best = i;
        } else {
            float from_centre = distance(vector_at(base, layer.place[0]), d);
            if (from_centre < best_distance || (from_centre == best_distance && i < best)) {
                best = i;
                best_distance = from_centre;
            }
        }
    }
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    vec3 d;
    bool on_sphere = sphere_point(vec2(pixel) + 0.5, d) && all(lessThan(pixel, picture_size));
    begin_tile(on_sphere, d);
    barrier();
    bool any = nearest_to_middle != 0xffffffffu;
    if (any && !has_bounds()) find_bound();
    const uint none = 0xfffffffeu;
    uint best = none;
    float best_distance = uintBitsToFloat(0x7f7fffffu);
    uint chunks = any ? (layer.drawn + chunk - 1u) / chunk : 0u;
    for (uint c = 0u; c < chunks; ++c) {
        if (gl_LocalInvocationIndex == 0u) candidate_count = 0u;
        barrier();
        uint i = c * chunk + gl_LocalInvocationIndex;
        uint base = element_base(min(i, layer.drawn - 1u) * layer.step);
        if (i < layer.drawn && usable(base) && may_reach_tile(base))
            candidates[atomicAdd(candidate_count, 1u)] = i * layer.step;
        barrier();
        if (on_sphere) look_through(candidate_count, d, best, best_distance);
        barrier();
    }
    // cells are those of all centres; filters leave some of them empty
    if (best != none && !has_bounds() && !passes_filters(element_base(best))) best = none;
    if (all(lessThan(pixel, picture_size)))
        imageStore(regions, pixel, uvec4(!on_sphere ? NOT_ON_SPHERE : best == none ? 0u : best + 1u));
}
