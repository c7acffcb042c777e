// Marches the pixel that a person points at once more, and writes each direction's horizon and all samples. One
// work group; elements come in the order of directions and steps.
layout(local_size_x = 64) in;
#include "lib/floats.glsl"
#include "methods/hbao/march.glsl"

// C++: ir::methods::hbao::Horizon
struct Horizon {
    float centre[3], horizon, tangent, contribution, distance;
    uint direction;
};
layout(std430) writeonly buffer Horizons { Horizon horizons[]; };
// C++: ir::methods::hbao::LineToHorizon
struct LineToHorizon {
    float start[3], end[3];
    uint found;
    float distance, contribution;
    uint direction;
};
layout(std430) writeonly buffer Lines { LineToHorizon lines[]; };
// C++: ir::methods::hbao::SampleMarched
struct SampleMarched {
    float position[3];
    uint role;
    float distance, elevation, taken;
    uint direction, step;
};
layout(std430) writeonly buffer Samples { SampleMarched samples[]; };
layout(std430) buffer HorizonCount { uint horizon_count; };
layout(std430) buffer LineCount { uint line_count; };
layout(std430) buffer SampleCount { uint sample_count; };

uniform ivec2 picked;  // negative: none

const uint NO_SURFACE = 0u, OUT_OF_RANGE = 1u, BELOW = 2u, RAISES = 3u;

shared float partial_sums[64];
shared uint first_samples[1024];  // by direction: the most that the parameter allows

/// Σ of all directions' weight, and where each direction's samples start.
float lay_out(Point x, uint me, uint all) {
    float sum = 0.0;
    for (uint i = me; i < all; i += 64u) {
        Slice slice = slice_of(x, int(i));
        first_samples[i] = uint(slice.steps);
        sum += whole_weight(slice);
    }
    partial_sums[me] = sum;
    barrier();
    if (me == 0u) {
        uint next = 0u;
        for (uint i = 0u; i < all; ++i) {
            uint count = first_samples[i];
            first_samples[i] = next;
            next += count;
        }
        float total = 0.0;
        for (uint i = 0u; i < 64u; ++i) total += partial_sums[i];
        partial_sums[0] = total;
        horizon_count = line_count = all;
        sample_count = next;
    }
    barrier();
    return partial_sums[0];
}

/// Where there is no surface, as far along the view axis as the pixel's point is.
vec3 shown_at(Point x, Sample s, bool surface) {
    if (surface) return s.position;
    vec2 here = vec2(x.pixel) + 0.5, there = vec2(s.pixel) + 0.5;
    float depth = distance(x.position, pixel_ray_origin(here)) / length(pixel_ray_direction(here));
    return pixel_ray_origin(there) + depth * pixel_ray_direction(there);
}

void write_sample(uint index, Point x, Sample s, uint role, float taken, uint direction, uint step) {
    if (index >= uint(samples.length())) return;
    vec3 place = shown_at(x, s, role != NO_SURFACE);
    samples[index] = SampleMarched(floats(place), role, distance(place, x.position),
                                   role == NO_SURFACE ? 0.0 : 90.0 - degrees(s.angle), taken, direction, step);
}

void write_horizon(uint direction, vec3 centre, float horizon, float tangent, float contribution,
                   float distance_ws) {
    if (direction < uint(horizons.length()))
        horizons[direction] = Horizon(floats(centre), 90.0 - degrees(horizon), 90.0 - degrees(tangent), contribution,
                                      distance_ws, direction);
}

void write_line(uint direction, vec3 start, vec3 end, bool found, float contribution) {
    if (direction < uint(lines.length()))
        lines[direction] = LineToHorizon(floats(start), floats(end), found ? 1u : 0u, distance(start, end),
                                         contribution, direction);
}

void explain(Point x, uint direction, float all_weight) {
    Slice slice = slice_of(x, int(direction));
    float horizon = first_horizon(slice), open = weight_up_to(slice, horizon), above = open;
    vec3 end = x.position;
    bool found = false;
    for (int step = 0; step < slice.steps; ++step) {
        Sample s = sample_of(x, slice, step);
        bool surface = texelFetch(gbuffer_position, s.pixel, 0).w > 0.0;
        uint role = !surface ? NO_SURFACE : !s.counts ? OUT_OF_RANGE : s.angle >= horizon ? BELOW : RAISES;
        float taken = 0.0;
        if (role == RAISES) {
            horizon = s.angle;
            float still_above = weight_up_to(slice, horizon);
            taken = occlusion(s.distance) * (above - still_above);
            open -= taken;
            above = still_above;
            end = s.position;
            found = true;
        }
        write_sample(first_samples[direction] + uint(step), x, s, role, taken / all_weight, direction, uint(step));
    }
    vec3 centre = normalize(cos(horizon) * x.zenith + sin(horizon) * slice.direction);
    write_horizon(direction, centre, horizon, slice.tangent, open / all_weight, distance(x.position, end));
    write_line(direction, x.position, end, found, open / all_weight);
}

void main() {
    uint me = gl_LocalInvocationID.x, all = uint(params.directions);
    if (picked.x < 0) return;
    Point x = point_at(picked);
    if (!x.exists) return;  // alike for all invocations
    float all_weight = lay_out(x, me, all);
    for (uint i = me; i < all; i += 64u) explain(x, i, all_weight);
}
