// How surfaces reflect, as many at a time as floats.inl has lanes: shaders/lib/scattering.glsl, whose names
// are used here. Read once for each instruction set, within a source that includes <hwy/foreach_target.h>.
#include <numbers>

#include "renderers/core/transport.h"
#include "renderers/passes/vectors/vectors3.inl"

#if defined(IR_SCATTERERS) == defined(HWY_TARGET_TOGGLE)
#ifdef IR_SCATTERERS
#undef IR_SCATTERERS
#else
#define IR_SCATTERERS
#endif

HWY_BEFORE_NAMESPACE();
namespace ir::passes::scattering::HWY_NAMESPACE {
namespace {

using namespace vectors::HWY_NAMESPACE;

constexpr float one_over_pi = std::numbers::inv_pi_v<float>;

HWY_INLINE Mask is_positive(Floats a) {
    return hn::Gt(a, hn::Zero(f));
}
HWY_INLINE Floats clamped(Floats a) {
    return hn::Min(hn::Max(a, hn::Zero(f)), set(1));
}

/// `has_lobes` is not so of Lambert's model, and `is_layered` only of glTF's. Mirrors have `specular` 0.
template <Transport::Materials model>
struct Scatterers {
    static constexpr bool has_lobes = model != Transport::Materials::lambert;
    static constexpr bool is_layered = model == Transport::Materials::gltf;

    Vector3 n, geometric_n, v, diffuse, f0;
    Floats specular, alpha, n_dot_v;

    Mask is_above(const Vector3& l, Floats n_dot_l) const {
        return hn::And(is_positive(n_dot_l), is_positive(dot(geometric_n, l)));
    }

    /// joint_masking over 4 (n·l)(n·v)
    HWY_INLINE Floats masking(Floats n_dot_l) const {
        const auto squared = hn::Mul(alpha, alpha), rest = hn::Sub(set(1), squared);
        const auto root = [&](Floats cosine) {
            return hn::Sqrt(hn::MulAdd(hn::Mul(cosine, cosine), rest, squared));
        };
        if constexpr (is_layered) {
            const auto sum = hn::MulAdd(n_dot_l, root(n_dot_v), hn::Mul(n_dot_v, root(n_dot_l)));
            return hn::Div(set(0.5f), hn::Max(sum, set(1e-7f)));
        } else {
            const auto product = hn::Mul(hn::Add(n_dot_l, root(n_dot_l)), hn::Add(n_dot_v, root(n_dot_v)));
            return hn::Div(set(1), product);
        }
    }

    /// scattering_value: f cosθ
    HWY_INLINE Vector3 value(const Vector3& l, Floats n_dot_l) const {
        if constexpr (!has_lobes) return times(diffuse, hn::Mul(n_dot_l, set(one_over_pi)));
        const auto sum = plus(l, v);
        const auto size = hn::Sqrt(dot(sum, sum));
        const auto has_size = is_positive(size);
        const auto scale = hn::Div(set(1), hn::IfThenElse(has_size, size, set(1)));
        const auto half = times(sum, scale);
        const Vector3 h{hn::IfThenElse(has_size, half.x, n.x), hn::IfThenElse(has_size, half.y, n.y),
                        hn::IfThenElse(has_size, half.z, n.z)};
        const auto x = hn::Sub(set(1), clamped(dot(v, h)));
        const auto x2 = hn::Mul(x, x), x5 = hn::Mul(hn::Mul(x2, x2), x);
        const auto fresnel_of = [&](Floats r) { return hn::MulAdd(hn::Sub(set(1), r), x5, r); };
        const Vector3 fresnel{fresnel_of(f0.x), fresnel_of(f0.y), fresnel_of(f0.z)};
        auto below = diffuse;
        if constexpr (is_layered)
            below = {hn::NegMulAdd(fresnel.x, below.x, below.x), hn::NegMulAdd(fresnel.y, below.y, below.y),
                     hn::NegMulAdd(fresnel.z, below.z, below.z)};
        const auto lobe = hn::Mul(specular, hn::Mul(distribution_at(h), masking(n_dot_l)));
        return times(add_product(fresnel, lobe, times(below, set(one_over_pi))), n_dot_l);
    }

    HWY_INLINE Floats distribution_at(const Vector3& h) const {
        const auto sine = hn::IfThenElse(is_positive(dot(n, h)), squared_cross(n, h), set(1));
        const auto squared = hn::Mul(alpha, alpha);
        const auto denominator = hn::MulAdd(hn::Sub(set(1), squared), sine, squared);
        return hn::Div(hn::Mul(squared, set(one_over_pi)), hn::Mul(denominator, denominator));
    }
};

}  // namespace
}  // namespace ir::passes::scattering::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
