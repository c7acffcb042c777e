// Which texels a photon's kernel may light: those around its outline in the picture.
//
// DEVIATION [Smal19 §6.3]: the thesis tests tiles against a sphere around the kernel, which is flat and reaches fewer.
// 100,000 photons are listed 48,240 times instead of 66,418 in builtin:conference, 13,154 instead of 21,652 in
// builtin:atrium (480×270).
#include "methods/photon-mapping/splatting/photon_kernel.glsl"

/// Place (w 1) or direction (w 0) in texels times w, and w.
vec3 homogeneous_texel(vec4 v_ws) {
    vec4 clip = clip_from_world * v_ws;
    return vec3(0.5 * (clip.w + clip.x) * size_texels.x, 0.5 * (clip.w - clip.y) * size_texels.y, clip.w);
}

const float BIN_MARGIN = 0.05;  // texels: rounding; what is not covered is found out later

/// First and last column or row whose middles the kernel covers: as KernelMaker::box_of() on the host. Planes that
/// touch an ellipsoid with half-axes a_i about c meet (p·a_1)² + (p·a_2)² + (p·a_3)² = (p·c)²; for those through the
/// eye and a column of texels this is a quadratic equation of the column, which counts from that of the middle.
vec2 outline_along(float middle, vec3 a, vec3 b, float most) {
    float ab = dot(a, b), root = sqrt(max(ab * ab - dot(a, a) * most, 0.0));
    return vec2(ceil(middle + (ab + root) / most - 0.5 - BIN_MARGIN),
                floor(middle + (ab - root) / most - 0.5 + BIN_MARGIN));
}

bool seen_pixels(uint i, out uvec4 pixels) {
    pixels = uvec4(0, 0, uvec2(size_texels) - 1u);
    Photon photon = photons[i];
    if (!is_splatted(photon)) return false;
    Kernel k = kernel_of(photon);
#ifdef LINEAR_DEPTH
    k.axes.z = 0.0;  // what is tested is seen through the ellipse
#endif
    vec3 c = homogeneous_texel(vec4(k.centre_ws, 1)), u = homogeneous_texel(vec4(k.axes.x * k.u_ws, 0)),
         t = homogeneous_texel(vec4(k.axes.y * k.t_ws, 0)), n = homogeneous_texel(vec4(k.axes.z * k.n_ws, 0));
    vec3 b = vec3(u.z, t.z, n.z);
    float most = dot(b, b) - c.z * c.z;
    if (most > -1e-6 * c.z * c.z) return true;  // reaches the plane through the eye
    if (c.z < 0.0) return false;
    vec2 middle = c.xy / c.z, last = size_texels - 1.0;
    vec2 x = outline_along(middle.x, vec3(u.x, t.x, n.x) - middle.x * b, b, most);
    vec2 y = outline_along(middle.y, vec3(u.y, t.y, n.y) - middle.y * b, b, most);
    // What is not a number is in no texel.
    bool is_seen = x.x <= x.y && y.x <= y.y && x.y >= 0.0 && y.y >= 0.0 && x.x <= last.x && y.x <= last.y;
    if (!is_seen) return false;
    pixels = uvec4(clamp(vec4(x.x, y.x, x.y, y.y), vec4(0), last.xyxy));
    return true;
}
