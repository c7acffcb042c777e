// BsdfLobes of bsdf.cpp, whose names are used here, for many directions at a time.
#include "renderers/passes/scattering/opaque_lobes.h"

#include "renderers/passes/vectors/targets.h"
#include "renderers/scene/frame.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "renderers/passes/scattering/opaque_lobes.cpp"
#include <hwy/foreach_target.h>

#include "renderers/passes/scattering/scatterers.inl"
#include "renderers/passes/vectors/views.inl"

HWY_BEFORE_NAMESPACE();
namespace ir::passes::HWY_NAMESPACE {
namespace {

using namespace vectors::HWY_NAMESPACE;
using scattering::HWY_NAMESPACE::is_positive;
using scattering::HWY_NAMESPACE::one_over_pi;
using scattering::HWY_NAMESPACE::Scatterers;

HWY_INLINE Floats load(const Lanes& plane, std::size_t at) {
    return hn::LoadU(f, plane.data() + at);
}
HWY_INLINE Vector3 load(const Lanes3& planes, std::size_t at) {
    return {load(planes.x, at), load(planes.y, at), load(planes.z, at)};
}
HWY_INLINE void store(Floats values, Lanes& plane, std::size_t at) {
    hn::StoreU(values, f, plane.data() + at);
}
HWY_INLINE void store(const Vector3& values, Lanes3& planes, std::size_t at) {
    store(values.x, planes.x, at);
    store(values.y, planes.y, at);
    store(values.z, planes.z, at);
}
HWY_INLINE Floats root(Floats x) {
    return hn::Sqrt(hn::Max(x, hn::Zero(f)));
}

template <Transport::Materials model>
struct Lobes {
    const OpaqueLobes& o;
    Scatterers<model> scatterer;

    explicit Lobes(const OpaqueLobes& opaque)
        : o(opaque),
          scatterer{.n = set(o.n),
                    .geometric_n = set(o.geometric_n),
                    .v = set(o.v),
                    .diffuse = set(o.diffuse),
                    .f0 = set(o.f0),
                    .specular = set(o.specular),
                    .alpha = set(o.alpha),
                    .n_dot_v = set(o.n_dot_v)} {}

    /// G1(v) D(h) / (4 n·v)
    HWY_INLINE Floats visible_normal_pdf(const Vector3& l) const {
        const auto sum = plus(set(o.seen_from), l);
        const float squared = o.alpha * o.alpha;
        const float masking =
            1 / (o.seen_cosine + std::sqrt(squared + (1 - squared) * o.seen_cosine * o.seen_cosine));
        const auto density = hn::Mul(set(0.5f * masking), scatterer.distribution_at(normalized(sum)));
        return hn::IfThenElseZero(is_positive(dot(scatterer.n, sum)), density);
    }

    void evaluate(const Lanes3& directions, OpaqueLobes::Values& values, std::size_t at) const {
        const auto l = load(directions, at);
        const auto n_dot_l = dot(scatterer.n, l);
        const auto is_above = is_positive(n_dot_l);
        auto pdf = hn::Mul(set((1 - o.specular_probability) * one_over_pi), n_dot_l);
        if constexpr (Scatterers<model>::has_lobes)
            pdf = hn::MulAdd(set(o.specular_probability), visible_normal_pdf(l), pdf);
        store(hn::IfThenElseZero(is_above, pdf), values.pdf, at);
        const auto counts = scatterer.is_above(l, n_dot_l);
        store(masked(counts, scatterer.value(l, n_dot_l)), values.value, at);
    }

    std::uint32_t choose(const Lanes& lobes, const Lanes2& u, Lanes3& directions) const {
        const auto frame = scene::frame_around(o.n);
        const auto seen_ts = o.seen_from * frame;  // the transpose's product
        const auto stretched = glm::normalize(glm::vec3(o.alpha * seen_ts.x, o.alpha * seen_ts.y, seen_ts.z));
        const float across = std::sqrt(stretched.x * stretched.x + stretched.y * stretched.y);
        const auto first = across > 0 ? glm::vec3(-stretched.y, stretched.x, 0) / across : glm::vec3(1, 0, 0);
        const auto second = glm::cross(stretched, first);
        const float side = 0.5f * (1 + stretched.z);
        std::uint32_t chosen = 0;
        for (std::size_t at = 0; at < lane_count; at += lanes) {
            const auto squared_radius = load(u.x, at);
            const auto radius = hn::Sqrt(squared_radius), phi = hn::Mul(set(2 * pi), load(u.y, at));
            const auto x = hn::Mul(radius, hn::Cos(f, phi)), y = hn::Mul(radius, hn::Sin(f, phi));
            auto l_ts = Vector3{x, y, root(hn::Sub(set(1), squared_radius))};
            auto counts = hn::Eq(x, x);
            const auto to_world = [&](const Vector3& ts) {
                return add_product(set(frame[0]), ts.x,
                                   add_product(set(frame[1]), ts.y, times(set(frame[2]), ts.z)));
            };
            auto l = normalized(to_world(l_ts));
            if constexpr (Scatterers<model>::has_lobes) {
                // sample_visible_normal_ts of microfacets.h
                const auto open = root(hn::NegMulAdd(x, x, set(1)));
                const auto b = hn::MulAdd(set(1 - side), open, hn::Mul(set(side), y));
                const auto c = root(hn::NegMulAdd(b, b, hn::NegMulAdd(x, x, set(1))));
                const auto m =
                    add_product(set(first), x, add_product(set(second), b, times(set(stretched), c)));
                const Vector3 flattened{hn::Mul(set(o.alpha), m.x), hn::Mul(set(o.alpha), m.y),
                                        hn::Max(hn::Zero(f), m.z)};
                const auto h = to_world(normalized(flattened));
                const auto v = set(o.seen_from);
                const auto mirrored = normalized(minus(times(h, hn::Mul(set(2), dot(v, h))), v));
                const auto is_specular = hn::Lt(load(lobes, at), set(o.specular_probability));
                const auto is_reflected = scatterer.is_above(mirrored, dot(scatterer.n, mirrored));
                l = select(is_specular, mirrored, l);
                counts = hn::Or(hn::Not(is_specular), is_reflected);
            }
            store(l, directions, at);
            chosen |= bits_of(counts) << at;
        }
        return chosen;
    }
};

/// Calls `run` with the Lobes of the material's model.
template <class Run>
HWY_INLINE auto with_lobes(const OpaqueLobes& opaque, const Run& run) {
    using Materials = Transport::Materials;
    if (opaque.model == Materials::lambert) return run(Lobes<Materials::lambert>(opaque));
    if (opaque.model == Materials::metalness_blend) return run(Lobes<Materials::metalness_blend>(opaque));
    return run(Lobes<Materials::gltf>(opaque));
}

void evaluate_with_vectors(const OpaqueLobes& opaque, const Lanes3& directions, OpaqueLobes::Values& values) {
    with_lobes(opaque, [&](const auto& lobes) {
        for (std::size_t at = 0; at < lane_count; at += vectors::HWY_NAMESPACE::lanes)
            lobes.evaluate(directions, values, at);
    });
}

std::uint32_t choose_with_vectors(const OpaqueLobes& opaque, const Lanes& choices, const Lanes2& u,
                                  Lanes3& directions) {
    return with_lobes(opaque, [&](const auto& lobes) { return lobes.choose(choices, u, directions); });
}

}  // namespace
}  // namespace ir::passes::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ir::passes {

HWY_EXPORT(evaluate_with_vectors);
HWY_EXPORT(choose_with_vectors);

void OpaqueLobes::evaluate(const Lanes3& directions, Values& values) const {
    HWY_DYNAMIC_DISPATCH(evaluate_with_vectors)(*this, directions, values);
}

std::uint32_t OpaqueLobes::choose(const Lanes& lobes, const Lanes2& u, Lanes3& directions) const {
    return HWY_DYNAMIC_DISPATCH(choose_with_vectors)(*this, lobes, u, directions);
}

}  // namespace ir::passes
#endif
