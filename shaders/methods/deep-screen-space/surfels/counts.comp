// "surfels.counts": one row. HAS_FINE: there are fine surfels; ON_HOST: the host found what is left.
layout(local_size_x = 1) in;

#if HAS_FINE
layout(std430) readonly buffer FineSums { vec2 fine_sums[]; };
layout(std430) readonly buffer FineCount { uint fine_count; };
#endif
layout(std430) readonly buffer KeptSums { vec2 kept_sums[]; };
#if ON_HOST
layout(std430) readonly buffer Left { uint triangle_count, patch_count; };
#else
layout(std430) readonly buffer TriangleCount { uint triangle_count; };
layout(std430) readonly buffer PatchCount { uint patch_count; };
#endif
layout(std430) readonly buffer Stored { uint stored, kept_count; };
layout(std430) buffer Row {
    uint triangles, left, patches, fine, kept;
    float fine_area, kept_area, fine_part, kept_part;
};

uniform uint groups, world_triangles;

void main() {
    vec2 of_fine = vec2(0), of_kept = vec2(0);
    for (uint i = 0u; i < groups; ++i) {
#if HAS_FINE
        of_fine += fine_sums[i];
#endif
        of_kept += kept_sums[i];
    }
    triangles = world_triangles;
    left = triangle_count;
    patches = patch_count;
#if HAS_FINE
    fine = fine_count;
#else
    fine = 0u;
#endif
    kept = kept_count;
    fine_area = of_fine.x;
    kept_area = of_kept.x;
    fine_part = of_fine.y / float(max(fine, 1u));
    kept_part = of_kept.y / float(max(kept_count, 1u));
}
