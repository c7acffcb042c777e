// What passes over pictures need of vectors beside arithmetic: choices, projections and angles.
// Read once for each instruction set, within a source that includes <hwy/foreach_target.h>.
#include <glm/glm.hpp>
#include <span>

#include "renderers/core/constants.h"
#include "renderers/passes/vectors/vectors3.inl"

#include <hwy/contrib/math/math-inl.h>

#if defined(IR_VECTORS_VIEWS) == defined(HWY_TARGET_TOGGLE)
#ifdef IR_VECTORS_VIEWS
#undef IR_VECTORS_VIEWS
#else
#define IR_VECTORS_VIEWS
#endif

HWY_BEFORE_NAMESPACE();
namespace ir::passes::vectors::HWY_NAMESPACE {
namespace {

using IntTag = hn::RebindToSigned<FloatTag>;
using Ints = hn::Vec<IntTag>;
constexpr IntTag n;

HWY_INLINE Vector3 set(glm::vec3 v) {
    return {set(v.x), set(v.y), set(v.z)};
}
HWY_INLINE Vector3 select(Mask where, const Vector3& a, const Vector3& b) {
    return {hn::IfThenElse(where, a.x, b.x), hn::IfThenElse(where, a.y, b.y),
            hn::IfThenElse(where, a.z, b.z)};
}
HWY_INLINE Floats clamped(Floats x, float low, float high) {
    return hn::Min(hn::Max(x, set(low)), set(high));
}
/// From a plane of numbers for each part.
template <class Planes>
HWY_INLINE Vector3 load(const Planes& planes, std::size_t at) {
    return {hn::LoadU(f, planes[0].data() + at), hn::LoadU(f, planes[1].data() + at),
            hn::LoadU(f, planes[2].data() + at)};
}

/// Numbers of pixels; 0 where the place does not count.
HWY_INLINE Ints pixel_at(Mask counts, Floats x, Floats y, int width) {
    return hn::Add(hn::Mul(hn::ConvertTo(n, hn::IfThenElseZero(counts, y)), hn::Set(n, width)),
                   hn::ConvertTo(n, hn::IfThenElseZero(counts, x)));
}
/// One channel of a picture's pixels, and the first three.
HWY_INLINE Floats look_up(std::span<const glm::vec4> picture, Ints pixel, int channel) {
    return hn::GatherIndex(f, &picture.data()->x + channel, hn::ShiftLeft<2>(pixel));
}
HWY_INLINE Vector3 look_up(std::span<const glm::vec4> picture, Ints pixel) {
    return {look_up(picture, pixel, 0), look_up(picture, pixel, 1), look_up(picture, pixel, 2)};
}

/// atan(y / x) in the quadrant of both.
HWY_INLINE Floats atan(Floats y, Floats x) {
    const auto left = hn::Lt(x, hn::Zero(f));
    const auto steep = hn::Gt(hn::Abs(y), hn::Abs(x));
    // Of a ratio of at most 1.
    const auto ratio = hn::Div(hn::IfThenElse(steep, x, y), hn::IfThenElse(steep, y, x));
    const auto nothing = hn::Eq(y, hn::IfThenElse(hn::Eq(x, hn::Zero(f)), hn::Zero(f), set(infinity)));
    const auto part = hn::Atan(f, hn::IfThenElse(nothing, hn::Zero(f), ratio));
    const auto quarter = hn::CopySign(set(0.5f * pi), y), half = hn::CopySign(set(pi), y);
    return hn::IfThenElse(steep, hn::Sub(quarter, part), hn::IfThenElse(left, hn::Add(part, half), part));
}

/// Rows of a matrix' product with (v, w).
struct Projection {
    glm::mat4 matrix;
    HWY_INLINE Floats row(int r, const Vector3& v, float w) const {
        return hn::MulAdd(
            set(matrix[0][r]), v.x,
            hn::MulAdd(set(matrix[1][r]), v.y, hn::MulAdd(set(matrix[2][r]), v.z, set(matrix[3][r] * w))));
    }
};

}  // namespace
}  // namespace ir::passes::vectors::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
