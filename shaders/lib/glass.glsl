// Scattering by surfaces that are partly glass, as passes::Bsdf (renderers/passes/scattering/bsdf.h) scatters what
// comes from light sources: power takes the place of radiance, so that nothing is divided by η². Where radiance does
// not change with the index, both are the same.

#include "lib/scattering.glsl"

/// What is glass of a surface. With thickness 0 it is a sheet: light passes straight on, all reflections between its
/// two sides counted. Otherwise it is refracted.  [glTF2 KHR_materials_transmission, KHR_materials_volume]
struct Glass {
    float part;    // of the surface; the rest is opaque
    float eta;     // index behind the surface over that in front of it
    vec3 tint;     // of what passes
    bool is_sheet;
};
const Glass NO_GLASS = Glass(0.0, 1.0, vec3(1), true);

Glass make_glass(float part, float ior, float thickness, vec3 tint, bool is_front) {
    bool is_sheet = thickness <= 0.0, is_leaving = !is_sheet && !is_front && ior > 0.0;
    return Glass(part, is_leaving ? 1.0 / ior : ior, tint, is_sheet);
}

/// Rough glass scatters at microfacets; clear glass is a specular event.
bool is_rough_glass(Scatterer s, Glass glass) {
    return glass.part > 0.0 && s.alpha >= MIRROR_ALPHA && (glass.is_sheet || abs(glass.eta - 1.0) > SAME_INDEX);
}

/// Whether some light goes on in one direction only.
bool has_specular(Scatterer s, Glass glass) {
    return (glass.part > 0.0 && !is_rough_glass(s, glass)) || (s.specular > 0.0 && s.alpha < MIRROR_ALPHA);
}

/// Where the interface turns light that comes to a (micro)facet.
float glass_reflectance(Glass glass, float cosine) {
    float one_side = dielectric_fresnel(cosine, glass.eta);
    return glass.is_sheet ? sheet_reflectance(one_side) : one_side;
}

/// Snell's law at a facet `h` with v·h = `cosine` > 0.
vec3 refracted(Glass glass, vec3 v, vec3 h, float cosine) {
    return normalize((cosine / glass.eta - refracted_cosine(cosine, glass.eta)) * h - v / glass.eta);
}

Scattered scattered_by_clear_glass(Scatterer s, Glass glass, SeenScatterer seen, float choice) {
    if (choice < glass_reflectance(glass, seen.raised_cosine)) {
        vec3 l = 2.0 * seen.raised_cosine * s.n - seen.raised;
        return is_above(s, l) ? Scattered(l, vec3(1), true, false) : NOT_SCATTERED;
    }
    if (glass.is_sheet) return Scattered(-seen.v, glass.tint, true, true);
    vec3 l = refracted(glass, seen.raised, s.n, seen.raised_cosine);
    return dot(s.geometric_n, l) < 0.0 ? Scattered(l, glass.tint, true, true) : NOT_SCATTERED;
}

/// At a facet that was seen the weight is what masks the way on: G2/G1 of a reflection, and of a sheet its mirror
/// image on the other side, and G1 of a refraction.  [Walter07 eqs. 21, 17; Heitz18 eq. 19]
Scattered scattered_by_rough_glass(Scatterer s, Glass glass, SeenScatterer seen, float choice, vec2 u) {
    mat3 frame = frame_around(s.n);
    vec3 h = frame * sample_visible_normal_ts(seen.raised * frame, s.alpha, u);
    float v_dot_h = dot(seen.raised, h);
    if (!(v_dot_h > 0.0)) return NOT_SCATTERED;
    bool passes = choice >= glass_reflectance(glass, v_dot_h);
    vec3 tint = passes ? glass.tint : vec3(1);
    if (passes && !glass.is_sheet) {
        vec3 l = refracted(glass, seen.raised, h, v_dot_h);
        float cosine = -dot(s.n, l);
        if (!(cosine > 0.0) || dot(s.geometric_n, l) >= 0.0) return NOT_SCATTERED;
        return Scattered(l, smith_masking(cosine, v_dot_h, s.alpha) * tint, false, true);
    }
    vec3 l = normalize(2.0 * v_dot_h * h - seen.raised);
    float cosine = dot(s.n, l);
    if (!(cosine > 0.0)) return NOT_SCATTERED;
    float masking = 2.0 * cosine * smith_visibility(cosine, seen.n_dot_v, s.alpha) /
                    smith_masking_over_2_cosine(seen.raised_cosine, s.alpha);
    if (passes) l -= 2.0 * cosine * s.n;
    if ((dot(s.geometric_n, l) > 0.0) == passes) return NOT_SCATTERED;
    return Scattered(l, masking * tint, false, passes);
}

/// As scatter(). Glass or not is chosen by its part of the surface, reflection or not by Fresnel's equations, so that
/// what is chosen keeps its colour.
/// DEVIATION [Smal19 §4.5]: (r_s² + r_p²)/2 is reflected. As printed, (r_s + r_p)/2 is refracted, which is nothing at
/// normal incidence and negative beyond Brewster's angle.
Scattered scatter(Scatterer s, Glass glass, vec3 v, float lobe, vec2 u, int sampling) {
    if (lobe >= glass.part) return scatter(s, v, (lobe - glass.part) / (1.0 - glass.part), u, sampling);
    SeenScatterer seen = seen_from(s, v);
    float choice = lobe / glass.part;
    return is_rough_glass(s, glass) ? scattered_by_rough_glass(s, glass, seen, choice, u)
                                    : scattered_by_clear_glass(s, glass, seen, choice);
}

/// As scatter(), for a photon that comes from `from`.
Scattered scatter_photon(Scatterer s, Glass glass, vec3 from, float lobe, vec2 u, int sampling) {
    if (lobe < glass.part) return corrected(scatter(s, glass, from, lobe, u, sampling), s, from);
    return scatter_photon(s, from, (lobe - glass.part) / (1.0 - glass.part), u, sampling);
}
