// One level of the edge-avoiding à-trous transform, many pixels at a time:
// shaders/passes/a_trous/a_trous.comp and surface.glsl, whose names are used here. [Smal19 §7.3; Schied17
// §4.3]
#include "renderers/image/luminance.h"
#include "renderers/passes/a_trous/host/filter_planes.h"
#include "renderers/passes/vectors/targets.h"
#include "shaders/passes/a_trous/surface.glsl.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "renderers/passes/a_trous/host/filter_row.cpp"
#include <hwy/foreach_target.h>

#include "renderers/passes/vectors/vectors3.inl"

#include <hwy/contrib/math/math-inl.h>

HWY_BEFORE_NAMESPACE();
namespace ir::passes::a_trous::HWY_NAMESPACE {
namespace {

using namespace vectors::HWY_NAMESPACE;

static_assert(lanes <= FilterPlanes::vector);

Floats load(const std::vector<float>& plane, std::size_t at) {
    return hn::LoadU(f, plane.data() + at);
}

HWY_INLINE Floats dot(const Vector3& a, const glm::vec3& b) {
    return hn::MulAdd(a.z, set(b.z), hn::MulAdd(a.y, set(b.y), hn::Mul(a.x, set(b.x))));
}

HWY_INLINE Vector3 normal_at(const FilterPlanes& planes, std::size_t at) {
    return {load(planes.normal[0], at), load(planes.normal[1], at), load(planes.normal[2], at)};
}

/// The surfaces of some pixels of a row, and how fast their depth changes from pixel to pixel.
struct Surfaces {
    Vector3 normal;
    Floats depth, gradient_x, gradient_y;
    Mask exist;
};

/// depth_gradient, of pixels from `x` on; `stride` pixels are a step.
HWY_INLINE Surfaces surfaces_at(const FilterPlanes& planes, const FilterRules& rules, int x, int y) {
    const auto at = planes.place(x, y);
    Surfaces s;
    s.normal = normal_at(planes, at);
    s.depth = load(planes.depth, at);
    s.exist = hn::Lt(s.depth, set(1e30f));
    const auto& rays = rules.edges.rays;
    const auto column = hn::Iota(f, static_cast<float>(x) + 0.5f);
    const glm::vec3 direction = rays.direction + (static_cast<float>(y) + 0.5f) * rays.direction_dy;
    const auto along = hn::MulAdd(column, dot(s.normal, rays.direction_dx), dot(s.normal, direction));
    const auto facing = hn::Max(hn::Abs(along), set(1e-6f));
    const auto x_part = hn::MulAdd(s.depth, dot(s.normal, rays.direction_dx), dot(s.normal, rays.origin_dx));
    const auto y_part = hn::MulAdd(s.depth, dot(s.normal, rays.direction_dy), dot(s.normal, rays.origin_dy));
    s.gradient_x = hn::Div(x_part, facing);
    s.gradient_y = hn::Div(y_part, facing);
    const auto size = hn::Sqrt(hn::MulAdd(s.gradient_x, s.gradient_x, hn::Mul(s.gradient_y, s.gradient_y)));
    const auto scale = hn::Mul(set(static_cast<float>(rules.stride)),
                               hn::Min(set(1), hn::Div(hn::Mul(set(steepest), s.depth), size)));
    s.gradient_x = hn::Mul(s.gradient_x, scale);
    s.gradient_y = hn::Mul(s.gradient_y, scale);
    return s;
}

/// Logarithm of normal_weight · depth_weight of the pixels at `at`, `offset` steps away.
HWY_INLINE Floats log_weight(const FilterPlanes& planes, const FilterRules& rules, const Surfaces& p,
                             std::size_t at, glm::ivec2 offset) {
    const auto depth = load(planes.depth, at);
    const auto cosine = dot(p.normal, normal_at(planes, at));
    const auto expected = hn::MulAdd(p.gradient_x, set(static_cast<float>(offset.x)),
                                     hn::Mul(p.gradient_y, set(static_cast<float>(offset.y))));
    const auto tolerance =
        hn::MulAdd(set(rules.edges.sigma_depth), hn::Abs(expected), hn::Mul(set(depth_epsilon), p.depth));
    const auto depths = hn::Div(hn::Abs(hn::Sub(hn::Sub(depth, p.depth), expected)), tolerance);
    const auto normals =
        hn::Mul(set(rules.edges.sigma_normal), hn::Log(f, hn::Min(hn::Max(cosine, set(1e-30f)), set(1))));
    const auto counts = hn::And(hn::Lt(depth, set(1e30f)), hn::Gt(cosine, set(0)));
    return hn::IfThenElse(counts, hn::Sub(normals, depths), set(-1e30f));
}

HWY_INLINE Floats exponential(Floats value) {
    return hn::Exp(f, hn::Max(value, set(-200)));
}

/// Calls `visit` with the place and weight of each neighbour but the pixels themselves.
template <class Visit>
HWY_INLINE void for_neighbours(const FilterPlanes& planes, const FilterRules& rules, const Surfaces& p, int x,
                               int y, Visit visit) {
    for (int dy = -kernel_radius; dy <= kernel_radius; ++dy) {
        const int row = y + dy * rules.stride;
        if (row < 0 || row >= planes.height) continue;
        for (int dx = -kernel_radius; dx <= kernel_radius; ++dx) {
            if (dx == 0 && dy == 0) continue;
            const auto at = planes.place(x + dx * rules.stride, row);
            const float kernel = rules.kernel[std::abs(dx)] * rules.kernel[std::abs(dy)];
            visit(at, kernel, log_weight(planes, rules, p, at, {dx, dy}));
        }
    }
}

HWY_INLINE void store(std::vector<float>& row, int x, Mask exist, Floats value) {
    hn::StoreU(hn::IfThenElseZero(exist, value), f, row.data() + x);
}

void unguided(const FilterPlanes& planes, const FilterRules& rules, int y, FilteredRow& result) {
    constexpr int channels = FilterPlanes::channels;
    for (int x = 0; x < planes.width; x += lanes) {
        const auto p = surfaces_at(planes, rules, x, y);
        const auto centre = planes.place(x, y);
        Floats own[channels], m1[channels], m2[channels];
        for (int c = 0; c < channels; ++c) {
            own[c] = load(planes.value[c], centre);
            m1[c] = m2[c] = hn::Zero(f);
        }
        auto total = set(rules.kernel[0] * rules.kernel[0]);
        for_neighbours(planes, rules, p, x, y, [&](std::size_t at, float kernel, Floats logarithm) {
            const auto w = hn::Mul(set(kernel), exponential(logarithm));
            total = hn::Add(total, w);
            for (int c = 0; c < channels; ++c) {
                const auto difference = hn::Sub(load(planes.value[c], at), own[c]);
                const auto weighted = hn::Mul(w, difference);
                m1[c] = hn::Add(m1[c], weighted);
                m2[c] = hn::MulAdd(weighted, difference, m2[c]);
            }
        });
        for (int c = 0; c < channels; ++c) {
            const auto shift = hn::Div(m1[c], total);
            const auto variance = hn::NegMulAdd(shift, shift, hn::Div(m2[c], total));
            const auto bound = hn::Mul(set(rules.detail_clip), hn::Sqrt(hn::Max(variance, hn::Zero(f))));
            const auto next = hn::Add(own[c], shift);
            auto lower = bound;
            if (rules.bounds_dark_details && c < 3)
                lower = hn::Min(bound, hn::Mul(set(4 * rules.detail_clip), hn::Max(own[c], hn::Zero(f))));
            store(result.next[c], x, p.exist, next);
            store(result.clipped[c], x, p.exist, hn::Max(hn::Min(hn::Neg(shift), bound), hn::Neg(lower)));
        }
    }
}

HWY_INLINE Floats luminance(const FilterPlanes& planes, std::size_t at) {
    const auto weight = [](int channel) {
        return set(static_cast<float>(luminance_weights[static_cast<std::size_t>(channel)]));
    };
    return hn::MulAdd(
        load(planes.value[2], at), weight(2),
        hn::MulAdd(load(planes.value[1], at), weight(1), hn::Mul(load(planes.value[0], at), weight(0))));
}

/// Of each pixel what smooth_variance() of a_trous.comp is.
HWY_INLINE Floats smooth_variances(const FilterPlanes& planes, const FilterRules& rules, int x, int y) {
    auto total = hn::Zero(f), sum = hn::Zero(f);
    for (int dy = -1; dy <= 1; ++dy) {
        const int row = y + dy * rules.stride;
        if (row < 0 || row >= planes.height) continue;
        for (int dx = -1; dx <= 1; ++dx) {
            const auto at = planes.place(x + dx * rules.stride, row);
            const auto w = hn::IfThenElseZero(
                hn::Lt(load(planes.depth, at), set(1e30f)),
                set((2 - std::abs(static_cast<float>(dx))) * (2 - std::abs(static_cast<float>(dy)))));
            total = hn::Add(total, w);
            sum = hn::MulAdd(w, load(planes.value[3], at), sum);
        }
    }
    return hn::Div(sum, hn::Max(total, set(1e-30f)));
}

void with_guide(const FilterPlanes& planes, const FilterRules& rules, int y, FilteredRow& result) {
    for (int x = 0; x < planes.width; x += lanes) {
        const auto p = surfaces_at(planes, rules, x, y);
        const auto centre = planes.place(x, y);
        const auto own = luminance(planes, centre);
        const auto deviation = hn::Sqrt(hn::Max(smooth_variances(planes, rules, x, y), hn::Zero(f)));
        const auto tolerance =
            hn::Add(hn::MulAdd(set(rules.sigma_value), deviation, hn::Mul(set(1e-6f), own)), set(1e-20f));
        const float middle = rules.kernel[0] * rules.kernel[0];
        auto total = set(middle);
        Floats sums[4];
        for (int c = 0; c < 4; ++c)
            sums[c] = hn::Mul(set(c < 3 ? middle : middle * middle), load(planes.value[c], centre));
        for_neighbours(planes, rules, p, x, y, [&](std::size_t at, float kernel, Floats logarithm) {
            const auto apart = hn::Div(hn::Abs(hn::Sub(luminance(planes, at), own)), tolerance);
            const auto w = hn::Mul(set(kernel), exponential(hn::Sub(logarithm, apart)));
            total = hn::Add(total, w);
            for (int c = 0; c < 3; ++c) sums[c] = hn::MulAdd(w, load(planes.value[c], at), sums[c]);
            sums[3] = hn::MulAdd(hn::Mul(w, w), load(planes.value[3], at), sums[3]);
        });
        for (int c = 0; c < 4; ++c)
            store(result.next[c], x, p.exist, hn::Div(sums[c], c < 3 ? total : hn::Mul(total, total)));
    }
}

}  // namespace

void row(const FilterPlanes& planes, const FilterRules& rules, int y, FilteredRow& result) {
    unguided(planes, rules, y, result);
}
void guided_row(const FilterPlanes& planes, const FilterRules& rules, int y, FilteredRow& result) {
    with_guide(planes, rules, y, result);
}

}  // namespace ir::passes::a_trous::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ir::passes::a_trous {

HWY_EXPORT(row);
HWY_EXPORT(guided_row);

void filter_row(const FilterPlanes& planes, const FilterRules& rules, int y, FilteredRow& result) {
    HWY_DYNAMIC_DISPATCH(row)(planes, rules, y, result);
}
void filter_guided_row(const FilterPlanes& planes, const FilterRules& rules, int y, FilteredRow& result) {
    HWY_DYNAMIC_DISPATCH(guided_row)(planes, rules, y, result);
}

}  // namespace ir::passes::a_trous
#endif
