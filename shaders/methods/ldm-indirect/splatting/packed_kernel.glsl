// Kernels as a buffer holds them, 80 bytes each.
#include "methods/ldm-indirect/splatting/kernel.glsl"

struct PackedKernel {
    // Centre, rows of M, peak. In w: to_source; per_cosine, or the map of a beam; its distance.
    vec4 rows[5];
};

PackedKernel packed_kernel(Kernel k) {
    return PackedKernel(vec4[5](vec4(k.centre_ws, k.to_source_ws.x), vec4(k.row_p, k.to_source_ws.y),
                                vec4(k.row_q, k.to_source_ws.z),
                                vec4(k.row_n, k.distance > 0.0 ? float(k.map) : k.per_cosine),
                                vec4(k.peak, k.distance)));
}

Kernel unpacked_kernel(PackedKernel k) {
    return Kernel(k.rows[0].xyz, k.rows[1].xyz, k.rows[2].xyz, k.rows[3].xyz, k.rows[4].xyz,
                  vec3(k.rows[0].w, k.rows[1].w, k.rows[2].w), k.rows[4].w > 0.0 ? 1.0 : k.rows[3].w, k.rows[4].w,
                  k.rows[4].w > 0.0 ? uint(k.rows[3].w) : 0u);
}
