// The filter over samples, many pixels at a time: shaders/passes/bounce/filter.glsl, reconstruct.comp and
// what these take of lib/scattering.glsl, whose names are used here. [Nalbach15 §3.3]
#include <algorithm>

#include "renderers/passes/bounce/host/filter_tile.h"
#include "renderers/passes/vectors/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "renderers/passes/bounce/host/reconstruct_tile.cpp"
#include <hwy/foreach_target.h>

#include "renderers/passes/scattering/scatterers.inl"

#include <hwy/contrib/math/math-inl.h>

HWY_BEFORE_NAMESPACE();
namespace ir::passes::bounce::HWY_NAMESPACE {
namespace {

using namespace scattering::HWY_NAMESPACE;
using vectors::HWY_NAMESPACE::set;

static_assert(FilterTile::width % lanes == 0);

Floats load(const Plane& plane, std::size_t at) {
    return hn::LoadU(f, plane.data() + at);
}

Vector3 load(const Planes& planes, std::size_t at) {
    return {load(planes[0], at), load(planes[1], at), load(planes[2], at)};
}
HWY_INLINE Mask is_finite(const Vector3& a) {
    return hn::And(hn::IsFinite(a.x), hn::And(hn::IsFinite(a.y), hn::IsFinite(a.z)));
}
/// a (1 - part) + b part
HWY_INLINE Floats mixed(Floats a, Floats b, float part) {
    return hn::MulAdd(b, set(part), hn::Mul(a, set(1 - part)));
}

template <Transport::Materials model>
Scatterers<model> scatterers_at(const FilterTile& tile, std::size_t at) {
    return {.n = load(tile.normal, at),
            .geometric_n = load(tile.geometric_normal, at),
            .v = load(tile.viewer, at),
            .diffuse = load(tile.diffuse, at),
            .f0 = load(tile.f0, at),
            .specular = load(tile.specular, at),
            .alpha = load(tile.alpha, at),
            .n_dot_v = load(tile.n_dot_v, at)};
}

/// By which a pixel's directions are chosen.
template <Transport::Materials model>
struct Choosers {
    Vector3 n, raised;
    Floats raised_cosine, specular_probability, alpha;

    Choosers(const FilterTile& tile, std::size_t at)
        : n(load(tile.normal, at)),
          raised(load(tile.raised, at)),
          raised_cosine(load(tile.raised_cosine, at)),
          specular_probability(load(tile.specular_probability, at)),
          alpha(load(tile.alpha, at)) {}

    /// density_of: scattering_pdf, 0 below the surface
    HWY_INLINE Floats density(const Vector3& l) const {
        const auto n_dot_l = dot(n, l);
        auto pdf = hn::Mul(n_dot_l, set(one_over_pi));
        if constexpr (Scatterers<model>::has_lobes)
            pdf = hn::MulAdd(hn::Sub(set(1), specular_probability), pdf,
                             hn::Mul(specular_probability, microfacet_pdf(l)));
        return hn::IfThenElseZero(is_positive(n_dot_l), pdf);
    }

  private:
    /// G1(v) D(h) / (4 n·v)
    HWY_INLINE Floats microfacet_pdf(const Vector3& l) const {
        const auto sum = plus(raised, l);
        const auto h = times(sum, hn::Div(set(1), hn::Sqrt(dot(sum, sum))));
        const auto squared = hn::Mul(alpha, alpha), rest = hn::Sub(set(1), squared);
        const auto denominator = hn::MulAdd(rest, squared_cross(n, h), squared);
        const auto distribution =
            hn::Div(hn::Mul(squared, set(one_over_pi)), hn::Mul(denominator, denominator));
        const auto root = hn::Sqrt(hn::MulAdd(hn::Mul(raised_cosine, raised_cosine), rest, squared));
        const auto pdf = hn::Div(hn::Mul(set(0.5f), distribution), hn::Add(raised_cosine, root));
        return hn::IfThenElseZero(is_positive(dot(n, sum)), pdf);
    }
};

/// Weights of neighbours: blur_weight and material_weight.
class Weights {
  public:
    Weights(const FilterRules& rules, const FilterTile& tile, std::size_t at)
        : rules_(rules),
          tile_(tile),
          at_(at),
          exists_(is_positive(load(tile.exists, at))),
          position_(load(tile.position, at)),
          blur_normal_(load(tile.blur_normal, at)),
          geometric_normal_(load(tile.geometric_normal, at)),
          squared_narrowing_(set(1)),
          metallic_(hn::Zero(f)),
          roughness_(hn::Zero(f)) {
        if (rules.has_kernels) {
            const auto narrowing = load(tile.narrowing, at);
            squared_narrowing_ = hn::Mul(narrowing, narrowing);
        }
        if (!has_material()) return;
        metallic_ = load(tile.metallic, at);
        roughness_ = load(tile.roughness, at);
    }
    Mask exists() const { return exists_; }

    HWY_INLINE Floats of(std::size_t at, int dx, int dy) const {
        const auto there = hn::And(exists_, is_positive(load(tile_.exists, at)));
        if (at == at_) return hn::IfThenElseZero(there, set(1));
        if (hn::AllFalse(f, there)) return hn::Zero(f);
        const auto& c = rules_.constants;
        const float x = 2 * static_cast<float>(dx) / static_cast<float>(c.radius),
                    y = 2 * static_cast<float>(dy) / static_cast<float>(c.radius);
        const auto s = hn::Mul(off_plane(at), set(1 / c.plane_tolerance));
        auto exponent = hn::NegMulAdd(s, s, hn::Mul(squared_narrowing_, set(-0.5f * (x * x + y * y))));
        auto faces = there;
        if (c.normal_power > 0) {
            const auto cosine = clamped(dot(blur_normal_, load(tile_.blur_normal, at)));
            faces = hn::And(faces, is_positive(cosine));
            const auto logarithm = hn::Log(f, hn::Max(cosine, set(1e-30f)));
            exponent = hn::MulAdd(logarithm, set(c.normal_power), exponent);
        }
        if (has_material()) {
            const auto scale = set(1 / c.material_tolerance);
            const auto m = hn::Mul(hn::Sub(load(tile_.metallic, at), metallic_), scale),
                       r = hn::Mul(hn::Sub(load(tile_.roughness, at), roughness_), scale);
            exponent = hn::NegMulAdd(m, m, hn::NegMulAdd(r, r, exponent));
        }
        return hn::IfThenElseZero(faces, hn::Exp(f, hn::Max(exponent, set(-200))));
    }

  private:
    bool has_material() const { return rules_.light && rules_.materials != Transport::Materials::lambert; }
    HWY_INLINE Floats off_plane(std::size_t at) const {
        const auto way = minus(load(tile_.position, at), position_);
        const auto size = hn::Sqrt(dot(way, way));
        const auto here = hn::Abs(dot(way, geometric_normal_)),
                   there = hn::Abs(dot(way, load(tile_.geometric_normal, at)));
        return hn::IfThenElseZero(is_positive(size), hn::Div(hn::Max(here, there), size));
    }

    const FilterRules& rules_;
    const FilterTile& tile_;
    std::size_t at_;
    Mask exists_;
    Vector3 position_, blur_normal_, geometric_normal_;
    Floats squared_narrowing_, metallic_, roughness_;
};

/// Sums over neighbours and samples.
struct Sums {
    Vector3 value;
    Floats share;
    // Written out, as GCC compiles implicit ones without the instruction set of this namespace.
    Sums(const FilterTile& tile, int x, int y)
        : value{before(tile, 0, x, y), before(tile, 1, x, y), before(tile, 2, x, y)},
          share(before(tile, 3, x, y)) {}
    /// Not finite values count for nothing.
    HWY_INLINE void add(Floats weight, const Vector3& part, Floats part_share) {
        const auto finite = is_finite(part);
        value = add_product(masked(finite, part), weight, value);
        share = hn::MulAdd(hn::IfThenElseZero(finite, part_share), weight, share);
    }

  private:
    static Floats before(const FilterTile& tile, std::size_t channel, int x, int y) {
        return hn::LoadU(f, tile.sums[channel].data() + y * FilterTile::width + x);
    }
};

/// Calls `with(place, weight)` for each neighbour that has one for some pixel.
template <class With>
HWY_INLINE void each_neighbour(const FilterTile& tile, const Weights& weights, int x, int y,
                               const With& with) {
    for (int dy = -tile.radius; dy <= tile.radius; ++dy)
        for (int dx = -tile.radius; dx <= tile.radius; ++dx) {
            const auto at = tile.at(x + dx, y + dy);
            const auto weight = weights.of(at, dx, dy);
            if (!hn::AllFalse(f, is_positive(weight))) with(at, weight);
        }
}

void store(const Sums& sums, float of_none, const FilterRules& rules, FilterTile& tile, int x, int y) {
    const auto has_share = hn::Ne(sums.share, hn::Zero(f));
    const auto at = static_cast<std::size_t>(y * FilterTile::width + x);
    const Floats* const channels[4] = {&sums.value.x, &sums.value.y, &sums.value.z, &sums.share};
    for (std::size_t c = 0; c < 4; ++c) {
        auto value = *channels[c];
        if (rules.ends) value = hn::IfThenElse(has_share, hn::Div(value, sums.share), set(of_none));
        hn::StoreU(value, f, tile.sums[c].data() + at);
    }
}

template <Transport::Materials model, bool balances>
void reconstruct_light(const FilterRules& rules, FilterTile& tile, int x, int y) {
    const auto here = tile.at(x, y);
    const Weights weights(rules, tile, here);
    if (hn::AllFalse(f, weights.exists())) return;
    const auto target = scatterers_at<model>(tile, here);
    const float balance = rules.constants.balance;
    const auto value_of = [&](const FilterTile::Sample& sample, std::size_t at, const Vector3& direction) {
        const auto n_dot_l = dot(target.n, direction);
        const auto counts =
            hn::And(target.is_above(direction, n_dot_l), is_positive(load(sample.density, at)));
        return masked(counts, times(target.value(direction, n_dot_l), load(sample.incoming, at)));
    };
    Sums sums(tile, x, y);
    each_neighbour(tile, weights, x, y, [&](std::size_t at, Floats weight) {
        for (const auto& sample : tile.samples) {
            const auto direction = load(sample.direction, at);
            auto density = load(sample.density, at);
            if constexpr (balances) {
                if (at != here) {
                    const Choosers<model> own(tile, here);
                    density =
                        hn::Mul(mixed(density, own.density(direction), balance), set(1 / (1 - balance)));
                }
            }
            const auto value = value_of(sample, at, direction);
            const auto per_density = hn::Div(set(1), hn::IfThenElse(is_positive(density), density, set(1)));
            sums.add(weight, times(value, per_density), set(1));
        }
        if constexpr (balances) {
            if (at == here) return;
            const Choosers<model> theirs(tile, at);
            for (const auto& sample : tile.samples) {
                const auto direction = load(sample.direction, here);
                const auto own = load(sample.density, here);
                const auto density =
                    hn::Mul(mixed(theirs.density(direction), own, balance), set(1 / balance));
                const auto per_density =
                    hn::Div(set(1), hn::IfThenElse(is_positive(density), density, set(1)));
                sums.add(weight, times(value_of(sample, here, direction), per_density), hn::Zero(f));
            }
        }
    });
    store(sums, 0, rules, tile, x, y);
}

void reconstruct_accessibility(const FilterRules& rules, FilterTile& tile, int x, int y) {
    const auto here = tile.at(x, y);
    const Weights weights(rules, tile, here);
    if (hn::AllFalse(f, weights.exists())) return;
    const auto normal = load(tile.normal, here), geometric_normal = load(tile.geometric_normal, here);
    Sums sums(tile, x, y);
    each_neighbour(tile, weights, x, y, [&](std::size_t at, Floats weight) {
        for (const auto& sample : tile.samples) {
            const auto direction = load(sample.direction, at);
            const auto density = load(sample.density, at);
            const auto is_sample = hn::Ne(density, hn::Zero(f));
            const auto cosine = hn::Max(dot(normal, direction), hn::Zero(f));
            const auto open =
                hn::IfThenElseZero(is_sample, hn::Div(hn::Mul(cosine, set(one_over_pi)), density));
            const auto is_above = is_positive(dot(geometric_normal, direction));
            const auto part = hn::IfThenElseZero(is_above, hn::Mul(load(sample.incoming[0], at), open));
            sums.add(weight, {part, part, part}, rules.ratio ? open : hn::IfThenElseZero(is_sample, set(1)));
        }
    });
    store(sums, 1, rules, tile, x, y);
}

template <Transport::Materials model>
void reconstruct_light_of(const FilterRules& rules, FilterTile& tile, int x, int y) {
    if (rules.has_balance())
        reconstruct_light<model, true>(rules, tile, x, y);
    else
        reconstruct_light<model, false>(rules, tile, x, y);
}

}  // namespace

void reconstruct_all(const FilterRules& rules, FilterTile& tile) {
    using Materials = Transport::Materials;
    for (int y = 0; y < FilterTile::height; ++y)
        for (int x = 0; x < FilterTile::width; x += lanes) {
            if (!rules.light)
                reconstruct_accessibility(rules, tile, x, y);
            else if (rules.materials == Materials::gltf)
                reconstruct_light_of<Materials::gltf>(rules, tile, x, y);
            else if (rules.materials == Materials::metalness_blend)
                reconstruct_light_of<Materials::metalness_blend>(rules, tile, x, y);
            else
                reconstruct_light_of<Materials::lambert>(rules, tile, x, y);
        }
}

}  // namespace ir::passes::bounce::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ir::passes::bounce {

HWY_EXPORT(reconstruct_all);

void reconstruct(const FilterRules& rules, FilterTile& tile) {
    HWY_DYNAMIC_DISPATCH(reconstruct_all)(rules, tile);
}

FilterTile::FilterTile(const FilterRules& rules)
    : radius(rules.constants.radius), across(width + 2 * radius), down(height + 2 * radius) {
    const auto size = static_cast<std::size_t>(across) * static_cast<std::size_t>(down);
    const auto make = [&](auto&... planes) {
        const auto one = [&](auto& plane) {
            if constexpr (std::is_same_v<std::remove_reference_t<decltype(plane)>, Planes>)
                for (auto& part : plane) part.resize(size);
            else
                plane.resize(size);
        };
        (one(planes), ...);
    };
    make(exists, position, blur_normal, geometric_normal, normal);
    if (rules.has_kernels) make(narrowing);
    if (rules.light) make(metallic, roughness, viewer, diffuse, f0, specular, alpha, n_dot_v);
    if (rules.has_balance()) make(raised, raised_cosine, specular_probability);
    samples.resize(static_cast<std::size_t>(rules.constants.samples));
    for (auto& sample : samples) {
        make(sample.direction, sample.density, sample.incoming[0]);
        if (rules.light) make(sample.incoming[1], sample.incoming[2]);
    }
}

}  // namespace ir::passes::bounce
#endif
