// Vectors of three parts, as many at a time as floats.inl has lanes.
// Read once for each instruction set, within a source that includes <hwy/foreach_target.h>.
#include "renderers/passes/vectors/floats.inl"

#if defined(IR_VECTORS_VECTORS3) == defined(HWY_TARGET_TOGGLE)
#ifdef IR_VECTORS_VECTORS3
#undef IR_VECTORS_VECTORS3
#else
#define IR_VECTORS_VECTORS3
#endif

HWY_BEFORE_NAMESPACE();
namespace ir::passes::vectors::HWY_NAMESPACE {
namespace {

HWY_INLINE Floats set(float value) {
    return hn::Set(f, value);
}

struct Vector3 {
    Floats x, y, z;
};
HWY_INLINE Floats dot(const Vector3& a, const Vector3& b) {
    return hn::MulAdd(a.z, b.z, hn::MulAdd(a.y, b.y, hn::Mul(a.x, b.x)));
}
HWY_INLINE Vector3 plus(const Vector3& a, const Vector3& b) {
    return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}
HWY_INLINE Vector3 minus(const Vector3& a, const Vector3& b) {
    return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
HWY_INLINE Vector3 times(const Vector3& a, Floats b) {
    return {hn::Mul(a.x, b), hn::Mul(a.y, b), hn::Mul(a.z, b)};
}
HWY_INLINE Vector3 times(const Vector3& a, const Vector3& b) {
    return {hn::Mul(a.x, b.x), hn::Mul(a.y, b.y), hn::Mul(a.z, b.z)};
}
HWY_INLINE Vector3 masked(Mask where, const Vector3& a) {
    return {hn::IfThenElseZero(where, a.x), hn::IfThenElseZero(where, a.y), hn::IfThenElseZero(where, a.z)};
}
HWY_INLINE Vector3 add_product(const Vector3& a, Floats b, const Vector3& c) {
    return {hn::MulAdd(a.x, b, c.x), hn::MulAdd(a.y, b, c.y), hn::MulAdd(a.z, b, c.z)};
}
HWY_INLINE Vector3 cross(const Vector3& a, const Vector3& b) {
    return {hn::NegMulAdd(a.z, b.y, hn::Mul(a.y, b.z)), hn::NegMulAdd(a.x, b.z, hn::Mul(a.z, b.x)),
            hn::NegMulAdd(a.y, b.x, hn::Mul(a.x, b.y))};
}
HWY_INLINE Floats squared_cross(const Vector3& a, const Vector3& b) {
    const auto c = cross(a, b);
    return dot(c, c);
}
HWY_INLINE Floats length(const Vector3& v) {
    return hn::Sqrt(dot(v, v));
}
HWY_INLINE Vector3 normalized(const Vector3& v) {
    return times(v, hn::Div(set(1), length(v)));
}

}  // namespace
}  // namespace ir::passes::vectors::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
