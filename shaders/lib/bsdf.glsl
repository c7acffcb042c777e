// Scattering between two directions with its density, and a choice of directions in two steps: passes::Bsdf
// (renderers/passes/scattering/bsdf.h) for light on the viewer's side of a surface.

#include "lib/glass.glsl"

/// f |cosθ| and the density with which directions are chosen, 1/sr; specular parts left out.
struct BsdfValue {
    vec3 value;
    float pdf;
};

/// Of `l` above the shading normal. Densities count below the geometric surface, too; values do not.
BsdfValue evaluate_with_pdf(Scatterer s, Glass glass, SeenScatterer seen, vec3 l) {
    BsdfValue result = BsdfValue(vec3(0), 0.0);
    float n_dot_l = dot(s.n, l), opaque = 1.0 - glass.part;
    if (!(n_dot_l > 0.0)) return result;
    if (opaque > 0.0) {
        result.pdf = opaque * scattering_pdf(s, seen, l, n_dot_l, MICROFACETS_VISIBLE_NORMALS);
        result.value = opaque * scattering_value(s, seen, l, n_dot_l);
    }
    if (is_rough_glass(s, glass)) {
        vec3 h = half_vector(s.n, l, seen.raised);
        float part = glass.part * glass_reflectance(glass, clamp(dot(seen.raised, h), 0.0, 1.0));
        result.pdf += part * microfacet_pdf(s, seen, l, MICROFACETS_VISIBLE_NORMALS);
        result.value += part * distribution_at(s, h) * smith_visibility(n_dot_l, seen.n_dot_v, s.alpha) * n_dot_l;
    }
    if (!(dot(s.geometric_n, l) > 0.0)) result.value = vec3(0);
    return result;
}

/// Whether evaluate_with_pdf() is not 0 everywhere, so that sources are worth sampling.
bool has_smooth_part(Scatterer s, Glass glass) {
    if (is_rough_glass(s, glass)) return true;
    if (glass.part >= 1.0) return false;
    return s.diffuse != vec3(0) || (s.specular > 0.0 && s.alpha >= MIRROR_ALPHA);
}

/// Reflectance for light from everywhere, roughly.
vec3 albedo_of(Scatterer s, Glass glass) {
    vec3 opaque = (s.is_layered ? (1.0 - s.f0) * s.diffuse : s.diffuse) + s.specular * s.f0;
    return mix(opaque, glass.tint, glass.part);
}

/// A direction on the viewer's side that was chosen. The weight is that of specular events, which the others get from
/// evaluate_with_pdf().
struct ChosenDirection {
    vec3 wi;
    vec3 weight;
    bool is_specular, exists;
};
const ChosenDirection NO_DIRECTION = ChosenDirection(vec3(0, 0, 1), vec3(0), false, false);

ChosenDirection chosen_smooth(vec3 l) { return ChosenDirection(l, vec3(0), false, true); }
vec3 mirrored(vec3 v, vec3 h) { return 2.0 * dot(v, h) * h - v; }

ChosenDirection choose_opaque(Scatterer s, SeenScatterer seen, float lobe, vec2 u) {
    mat3 frame = frame_around(s.n);
    if (lobe >= seen.specular_probability) return chosen_smooth(normalize(frame * sample_cosine_ts(u)));
    if (s.alpha < MIRROR_ALPHA) {
        vec3 l = mirrored(seen.raised, s.n);
        if (!is_above(s, l)) return NO_DIRECTION;
        vec3 fresnel = schlick_fresnel(s.f0, seen.raised_cosine);
        return ChosenDirection(l, s.specular * fresnel / seen.specular_probability, true, true);
    }
    vec3 h = frame * sample_visible_normal_ts(seen.raised * frame, s.alpha, u);
    vec3 l = normalize(mirrored(seen.raised, h));
    return is_above(s, l) ? chosen_smooth(l) : NO_DIRECTION;
}

/// Light that passes goes to the other side and is not followed.
ChosenDirection choose_glass(Scatterer s, Glass glass, SeenScatterer seen, float lobe, vec2 u) {
    bool is_rough = is_rough_glass(s, glass);
    mat3 frame = frame_around(s.n);
    vec3 h = is_rough ? frame * sample_visible_normal_ts(seen.raised * frame, s.alpha, u) : s.n;
    float v_dot_h = dot(seen.raised, h);
    if (!(v_dot_h > 0.0) || lobe >= glass_reflectance(glass, v_dot_h)) return NO_DIRECTION;
    vec3 l = normalize(mirrored(seen.raised, h));
    if (is_rough) return dot(s.n, l) > 0.0 ? chosen_smooth(l) : NO_DIRECTION;
    return is_above(s, l) ? ChosenDirection(l, vec3(1), true, true) : NO_DIRECTION;
}

/// `lobe` and `u` uniform in [0, 1).
ChosenDirection choose_direction(Scatterer s, Glass glass, SeenScatterer seen, float lobe, vec2 u) {
    if (lobe < glass.part) return choose_glass(s, glass, seen, lobe / glass.part, u);
    return choose_opaque(s, seen, (lobe - glass.part) / (1.0 - glass.part), u);
}

/// Of light from behind, towards `v`, the fraction that a sheet of clear glass lets pass straight on; 0 of anything
/// else.
vec3 passed_straight(Scatterer s, Glass glass, vec3 v) {
    if (!glass.is_sheet || glass.part <= 0.0 || is_rough_glass(s, glass)) return vec3(0);
    return glass.part * (1.0 - glass_reflectance(glass, seen_from(s, v).raised_cosine)) * glass.tint;
}
