// What many pixels at a time look for in a map: the questions and rules of shaders/passes/ldm/trace.glsl,
// whose names are used here. [Aalund15 §3.1]
// Read once for each instruction set, within a source that includes <hwy/foreach_target.h>.
#include <cmath>
#include <limits>

#include "renderers/passes/ldm/host/lanes.inl"
#include "renderers/passes/ldm/host/streamed_map.h"
#include "shaders/passes/ldm/fragments.glsl.h"
#include "shaders/passes/ldm/trace.glsl.h"

#if defined(IR_LDM_HOST_QUESTION) == defined(HWY_TARGET_TOGGLE)
#ifdef IR_LDM_HOST_QUESTION
#undef IR_LDM_HOST_QUESTION
#else
#define IR_LDM_HOST_QUESTION
#endif

HWY_BEFORE_NAMESPACE();
namespace ir::passes::ldm::HWY_NAMESPACE {
namespace {

constexpr int pixels = PixelTiles::pixels;

/// As in trace.glsl.
constexpr float near_plane = 1.5f;

struct Vector3 {
    Floats x, y, z;
};

Floats dot(const Vector3& a, const glm::vec4& b) {
    return hn::MulAdd(a.z, hn::Set(f, b.z), hn::MulAdd(a.y, hn::Set(f, b.y), hn::Mul(a.x, hn::Set(f, b.x))));
}
/// dot(a, b.xyz) + b.w
Floats project(const Vector3& a, const glm::vec4& b) {
    return hn::MulAdd(a.z, hn::Set(f, b.z),
                      hn::MulAdd(a.y, hn::Set(f, b.y), hn::MulAdd(a.x, hn::Set(f, b.x), hn::Set(f, b.w))));
}

template <class Values>
Vector3 load(const Values (&axes)[3], std::size_t place) {
    return {hn::LoadU(f, axes[0].data() + place), hn::LoadU(f, axes[1].data() + place),
            hn::LoadU(f, axes[2].data() + place)};
}

/// What does not change within a map.
struct QueriedMap {
    const StreamedMap& map;
    glm::vec4 slope_u, slope_v;  ///< step / metres per quantum
    float texel_quanta, texel_size, reach;
    explicit QueriedMap(const StreamedMap& of, const Visibility& visibility) : map(of) {
        const auto& frame = of.frame;
        slope_u = frame.step_u / frame.direction.w;
        slope_v = frame.step_v / frame.direction.w;
        texel_quanta = StreamedMap::texel_quanta(frame);
        texel_size = texel_quanta * frame.direction.w;
        reach = visibility.max_distance > 0 ? visibility.max_distance / frame.direction.w
                                            : std::numeric_limits<float>::infinity();
    }
};

/// How a surface lies to a map: depth that its tangent plane gains a texel, and the tolerance for entries.
struct Slant {
    Floats per_column, per_row, tolerance;
};

/// What some pixels look for in a map. Depths are counted along ω, from 65535 backwards for -v.
struct Question {
    Floats cosine;        ///< |cosθ| of the shading normal
    Mask forward, above;  ///< ω = v; ω is above the surface
    Mask outside;         ///< of the map: open
    Mask here;            ///< the texel is of this band
    Ints texel;           ///< of the band, where `here`
    Floats plane, start;  ///< depth from which distances count; depth beyond which entries are hits
    Floats tolerance;
    // By the rule tangent-plane:
    Floats own;         ///< depth of the point
    Floats to_u, to_v;  ///< texels from the point to the texel's centre
    Slant slant;
};

Floats along(Mask forward, Floats depth) {
    return hn::IfThenElse(forward, depth, hn::Sub(hn::Set(f, 65535), depth));
}

/// Whether column and row are not texels of the map.
Mask is_outside(Floats column, Floats row, float resolution) {
    const auto zero = hn::Zero(f), end = hn::Set(f, resolution);
    return hn::Or(hn::Or(hn::Lt(column, zero), hn::Ge(column, end)),
                  hn::Or(hn::Lt(row, zero), hn::Ge(row, end)));
}

HWY_INLINE void set_texel(Question& q, const QueriedMap& queried, Floats column, Floats row) {
    const auto resolution = static_cast<float>(queried.map.resolution);
    const auto first = hn::Set(f, static_cast<float>(queried.map.first_row)),
               end = hn::Set(f, static_cast<float>(queried.map.first_row + queried.map.rows));
    q.outside = is_outside(column, row, resolution);
    q.here = hn::AndNot(q.outside, hn::And(hn::Ge(row, first), hn::Lt(row, end)));
    const auto texel = hn::MulAdd(hn::Sub(row, first), hn::Set(f, resolution), column);
    q.texel = hn::ConvertTo(n, hn::IfThenElseZero(q.here, texel));
}

HWY_INLINE Slant slant_of(const QueriedMap& queried, const SelfHitRule& rule, const Vector3& normal,
                          Floats facing) {
    const auto per_facing = hn::Div(hn::Set(f, -1), hn::Max(hn::Abs(facing), hn::Set(f, min_facing)));
    Slant result;
    result.per_column = hn::Mul(dot(normal, queried.slope_u), per_facing);
    result.per_row = hn::Mul(dot(normal, queried.slope_v), per_facing);
    const auto slope = hn::Add(hn::Abs(result.per_column), hn::Abs(result.per_row));
    result.tolerance = hn::Add(
        hn::Set(f, rule.quanta),
        hn::Min(hn::Mul(hn::Set(f, rule.slope), slope), hn::Set(f, max_tolerance * queried.texel_quanta)));
    return result;
}

/// The texel that a point queries, the way to its centre in texels, and what the tangent plane gains up to
/// there. `is_inside`: the point's texel and its neighbours are texels of the map.
struct QueriedTexel {
    Floats column, row, gain, to_u, to_v;
};
template <bool is_inside>
HWY_INLINE QueriedTexel texel_of(const QueriedMap& queried, const SelfHitRule& rule, const Slant& slant,
                                 Floats u, Floats v) {
    const auto zero = hn::Zero(f), one = hn::Set(f, 1), half = hn::Set(f, 0.5f);
    const auto resolution = static_cast<float>(queried.map.resolution);
    QueriedTexel at{hn::Floor(u), hn::Floor(v), zero, zero, zero};
    at.to_u = hn::Sub(hn::Add(at.column, half), u), at.to_v = hn::Sub(hn::Add(at.row, half), v);
    at.gain = hn::MulAdd(slant.per_column, at.to_u, hn::Mul(slant.per_row, at.to_v));
    auto moves = hn::Gt(at.gain, hn::Set(f, rule.max_dip * queried.texel_quanta));
    if constexpr (!is_inside) moves = hn::AndNot(is_outside(at.column, at.row, resolution), moves);
    if (hn::AllFalse(f, moves)) return at;
    const auto along_u = hn::Gt(hn::Abs(slant.per_column), hn::Abs(slant.per_row));
    const auto back_u =
        hn::IfThenElseZero(along_u, hn::IfThenElse(hn::Gt(slant.per_column, zero), hn::Neg(one), one));
    const auto back_v =
        hn::IfThenZeroElse(along_u, hn::IfThenElse(hn::Gt(slant.per_row, zero), hn::Neg(one), one));
    if constexpr (!is_inside)
        moves =
            hn::AndNot(is_outside(hn::Add(at.column, back_u), hn::Add(at.row, back_v), resolution), moves);
    at.column = hn::Add(at.column, hn::IfThenElseZero(moves, back_u));
    at.row = hn::Add(at.row, hn::IfThenElseZero(moves, back_v));
    at.to_u = hn::Add(at.to_u, hn::IfThenElseZero(moves, back_u));
    at.to_v = hn::Add(at.to_v, hn::IfThenElseZero(moves, back_v));
    at.gain = hn::IfThenElse(moves, hn::MulAdd(slant.per_column, at.to_u, hn::Mul(slant.per_row, at.to_v)),
                             at.gain);
    return at;
}
Floats start_of(Floats own, const QueriedTexel& at, const Slant& slant) {
    return hn::Add(own, hn::Max(hn::Add(at.gain, slant.tolerance), hn::Zero(f)));
}

/// ldm_question_tangent
HWY_INLINE void query_tangent(Question& q, const QueriedMap& queried, const SelfHitRule& rule,
                              const Vector3& position, const Vector3& normal, Floats facing) {
    const auto& frame = queried.map.frame;
    q.slant = slant_of(queried, rule, normal, facing);
    const auto at =
        texel_of<false>(queried, rule, q.slant, project(position, frame.u), project(position, frame.v));
    q.own = along(q.forward, project(position, frame.depth));
    q.to_u = at.to_u, q.to_v = at.to_v;
    q.tolerance = q.slant.tolerance;
    q.plane = hn::Add(q.own, at.gain);
    q.start = start_of(q.own, at, q.slant);
    set_texel(q, queried, at.column, at.row);
}

/// ldm_question_offset
void query_offset(Question& q, const QueriedMap& queried, const SelfHitRule& rule, const Vector3& position,
                  const Vector3& normal, Floats facing) {
    const auto& frame = queried.map.frame;
    const auto sine = hn::Sqrt(hn::Max(hn::Zero(f), hn::NegMulAdd(facing, facing, hn::Set(f, 1))));
    const auto distance = hn::Mul(hn::Set(f, rule.offset * queried.texel_size), sine);
    const Vector3 moved{hn::MulAdd(distance, normal.x, position.x),
                        hn::MulAdd(distance, normal.y, position.y),
                        hn::MulAdd(distance, normal.z, position.z)};
    q.tolerance = hn::Zero(f);
    q.plane = q.start = project(moved, frame.depth);  // along v: the rule looks both ways
    set_texel(q, queried, hn::Floor(project(moved, frame.u)), hn::Floor(project(moved, frame.v)));
}

HWY_INLINE Question question(const PixelTiles& tiles, std::size_t place, const QueriedMap& queried,
                             const SelfHitRule& rule) {
    Question q;
    const auto zero = hn::Zero(f);
    const auto geometric_normal = load(tiles.geometric_normal, place);
    const auto cosine = dot(load(tiles.normal, place), queried.map.frame.direction);
    const auto facing = dot(geometric_normal, queried.map.frame.direction);
    q.cosine = hn::Abs(cosine);
    q.forward = hn::Gt(cosine, zero);
    q.above =
        hn::Or(hn::And(q.forward, hn::Gt(facing, zero)), hn::And(hn::Lt(cosine, zero), hn::Lt(facing, zero)));
    const auto position = load(tiles.position, place);
    if (rule.tangent_plane)
        query_tangent(q, queried, rule, position, geometric_normal, facing);
    else
        query_offset(q, queried, rule, position, geometric_normal, facing);
    return q;
}

/// The part of a whole sum that V cosθ is.
Ints part_of_sum(Floats open, Floats cosine, float scale) {
    return hn::NearestInt(hn::Mul(hn::Mul(open, cosine), hn::Set(f, scale)));
}

void add(std::uint32_t* sums, Ints part, Mask which) {
    auto* to = reinterpret_cast<std::int32_t*>(sums);
    hn::StoreU(hn::Add(hn::LoadU(n, to), hn::IfThenElseZero(hn::RebindMask(n, which), part)), n, to);
}

/// floor(depth), as a key: entries beyond it are hits.
Ints key_of(Floats depth) {
    return hn::ConvertTo(n, hn::Floor(hn::Min(hn::Max(depth, hn::Zero(f)), hn::Set(f, ldm_last_depth))));
}

}  // namespace
}  // namespace ir::passes::ldm::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
