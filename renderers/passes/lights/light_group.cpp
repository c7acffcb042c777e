#include "renderers/passes/lights/light_group.h"

#include "renderers/passes/raytracing/ray_offset.h"
#include "renderers/passes/vectors/targets.h"
#include "shaders/passes/lights/light_tree.glsl.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "renderers/passes/lights/light_group.cpp"
#include <hwy/foreach_target.h>

#include "renderers/passes/vectors/views.inl"

HWY_BEFORE_NAMESPACE();
namespace ir::passes::HWY_NAMESPACE {
namespace {

using namespace vectors::HWY_NAMESPACE;

static_assert(LightGroup::capacity % lanes == 0);

HWY_INLINE Floats load(const LightGroup::Plane& plane, int at) {
    return hn::LoadU(f, plane.data() + at);
}
HWY_INLINE Vector3 load(const std::array<LightGroup::Plane, 3>& planes, int at) {
    return vectors::HWY_NAMESPACE::load(planes, static_cast<std::size_t>(at));
}

/// cos and sin of max(0, a - b) for angles from 0 to π, given by their own.
struct Angle {
    Floats cosine, sine;
};
HWY_INLINE Angle reduced(const Angle& a, const Angle& b) {
    const auto is_less = hn::Ge(a.cosine, b.cosine);
    return {hn::IfThenElse(is_less, set(1), hn::MulAdd(a.cosine, b.cosine, hn::Mul(a.sine, b.sine))),
            hn::IfThenZeroElse(is_less, hn::NegMulAdd(a.cosine, b.sine, hn::Mul(a.sine, b.cosine)))};
}
HWY_INLINE Angle with_cosine(Floats cosine) {
    return {cosine, hn::Sqrt(hn::Max(hn::NegMulAdd(cosine, cosine, set(1)), hn::Zero(f)))};
}

/// Bound of the irradiance from a group: intensity * cos θ' * cos θi' / distance², the angles the least
/// that any of its lights may have.  [Conty18 §5]
HWY_INLINE Floats importance(const LightGroup& group, int at, glm::vec3 position_ws, glm::vec3 normal_ws) {
    const auto min_squared = set(1e-16f);  // keeps the quotient finite
    const auto offset = minus(set(position_ws), load(group.centre, at));
    const auto squared = dot(offset, offset), squared_radius = load(group.squared_radius, at);
    const auto intensity = load(group.intensity, at);
    const auto within = hn::Div(intensity, hn::Max(squared_radius, min_squared));
    const auto is_within = hn::Le(squared, squared_radius);

    const auto direction = times(offset, hn::Div(set(1), hn::Sqrt(squared)));
    const auto squared_sine = hn::Div(squared_radius, squared);
    const Angle box{hn::Sqrt(hn::Sub(set(1), squared_sine)), hn::Sqrt(squared_sine)};
    const auto cosine = dot(load(group.axis, at), direction);
    const auto is_two_sided = hn::Gt(load(group.two_sided, at), hn::Zero(f));
    const auto normals = Angle{load(group.cos_normals, at), load(group.sin_normals, at)};
    const auto beyond_normals =
        reduced(with_cosine(hn::IfThenElse(is_two_sided, hn::Abs(cosine), cosine)), normals);
    const auto emitted = reduced(beyond_normals, box).cosine;
    auto result = hn::Div(hn::Mul(intensity, emitted), hn::Max(squared, min_squared));
    if (normal_ws != glm::vec3(0)) {
        const auto received = reduced(with_cosine(hn::Neg(dot(direction, set(normal_ws)))), box).cosine;
        result = hn::Mul(result, hn::Max(received, hn::Zero(f)));
    }
    result = hn::IfThenElseZero(hn::Gt(emitted, load(group.cos_emission, at)), result);
    return hn::IfThenElse(is_within, within, result);
}

void weigh_with_vectors(const LightGroup& group, glm::vec3 position_ws, glm::vec3 normal_ws,
                        LightWeights& weights) {
    auto sum = hn::Zero(f);
    for (int at = 0; at < LightGroup::capacity; at += lanes) {
        auto part = hn::Zero(f);
        if (at < group.count) {
            const auto counts = hn::FirstN(f, static_cast<std::size_t>(group.count - at));
            part = hn::IfThenElseZero(counts, importance(group, at, position_ws, normal_ws));
        }
        hn::StoreU(part, f, weights.of.data() + at);
        sum = hn::Add(sum, part);
    }
    weights.sum = hn::GetLane(hn::SumOfLanes(f, sum));
}

std::uint32_t meet_with_vectors(const LightGroup& group, glm::vec3 origin_ws, glm::vec3 direction_ws) {
    constexpr float least = static_cast<float>(max_panes) * min_ray_offset_m;
    const auto direction = set(direction_ws);
    std::uint32_t met = 0;
    for (int at = 0; at < group.count; at += lanes) {
        const auto centre = load(group.centre, at), offset = minus(centre, set(origin_ws));
        const auto rounding =
            hn::MulAdd(set(meeting_room), hn::Add(length(offset), length(centre)), set(least));
        const auto reach = hn::Add(hn::Sqrt(load(group.squared_radius, at)), rounding);
        // where the ray comes closest to the centre
        const auto along = hn::Max(dot(offset, direction), hn::Zero(f));
        const auto closest = add_product(direction, hn::Neg(along), offset);
        met |= bits_of(hn::Le(dot(closest, closest), hn::Mul(reach, reach))) << at;
    }
    return met & ((1u << group.count) - 1);
}

}  // namespace
}  // namespace ir::passes::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ir::passes {

HWY_EXPORT(weigh_with_vectors);
HWY_EXPORT(meet_with_vectors);

void weigh(const LightGroup& group, glm::vec3 position_ws, glm::vec3 normal_ws, LightWeights& weights) {
    HWY_DYNAMIC_DISPATCH(weigh_with_vectors)(group, position_ws, normal_ws, weights);
}

std::uint32_t may_meet(const LightGroup& group, glm::vec3 origin_ws, glm::vec3 direction_ws) {
    return HWY_DYNAMIC_DISPATCH(meet_with_vectors)(group, origin_ws, direction_ws);
}

}  // namespace ir::passes
#endif
