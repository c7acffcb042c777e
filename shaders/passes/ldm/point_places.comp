// From counts of points per texel to each texel's first point, behind those of the batches before. One work group
// scans all texels.
layout(local_size_x = 256) in;

layout(std430) buffer LdmPointTexels { uint first_points[]; };
layout(std430) buffer PointCount { uint point_count; };

uniform uint texel_count;

shared uint sums[256];

void main() {
    uint me = gl_LocalInvocationID.x, share = (texel_count + 255u) / 256u;
    uint begin = min(me * share, texel_count), end = min(begin + share, texel_count), sum = 0u;
    for (uint i = begin; i < end; ++i) sum += first_points[i];
    sums[me] = sum;
    barrier();
    for (uint step = 1u; step < 256u; step <<= 1) {
        uint left = me >= step ? sums[me - step] : 0u;
        barrier();
        sums[me] += left;
        barrier();
    }
    uint place = point_count + sums[me] - sum;
    for (uint i = begin; i < end; ++i) {
        uint count = first_points[i];
        first_points[i] = place;
        place += count;
    }
    barrier();
    if (me != 255u) return;
    first_points[texel_count] = place;
    point_count = place;
}
