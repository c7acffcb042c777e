// "surfels.counts": one row.
layout(local_size_x = 1) in;

layout(std430) readonly buffer FineSums { vec2 fine_sums[]; };
layout(std430) readonly buffer KeptSums { vec2 kept_sums[]; };
layout(std430) readonly buffer TriangleCount { uint triangle_count; };
layout(std430) readonly buffer PatchCount { uint patch_count; };
layout(std430) readonly buffer FineCount { uint fine_count; };
layout(std430) readonly buffer KeptCount { uint kept_count; };
layout(std430) writeonly buffer Row {
    uint triangles, left, patches, fine, kept;
    float fine_area, kept_area, fine_part, kept_part;
};

uniform uint groups, world_triangles;

void main() {
    vec2 of_fine = vec2(0), of_kept = vec2(0);
    for (uint i = 0u; i < groups; ++i) {
        of_fine += fine_sums[i];
        of_kept += kept_sums[i];
    }
    triangles = world_triangles;
    left = triangle_count;
    patches = patch_count;
    fine = fine_count;
    kept = kept_count;
    fine_area = of_fine.x;
    kept_area = of_kept.x;
    fine_part = of_fine.y / float(max(fine_count, 1u));
    kept_part = of_kept.y / float(max(kept_count, 1u));
}
