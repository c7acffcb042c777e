#include "renderers/passes/scattering/bsdf.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "renderers/passes/lights/luminance.h"
#include "renderers/passes/scattering/microfacets.h"
#include "renderers/scene/frame.h"

namespace ir::passes {
namespace {

constexpr float inverse_pi = glm::one_over_pi<float>();

glm::vec3 mirrored(glm::vec3 v, glm::vec3 h) {
    return 2 * glm::dot(v, h) * h - v;
}

float squared_length(glm::vec3 v) {
    return glm::dot(v, v);
}

}  // namespace

/// A Bsdf seen from one direction.
struct BsdfLobes {
    const Bsdf& b;
    glm::vec3 v;
    glm::vec3 seen_from;             ///< v, raised above the shading normal's horizon
    float n_dot_v;                   ///< as rasterisation clamps it
    float seen_cosine;               ///< n·seen_from
    float specular_probability = 0;  ///< among the two opaque lobes
    bool is_mirror;

    BsdfLobes(const Bsdf& bsdf, glm::vec3 wo)
        : b(bsdf), v(wo), seen_from(wo), n_dot_v(glm::dot(bsdf.n_, wo)), is_mirror(b.alpha_ < mirror_alpha) {
        if (n_dot_v < min_view_cosine) {
            seen_from = glm::normalize(v + (min_view_cosine - n_dot_v) * b.n_);
            n_dot_v = min_view_cosine;
        }
        seen_cosine = glm::dot(b.n_, seen_from);
        const auto fresnel = schlick_fresnel(b.f0_, seen_cosine);
        const float specular = b.specular_ * luminance(fresnel),
                    diffuse = luminance(below_interface(fresnel));
        if (specular > 0) specular_probability = specular / (specular + diffuse);
    }

    /// What the interface leaves of the Lambert part.
    glm::vec3 below_interface(glm::vec3 fresnel) const {
        return b.is_layered_ ? (1.0f - fresnel) * b.diffuse_ : b.diffuse_;
    }

    float visibility(float n_dot_l) const {
        if (b.is_layered_) return smith_visibility(n_dot_l, n_dot_v, b.alpha_);
        return smith_masking_over_2_cosine(n_dot_l, b.alpha_) *
               smith_masking_over_2_cosine(n_dot_v, b.alpha_);
    }

    float distribution(glm::vec3 h) const {
        if (glm::dot(b.n_, h) <= 0)
            return ggx_distribution_of_sine(1, b.alpha_);  // as rasterisation clamps n·h
        return ggx_distribution_of_sine(squared_length(glm::cross(b.n_, h)), b.alpha_);
    }

    /// Density of a reflection about a visible normal: G1(v) D(h) / (4 n·v).  [Heitz18 eq. 17]
    float visible_normal_pdf(glm::vec3 l) const {
        const auto sum = seen_from + l;
        if (!(glm::dot(b.n_, sum) > 0)) return 0;
        return 0.5f * smith_masking_over_2_cosine(seen_cosine, b.alpha_) * distribution(glm::normalize(sum));
    }

    /// Where the interface turns light that comes to a microfacet; the other way round it is the same.
    float glass_reflectance(float v_dot_h) const {
        const float one_side = dielectric_fresnel(v_dot_h, b.eta_).reflectance;
        return b.is_thin_ ? sheet_reflectance(one_side) : one_side;
    }

    /// Of rough glass, among its own events. Reflection as of any interface, and of a sheet its mirror image
    /// on the other side; else refraction at microfacets, radiance scaled by 1/η².  [Walter07 eqs. 21, 17;
    /// Heitz18 eq. 17]
    BsdfValue glass_between(glm::vec3 l) const {
        const float n_dot_l = glm::dot(b.n_, l);
        const bool is_reflected = n_dot_l > 0;
        if (!is_reflected && !b.is_thin_) return refracted(l, -n_dot_l);
        const auto towards = is_reflected ? l : l - 2 * n_dot_l * b.n_;
        const auto h = half_vector(b.n_, towards, seen_from);
        const float reflectance = glass_reflectance(std::clamp(glm::dot(seen_from, h), 0.0f, 1.0f));
        const float part = is_reflected ? reflectance : 1 - reflectance, cosine = std::abs(n_dot_l);
        const float value = part * distribution(h) * smith_visibility(cosine, n_dot_v, b.alpha_) * cosine;
        return {value * (is_reflected ? glm::vec3(1) : b.tint_), part * visible_normal_pdf(towards)};
    }

    /// `cosine` of `l` to the normal's other side.
    BsdfValue refracted(glm::vec3 l, float cosine) const {
        const auto sum = seen_from + b.eta_ * l;
        const float size = glm::length(sum);
        if (!(size > 0) || !(cosine > 0)) return {};
        const auto h = (glm::dot(b.n_, sum) > 0 ? 1 / size : -1 / size) * sum;
        const float v_dot_h = glm::dot(seen_from, h), l_dot_h = glm::dot(l, h);
        if (v_dot_h <= 0 || l_dot_h >= 0) return {};
        const float passing = 1 - glass_reflectance(v_dot_h);
        const float jacobian = b.eta_ * b.eta_ * -l_dot_h / (size * size);  // dω_h / dω_l
        // D G1(v) (v·h) / (n·v), the density of h
        const float density =
            2 * smith_masking_over_2_cosine(seen_cosine, b.alpha_) * v_dot_h * distribution(h);
        const float masking = 2 * cosine * smith_masking_over_2_cosine(cosine, b.alpha_);
        const float pdf = passing * density * jacobian;
        return {pdf * masking / (b.eta_ * b.eta_) * b.tint_, pdf};
    }

    /// `l` above both normals.
    glm::vec3 opaque_value(glm::vec3 l, float n_dot_l) const {
        const auto h = half_vector(b.n_, l, v);
        const auto fresnel = schlick_fresnel(b.f0_, std::clamp(glm::dot(v, h), 0.0f, 1.0f));
        auto f = inverse_pi * below_interface(fresnel);
        if (b.specular_ > 0 && !is_mirror)
            f += b.specular_ * fresnel * (distribution(h) * visibility(n_dot_l));
        return f * n_dot_l;
    }

    float opaque_pdf(glm::vec3 l, float n_dot_l) const {
        float result = (1 - specular_probability) * inverse_pi * n_dot_l;
        if (specular_probability > 0 && !is_mirror) result += specular_probability * visible_normal_pdf(l);
        return result;
    }

    BsdfValue between(glm::vec3 l) const {
        const float n_dot_l = glm::dot(b.n_, l), opaque = 1 - b.transmission_;
        if (b.is_dark_) return {};
        // Densities count below the geometric surface, too; values do not.
        const bool is_lost = (glm::dot(b.geometric_n_, l) > 0) != (n_dot_l > 0);
        BsdfValue result;
        if (n_dot_l > 0 && opaque > 0) {
            result.pdf = opaque * opaque_pdf(l, n_dot_l);
            if (!is_lost) result.value = opaque * opaque_value(l, n_dot_l);
        }
        if (b.scatters_through()) {
            const auto glass = glass_between(l);
            result.pdf += b.transmission_ * glass.pdf;
            if (!is_lost) result.value += b.transmission_ * glass.value;
        }
        return result;
    }

    bool is_reflected(glm::vec3 l) const { return glm::dot(b.n_, l) > 0 && glm::dot(b.geometric_n_, l) > 0; }

    std::optional<BsdfSample> choose_smooth(glm::vec3 l) const {
        return BsdfSample{l, glm::vec3(0), 0, false, glm::dot(b.n_, l) < 0};
    }

    std::optional<BsdfSample> weighted(BsdfSample chosen) const {
        if (chosen.is_specular) return chosen;
        const auto [value, pdf] = between(chosen.wi);
        if (!(pdf > 0) || value == glm::vec3(0)) return {};
        chosen.weight = value / pdf;
        chosen.pdf = pdf;
        return chosen;
    }

    std::optional<BsdfSample> choose_mirror() const {
        const auto l = mirrored(seen_from, b.n_);
        if (!is_reflected(l)) return {};
        const auto weight = b.specular_ * schlick_fresnel(b.f0_, seen_cosine) / specular_probability;
        return BsdfSample{l, weight, 0, true, false};
    }

    std::optional<BsdfSample> choose_opaque(float lobe, glm::vec2 u) const {
        if (lobe < specular_probability && is_mirror) return choose_mirror();
        if (lobe >= specular_probability)
            return choose_smooth(glm::normalize(scene::frame_around(b.n_) * sample_cosine_ts(u)));
        const auto l = glm::normalize(mirrored(seen_from, visible_normal(u)));
        return is_reflected(l) ? choose_smooth(l) : std::nullopt;
    }

    glm::vec3 visible_normal(glm::vec2 u) const {
        const auto frame = scene::frame_around(b.n_);
        const auto seen_ts = seen_from * frame;  // the transpose's product
        return frame * sample_visible_normal_ts(seen_ts, b.alpha_, u);
    }

    std::optional<BsdfSample> choose_rough_glass(float lobe, glm::vec2 u) const {
        const auto h = visible_normal(u);
        const float v_dot_h = glm::dot(seen_from, h);
        if (!(v_dot_h > 0)) return {};
        auto l = mirrored(seen_from, h);
        const bool passes_through = lobe >= glass_reflectance(v_dot_h);
        if (glm::dot(b.n_, l) <= 0 && (!passes_through || b.is_thin_)) return {};  // masked
        if (passes_through && b.is_thin_) l -= 2 * glm::dot(b.n_, l) * b.n_;
        if (passes_through && !b.is_thin_) {
            const float cosine = dielectric_fresnel(v_dot_h, b.eta_).refracted_cosine;
            l = (v_dot_h / b.eta_ - cosine) * h - seen_from / b.eta_;
            if (glm::dot(b.n_, l) >= 0) return {};
        }
        return choose_smooth(glm::normalize(l));
    }

    /// By Fresnel's probability, so that what is chosen keeps its colour.
    std::optional<BsdfSample> choose_glass(float lobe) const {
        const auto interface = dielectric_fresnel(seen_cosine, b.eta_);
        const float reflectance =
            b.is_thin_ ? sheet_reflectance(interface.reflectance) : interface.reflectance;
        if (lobe < reflectance) {
            const auto l = mirrored(seen_from, b.n_);
            if (!is_reflected(l)) return {};
            return BsdfSample{l, glm::vec3(1), 0, true, false};
        }
        if (b.tint_ == glm::vec3(0)) return {};
        if (b.is_thin_) return BsdfSample{-v, b.tint_, 0, true, true};
        const auto l = glm::normalize((seen_cosine / b.eta_ - interface.refracted_cosine) * b.n_ -
                                      seen_from / b.eta_);  // Snell's law
        if (glm::dot(b.geometric_n_, l) >= 0) return {};
        return BsdfSample{l, b.tint_ / (b.eta_ * b.eta_), 0, true, true};
    }

    std::optional<BsdfSample> choose(float lobe, glm::vec2 u) const {
        const float glass = b.transmission_;
        if (b.is_dark_) return {};
        if (lobe < glass)
            return b.scatters_through() ? choose_rough_glass(lobe / glass, u) : choose_glass(lobe / glass);
        return choose_opaque((lobe - glass) / (1 - glass), u);
    }

    std::optional<BsdfSample> sample(float lobe, glm::vec2 u) const {
        const auto chosen = choose(lobe, u);
        return chosen ? weighted(*chosen) : std::nullopt;
    }
};

Bsdf::Bsdf(const Surface& surface, const scene::Material& material, Transport::Materials model)
    : n_(surface.shading_normal_ws),
      geometric_n_(surface.geometric_normal_ws),
      diffuse_(surface.base_colour),
      is_dark_(surface.is_unlit) {
    if (model == Transport::Materials::lambert) return;
    const float metallic = surface.metallic;
    const auto base_colour = surface.base_colour;
    is_layered_ = model == Transport::Materials::gltf;
    specular_ = is_layered_ ? 1 : metallic;
    f0_ = is_layered_ ? layered_f0(material.ior, base_colour, metallic) : base_colour;
    diffuse_ = (1 - metallic) * base_colour;
    alpha_ = surface.roughness * surface.roughness;
    transmission_ = surface.transmission * (1 - metallic);
    is_thin_ = material.thickness <= 0;
    const bool is_leaving = !is_thin_ && !surface.is_front && material.ior > 0;
    eta_ = is_leaving ? 1 / material.ior : material.ior;
    tint_ = base_colour;
}

BsdfValue Bsdf::evaluate_with_pdf(glm::vec3 wo, glm::vec3 wi) const {
    return BsdfLobes(*this, wo).between(wi);
}

std::optional<BsdfSample> Bsdf::choose(glm::vec3 wo, float lobe, glm::vec2 u) const {
    return BsdfLobes(*this, wo).choose(lobe, u);
}

std::optional<BsdfSample> Bsdf::weighted(glm::vec3 wo, const BsdfSample& chosen) const {
    return BsdfLobes(*this, wo).weighted(chosen);
}

std::optional<BsdfSample> Bsdf::sample(glm::vec3 wo, float lobe, glm::vec2 u) const {
    return BsdfLobes(*this, wo).sample(lobe, u);
}

std::optional<OpaqueLobes> Bsdf::opaque(glm::vec3 wo) const {
    const BsdfLobes seen(*this, wo);
    if (is_dark_ || transmission_ > 0 || (specular_ > 0 && seen.is_mirror)) return {};
    using Materials = Transport::Materials;
    const auto model = !(specular_ > 0) ? Materials::lambert
                       : is_layered_    ? Materials::gltf
                                        : Materials::metalness_blend;
    return OpaqueLobes{.model = model,
                       .n = n_,
                       .geometric_n = geometric_n_,
                       .v = wo,
                       .seen_from = seen.seen_from,
                       .n_dot_v = seen.n_dot_v,
                       .seen_cosine = seen.seen_cosine,
                       .diffuse = diffuse_,
                       .f0 = f0_,
                       .specular = specular_,
                       .alpha = alpha_,
                       .specular_probability = seen.specular_probability};
}

glm::vec3 Bsdf::evaluate_importance(glm::vec3 wi, glm::vec3 wo) const {
    const float arriving = std::abs(glm::dot(geometric_n_, wi)),
                leaving = std::abs(glm::dot(geometric_n_, wo));
    const float cosine = std::abs(glm::dot(n_, wo));
    if (!(arriving > 0) || !(cosine > 0)) return glm::vec3(0);
    if (glm::dot(geometric_n_, wo) > 0) return evaluate(wo, wi) * (leaving / arriving);
    // f(wo, wi) / η² of the side of wo is the same in both directions; only this one is known.
    const float squeezed = is_thin_ ? 1 : eta_ * eta_;
    return evaluate(wi, wo) * (squeezed * std::abs(glm::dot(n_, wi)) / cosine * leaving / arriving);
}

std::optional<BsdfSample> Bsdf::sample_importance(glm::vec3 wi, float lobe, glm::vec2 u) const {
    auto sample = BsdfLobes(*this, wi).sample(lobe, u);
    if (!sample) return {};
    const auto wo = sample->wi;
    if (!sample->is_specular) {
        sample->weight = evaluate_importance(wi, wo) / sample->pdf;
        return sample;
    }
    // No radiance that a mirror shows comes from below its shading normal.
    if (!sample->is_transmitted && !(glm::dot(n_, wi) > 0)) return {};
    // Power keeps what radiance gains by being squeezed into fewer directions.
    if (sample->is_transmitted && !is_thin_) sample->weight *= eta_ * eta_;
    const float shading = std::abs(glm::dot(n_, wi) * glm::dot(geometric_n_, wo)),
                geometric = std::abs(glm::dot(geometric_n_, wi) * glm::dot(n_, wo));
    if (!(geometric > 0)) return {};
    sample->weight *= shading / geometric;
    return sample;
}

/// As Surface has it for rays from the other side.
Bsdf Bsdf::from_behind() const {
    auto other = *this;
    other.n_ = -n_, other.geometric_n_ = -geometric_n_;
    if (!is_thin_ && eta_ > 0) other.eta_ = 1 / eta_;
    return other;
}

float Bsdf::pdf_from_any_side(glm::vec3 from, glm::vec3 to) const {
    return glm::dot(geometric_n_, from) > 0 ? pdf(from, to) : from_behind().pdf(from, to);
}

float Bsdf::specular_spread(glm::vec3 from, glm::vec3 to) const {
    const auto cosine = [&](glm::vec3 v) {
        return glm::dot(geometric_n_, v) > 0 ? glm::dot(n_, v) : -glm::dot(n_, v);
    };
    const auto squared_index = [&](glm::vec3 v) {
        return is_thin_ || glm::dot(geometric_n_, v) > 0 ? 1 : eta_ * eta_;
    };
    const float leaving = cosine(from), arriving = cosine(to), index = squared_index(from);
    if (leaving < min_view_cosine || arriving < min_view_cosine || !(index > 0)) return 0;
    return squared_index(to) * arriving / (index * leaving);
}

glm::vec3 Bsdf::passed_straight(glm::vec3 wo) const {
    if (is_dark_ || !is_thin_ || transmission_ <= 0 || scatters_through()) return glm::vec3(0);
    const BsdfLobes seen(*this, wo);
    return transmission_ * (1 - seen.glass_reflectance(seen.seen_cosine)) * tint_;
}

bool Bsdf::scatters_through() const {
    return !is_dark_ && transmission_ > 0 && alpha_ >= mirror_alpha &&
           (is_thin_ || std::abs(eta_ - 1) > same_index);
}

bool Bsdf::has_smooth_part() const {
    if (is_dark_) return false;
    if (scatters_through()) return true;
    if (transmission_ >= 1) return false;
    return diffuse_ != glm::vec3(0) || (specular_ > 0 && alpha_ >= mirror_alpha);
}

glm::vec3 Bsdf::albedo() const {
    if (is_dark_) return glm::vec3(0);
    const auto opaque = (is_layered_ ? (1.0f - f0_) * diffuse_ : diffuse_) + specular_ * f0_;
    return glm::mix(opaque, tint_, transmission_);
}

glm::vec3 Bsdf::transmittance(const scene::Material& material, float distance) {
    if (material.thickness <= 0 || material.attenuation_distance <= 0) return glm::vec3(1);
    return glm::pow(material.attenuation_colour, glm::vec3(distance / material.attenuation_distance));
}

}  // namespace ir::passes
