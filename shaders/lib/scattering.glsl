// Scattering by what is opaque of surfaces, with sampling: passes::Bsdf (renderers/passes/scattering/bsdf.h) for rays
// on the device; lib/glass.glsl has the rest. Directions are unit vectors that point away from the surface; cosines
// are taken with the shading normal; directions above one of the two normals and below the other do not count, but
// for those in which photons leave.

#include "lib/brdf.glsl"
#include "lib/luminance.glsl"
#include "lib/spaces.glsl"

// How the microfacet lobe chooses its directions, in the order of photon mapping's MicrofacetSampling.
// C++: ir::passes::*
const int MICROFACETS_VISIBLE_NORMALS = 0,  // [Heitz18]
    MICROFACETS_GGX = 1,          // [Walter07 eq. 35], whose weights may exceed 1
    MICROFACETS_GGX_PRINTED = 2;  // the directions of the second with the weights of the first: wrong

struct Scatterer {
    vec3 n, geometric_n;
    vec3 diffuse;    // albedo of the Lambert part, without the interface above it
    vec3 f0;
    float specular;  // weight of the microfacets
    float alpha;     // roughness²
    bool is_layered; // the Lambert part lies below the microfacets, not beside them
};

Scatterer make_scatterer(vec3 n, vec3 geometric_n, vec3 base_colour, float metallic, float roughness,
                         float ior, int model) {
    Scatterer s = Scatterer(n, geometric_n, base_colour, vec3(0), 0.0, 1.0, false);
    if (model == SCATTERING_LAMBERT) return s;
    s.is_layered = model == SCATTERING_GLTF;
    s.specular = s.is_layered ? 1.0 : metallic;
    s.f0 = s.is_layered ? layered_f0(ior, base_colour, metallic) : base_colour;
    s.diffuse = (1.0 - metallic) * base_colour;
    s.alpha = roughness * roughness;
    return s;
}

/// A direction that was chosen; all factors are included: f |cosθ| / pdf. Weight 0: the event carries no light.
struct Scattered {
    vec3 direction_ws;
    vec3 weight;
    bool is_specular;     // by a mirror or clear glass, which does not count as a scattering
    bool is_transmitted;  // to the other side
};
const Scattered NOT_SCATTERED = Scattered(vec3(0, 0, 1), vec3(0), false, false);

/// From the squared sine between normal and half vector: near the peak its cosine has lost the digits that
/// count.  [Walter07 eq. 33]
float ggx_distribution_of_sine(float squared_sine, float alpha) {
    float squared = alpha * alpha;
    float denominator = squared + (1.0 - squared) * squared_sine;
    return squared / (PI * denominator * denominator);
}

#ifdef SMITH_PRINTED
/// Test only: tan² of the angle to the microfacet's normal, as printed.  [Smal19 eq. 3.7]
float smith_masking(float n_dot_v, float m_dot_v, float alpha) {
    float squared_tan = (1.0 - m_dot_v * m_dot_v) / max(m_dot_v * m_dot_v, 1e-8);
    return 2.0 / (1.0 + sqrt(1.0 + alpha * alpha * squared_tan));
}
#else
/// Masking of one direction: 2 / (1 + √(1 + α² tan²θ)), θ to the macroscopic normal.  [Walter07 eq. 34]
// DEVIATION [Smal19 eq. 3.7]: there tan² is of the angle to the microfacet's normal, which masks nothing
// at grazing angles.
float smith_masking(float n_dot_v, float m_dot_v, float alpha) {
    float squared = alpha * alpha;
    return 2.0 * n_dot_v / (n_dot_v + sqrt(squared + (1.0 - squared) * n_dot_v * n_dot_v));
}
#endif

/// Height-correlated, or the product of two maskings.  [Heitz14 eq. 99; Smal19 eq. 3.6]
float joint_masking(Scatterer s, float n_dot_l, float n_dot_v, float m_dot_v) {
    if (s.is_layered) return 4.0 * n_dot_l * n_dot_v * smith_visibility(n_dot_l, n_dot_v, s.alpha);
    return smith_masking(n_dot_l, m_dot_v, s.alpha) * smith_masking(n_dot_v, m_dot_v, s.alpha);
}

/// Cosine-distributed about z.  [Malley88]
vec3 sample_cosine_ts(vec2 u) {
    float radius = sqrt(u.x), phi = 2.0 * PI * u.y;
    return vec3(radius * cos(phi), radius * sin(phi), sqrt(max(0.0, 1.0 - u.x)));
}

/// A GGX normal as often as `v` (above the surface) sees it, with density G1(v) D(h) max(0, v·h) / v.z.
/// [Heitz18 listing 1]
vec3 sample_visible_normal_ts(vec3 v, float alpha, vec2 u) {
    vec3 stretched = normalize(vec3(alpha * v.xy, v.z));
    float squared = dot(stretched.xy, stretched.xy);
    vec3 first = squared > 0.0 ? vec3(-stretched.y, stretched.x, 0.0) / sqrt(squared) : vec3(1, 0, 0);
    vec3 second = cross(stretched, first);
    float radius = sqrt(u.x), phi = 2.0 * PI * u.y;
    float a = radius * cos(phi), side = 0.5 * (1.0 + stretched.z);
    float b = (1.0 - side) * sqrt(max(0.0, 1.0 - a * a)) + side * radius * sin(phi);
    vec3 h = a * first + b * second + sqrt(max(0.0, 1.0 - a * a - b * b)) * stretched;
    return normalize(vec3(alpha * h.xy, max(0.0, h.z)));
}

/// A GGX normal with density D(h) h.z: θ = atan(α √u / √(1 - u)).  [Walter07 eq. 35; Smal19 §4.1]
vec3 ggx_normal_ts(float alpha, vec2 u) {
    float squared_tan = alpha * alpha * u.x / max(1.0 - u.x, 1e-7), phi = 2.0 * PI * u.y;
    float z = inversesqrt(1.0 + squared_tan);
    float radius = sqrt(squared_tan) * z;
    return vec3(radius * cos(phi), radius * sin(phi), z);
}

/// A scatterer seen from one direction.
struct SeenScatterer {
    vec3 v;
    vec3 raised;                 // v, above the shading normal's horizon
    float n_dot_v;               // as rasterisation clamps it
    float raised_cosine;         // n·raised
    float specular_probability;  // among the two lobes, by luminance
};

/// What the interface leaves of the Lambert part.
vec3 below_interface(Scatterer s, vec3 fresnel) { return s.is_layered ? (1.0 - fresnel) * s.diffuse : s.diffuse; }

SeenScatterer seen_from(Scatterer s, vec3 v) {
    SeenScatterer seen = SeenScatterer(v, v, dot(s.n, v), 0.0, 0.0);
    if (seen.n_dot_v < MIN_VIEW_COSINE) {
        seen.raised = normalize(v + (MIN_VIEW_COSINE - seen.n_dot_v) * s.n);
        seen.n_dot_v = MIN_VIEW_COSINE;
    }
    seen.raised_cosine = dot(s.n, seen.raised);
    vec3 fresnel = schlick_fresnel(s.f0, seen.raised_cosine);
    float specular = s.specular * luminance(fresnel);
    float diffuse = luminance(below_interface(s, fresnel));
    if (specular > 0.0) seen.specular_probability = specular / (specular + diffuse);
    return seen;
}

/// D at a half vector.
float distribution_at(Scatterer s, vec3 h) {
    if (dot(s.n, h) <= 0.0) return ggx_distribution_of_sine(1.0, s.alpha);
    vec3 sine = cross(s.n, h);
    return ggx_distribution_of_sine(dot(sine, sine), s.alpha);
}

/// Density per solid angle with which the microfacet lobe chooses `l`.
float microfacet_pdf(Scatterer s, SeenScatterer seen, vec3 l, int sampling) {
    vec3 sum = seen.raised + l;
    if (!(dot(s.n, sum) > 0.0)) return 0.0;
    vec3 h = normalize(sum);
    float v_dot_h = dot(seen.raised, h);
    if (sampling == MICROFACETS_GGX)  // D(h) (n·h) / (4 v·h)
        return distribution_at(s, h) * dot(s.n, h) / max(4.0 * v_dot_h, 1e-7);
    // G1(v) D(h) / (4 n·v)  [Heitz18 eq. 17]
    return smith_masking(seen.raised_cosine, v_dot_h, s.alpha) * distribution_at(s, h) / (4.0 * seen.raised_cosine);
}

/// f cosθ, `l` above both normals; without mirrors.
vec3 scattering_value(Scatterer s, SeenScatterer seen, vec3 l, float n_dot_l) {
    vec3 h = half_vector(s.n, l, seen.v);
    vec3 fresnel = schlick_fresnel(s.f0, clamp(dot(seen.v, h), 0.0, 1.0));
    vec3 f = below_interface(s, fresnel) / PI;
    if (s.specular > 0.0 && s.alpha >= MIRROR_ALPHA)
        f += s.specular * fresnel * distribution_at(s, h) *
             joint_masking(s, n_dot_l, seen.n_dot_v, dot(seen.v, h)) / (4.0 * n_dot_l * seen.n_dot_v);
    return f * n_dot_l;
}

/// `cosine`: of `l` to the normal that the Lambert part is sampled about.
float scattering_pdf(Scatterer s, SeenScatterer seen, vec3 l, float cosine, int sampling) {
    float pdf = (1.0 - seen.specular_probability) * cosine / PI;
    if (seen.specular_probability > 0.0 && s.alpha >= MIRROR_ALPHA)
        pdf += seen.specular_probability * microfacet_pdf(s, seen, l, sampling);
    return pdf;
}

bool is_above(Scatterer s, vec3 l) { return dot(s.n, l) > 0.0 && dot(s.geometric_n, l) > 0.0; }

Scattered scattered_by_mirror(Scatterer s, SeenScatterer seen) {
    vec3 l = 2.0 * seen.raised_cosine * s.n - seen.raised;
    if (!is_above(s, l)) return NOT_SCATTERED;
    vec3 fresnel = schlick_fresnel(s.f0, seen.raised_cosine);
    return Scattered(l, s.specular * fresnel / seen.specular_probability, true, false);
}

/// The printed survival F G2 / G1 of a microfacet, over its lobe's probability.  [Smal19 §4.4.1]
vec3 printed_weight(Scatterer s, SeenScatterer seen, vec3 l, float n_dot_l, bool is_microfacet) {
    if (!is_microfacet) {
        vec3 h = half_vector(s.n, l, seen.raised);
        vec3 fresnel = schlick_fresnel(s.f0, clamp(dot(seen.raised, h), 0.0, 1.0));
        return below_interface(s, fresnel) / (1.0 - seen.specular_probability);
    }
    vec3 h = half_vector(s.n, l, seen.raised);
    float m_dot_v = dot(seen.raised, h);
    vec3 fresnel = schlick_fresnel(s.f0, clamp(m_dot_v, 0.0, 1.0));
    float masking = smith_masking(seen.raised_cosine, m_dot_v, s.alpha);
    return s.specular * fresnel * joint_masking(s, n_dot_l, seen.raised_cosine, m_dot_v) / masking /
           seen.specular_probability;
}

vec3 mirrored_by_microfacet(Scatterer s, SeenScatterer seen, vec2 u, int sampling) {
    mat3 frame = frame_around(s.n);
    vec3 h = frame * (sampling == MICROFACETS_VISIBLE_NORMALS
                          ? sample_visible_normal_ts(seen.raised * frame, s.alpha, u)
                          : ggx_normal_ts(s.alpha, u));
    return normalize(2.0 * dot(seen.raised, h) * h - seen.raised);
}

/// A direction for what is seen from `v`. The lobe is chosen by luminance; the weight is that of all lobes over the
/// density of all lobes. `lobe` and `u` uniform in [0, 1).
/// DEVIATION [Smal19 §4.4]: the source does not say how lobes are chosen, nor divides by the probability.
Scattered scatter(Scatterer s, vec3 v, float lobe, vec2 u, int sampling) {
    SeenScatterer seen = seen_from(s, v);
    bool is_microfacet = lobe < seen.specular_probability;
    if (is_microfacet && s.alpha < MIRROR_ALPHA) return scattered_by_mirror(s, seen);
    vec3 l = is_microfacet ? mirrored_by_microfacet(s, seen, u, sampling)
                           : normalize(frame_around(s.n) * sample_cosine_ts(u));
    if (!is_above(s, l)) return NOT_SCATTERED;
    float n_dot_l = dot(s.n, l);
    if (sampling == MICROFACETS_GGX_PRINTED)
        return Scattered(l, printed_weight(s, seen, l, n_dot_l, is_microfacet), false, false);
    float pdf = scattering_pdf(s, seen, l, n_dot_l, sampling);
    if (!(pdf > 0.0)) return NOT_SCATTERED;
    return Scattered(l, scattering_value(s, seen, l, n_dot_l) / pdf, false, false);
}

/// Of photons where interpolated or mapped normals lean away: light that grazes the geometric surface would be
/// multiplied without bound.
const float MAX_CORRECTION = 8.0;

/// What a photon's weight is multiplied by so that it carries what a camera path along the same directions
/// would: `l` towards where the photon came from, `o` where it goes; 1 without normal maps and interpolated
/// normals.  [Veach97 eq. 5.19]
float shading_normal_correction(vec3 n, vec3 geometric_n, vec3 l, vec3 o) {
    float arriving = abs(dot(n, l)), leaving = abs(dot(geometric_n, o));
    float denominator = abs(dot(geometric_n, l)) * abs(dot(n, o));
    return min(MAX_CORRECTION, arriving * leaving / max(denominator, 1e-7));
}

/// What scatter() chose, for a photon that comes from `from`.
Scattered corrected(Scattered scattered, Scatterer s, vec3 from) {
    // what a mirror shows comes from above both normals
    bool is_mirrored = scattered.is_specular && !scattered.is_transmitted;
    scattered.weight *= is_mirrored && dot(s.n, from) <= 0.0
                            ? 0.0
                            : shading_normal_correction(s.n, s.geometric_n, from, scattered.direction_ws);
    return scattered;
}

/// A direction for a photon that comes from `from`. The weight is what a camera there sees of the light, over the
/// density of both lobes. Microfacets lie about the shading normal; the Lambert part is sampled about the geometric
/// one, as cameras see it below the other's horizon, too.
Scattered scatter_photon(Scatterer s, vec3 from, float lobe, vec2 u, int sampling) {
    SeenScatterer seen = seen_from(s, from);
    bool is_microfacet = lobe < seen.specular_probability;
    if ((is_microfacet && s.alpha < MIRROR_ALPHA) || sampling == MICROFACETS_GGX_PRINTED)
        return corrected(scatter(s, from, lobe, u, sampling), s, from);
    // what is seen comes from above both normals
    float n_dot_l = dot(s.n, from), arriving = dot(s.geometric_n, from);
    if (!(n_dot_l > 0.0 && arriving > 0.0)) return NOT_SCATTERED;
    vec3 o = is_microfacet ? mirrored_by_microfacet(s, seen, u, sampling)
                           : normalize(frame_around(s.geometric_n) * sample_cosine_ts(u));
    float leaving = dot(s.geometric_n, o);
    if (!(leaving > 0.0)) return NOT_SCATTERED;
    float pdf = scattering_pdf(s, seen, o, leaving, sampling);
    if (!(pdf > 0.0)) return NOT_SCATTERED;
    vec3 weight = scattering_value(s, seen_from(s, o), from, n_dot_l) * leaving / (arriving * pdf);
    return Scattered(o, s.n == s.geometric_n ? weight : min(weight, MAX_CORRECTION), false, false);
}
