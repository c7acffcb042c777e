// Samples of many pixels at a time: shaders/methods/ssdo/samples.glsl, sky.comp and senders.comp, whose names
// are used here and which say what is computed. [Ritschel09]
#include "renderers/methods/ssdo/host/gather_rows.h"

#include <algorithm>
#include <cmath>

#include "renderers/passes/vectors/targets.h"
#include "shaders/methods/ssdo/samples.glsl.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "renderers/methods/ssdo/host/gather_rows.cpp"
#include <hwy/foreach_target.h>

#include "renderers/passes/scattering/scatterers.inl"
#include "renderers/passes/vectors/views.inl"

HWY_BEFORE_NAMESPACE();
namespace ir::methods::ssdo::HWY_NAMESPACE {
namespace {

using namespace passes::vectors::HWY_NAMESPACE;
using namespace passes::scattering::HWY_NAMESPACE;
using passes::vectors::HWY_NAMESPACE::load;

HWY_INLINE Floats load(const PointRow::Plane& plane, std::size_t at) {
    return hn::LoadU(f, plane.data() + at);
}
HWY_INLINE Floats fraction(Floats x) {
    return hn::Sub(x, hn::Floor(x));
}
HWY_INLINE Floats squared(Floats x) {
    return hn::Mul(x, x);
}
HWY_INLINE Floats hypotenuse(Floats a, Floats b) {
    return hn::Sqrt(hn::MulAdd(a, a, hn::Mul(b, b)));
}

template <Transport::Materials model>
struct Points {
    Mask exists, is_lit;
    Vector3 position, tangent, bitangent, geometric_normal, shift;
    Scatterers<model> scatterer;
    Floats all_cosines, rounding;
};

template <Transport::Materials model>
Points<model> points_at(const PointRow& row, std::size_t x, int samples) {
    Points<model> p;
    p.exists = is_positive(load(row.exists, x));
    p.is_lit = is_positive(load(row.is_lit, x));
    p.position = load(row.position, x);
    const auto& g = p.geometric_normal = load(row.geometric_normal, x);
    // frame_around of lib/spaces.glsl
    const auto s = hn::IfThenElse(hn::Ge(g.z, hn::Zero(f)), set(1), set(-1));
    const auto a = hn::Div(set(-1), hn::Add(s, g.z)), b = hn::Mul(hn::Mul(g.x, g.y), a);
    p.tangent = {hn::MulAdd(hn::Mul(s, squared(g.x)), a, set(1)), hn::Mul(s, b), hn::Neg(hn::Mul(s, g.x))};
    p.bitangent = {b, hn::MulAdd(squared(g.y), a, s), hn::Neg(g.y)};
    p.shift = load(row.shift, x);
    p.scatterer = {.n = load(row.normal, x),
                   .geometric_n = g,
                   .v = load(row.viewer, x),
                   .diffuse = load(row.diffuse, x),
                   .f0 = load(row.f0, x),
                   .specular = load(row.specular, x),
                   .alpha = load(row.alpha, x),
                   .n_dot_v = load(row.n_dot_v, x)};
    p.all_cosines = hn::Sub(set(0.5f * static_cast<float>(samples + 1)), p.shift.x);
    p.rounding = length(p.position);
    return p;
}

struct Samples {
    Mask is_outside, is_occluded;
    Vector3 direction;
    Floats place_x, place_y;  ///< middle of the pixel that shows what is there
    Ints pixel;
    Floats layers;  ///< that the end lies behind
};

struct Layers {
    Mask exists, is_entered;
    Vector3 position, normal, facing;
};

struct Occluders {
    Mask sends;
    Vector3 position, facing, to_occluder;
    Floats distance, sending;
};

/// Pieces of the eye's rays.
struct Pieces {
    Floats h, t0, t1, c;
};

template <Transport::Materials model>
class Gather {
  public:
    explicit Gather(const Picture& picture)
        : picture_(picture),
          rays_(picture.constants.rays),
          projection_{picture.constants.pixel_from_world},
          samples_(picture.parameters.samples),
          reach_(picture.constants.reach),
          is_perspective_(rays_.origin_dx == glm::vec3(0)),
          by_density_(picture.parameters.estimator == Estimator::density) {}

    void sky(const PointRow& row, std::span<glm::vec4> sky, std::span<float> accessibility,
             std::span<float> cut) const {
        for (int x = 0; x < picture_.width; x += lanes) {
            const auto p = points_at<model>(row, static_cast<std::size_t>(x), samples_);
            auto light = set(glm::vec3(0));
            auto closed = hn::Zero(f), outside = hn::Zero(f);
            for (int i = 0; i < samples_ && !hn::AllFalse(f, p.exists); ++i) {
                const auto s = sample_of(p, i, false);
                light = plus(light, sky_of(p, s));
                const auto part = hn::Div(dot(p.geometric_normal, s.direction), p.all_cosines);
                closed = hn::Add(closed, hn::IfThenElseZero(s.is_occluded, part));
                outside = hn::Add(outside, hn::IfThenElseZero(s.is_outside, set(1)));
            }
            store(p.exists, light, set(1), sky, x);
            store(hn::Sub(set(1), hn::IfThenElseZero(p.exists, closed)), accessibility, x);
            const auto part = hn::Mul(outside, set(1 / static_cast<float>(samples_)));
            store(hn::IfThenElseZero(p.exists, part), cut, x);
        }
    }

    void indirect(const PointRow& row, std::span<glm::vec4> indirect) const {
        for (int x = 0; x < picture_.width; x += lanes) {
            const auto p = points_at<model>(row, static_cast<std::size_t>(x), samples_);
            auto light = set(glm::vec3(0));
            auto senders = hn::Zero(f);
            for (int i = 0; i < samples_ && !hn::AllFalse(f, p.exists); ++i) {
                const auto s = sample_of(p, i, by_density_);
                for (std::size_t layer = 0; reach_layer(s, layer); ++layer) {
                    const auto o = occluders_of(p, s, layer);
                    if (hn::AllFalse(f, o.sends)) continue;
                    light = plus(light, sent_by(p, s, o, layer));
                    senders = hn::Add(senders, hn::IfThenElseZero(o.sends, set(1)));
                }
            }
            store(p.exists, light, hn::IfThenElseZero(p.exists, senders), indirect, x);
        }
    }

  private:
    using P = Points<model>;

    HWY_INLINE Floats mixed_length(Floats u) const {
        const auto twice = hn::Add(u, u);
        const auto power = hn::Mul(set(std::log(min_length)), hn::Sub(twice, set(1)));
        return hn::IfThenElse(hn::Le(u, set(0.5f)), twice, hn::Exp(f, power));
    }

    Samples sample_of(const P& p, int i, bool mixed) const {
        const auto order = static_cast<float>(i);
        const auto height =
            hn::Sub(set(1), hn::Div(hn::Add(set(order), p.shift.x), set(static_cast<float>(samples_))));
        const auto azimuth = hn::Mul(set(2 * pi), fraction(hn::Add(set(order * r2_azimuth), p.shift.y)));
        auto length_part = hn::Sub(set(1), fraction(hn::Add(set(order * r2_length), p.shift.z)));
        if (mixed) length_part = mixed_length(length_part);
        const auto radius = hn::Sqrt(hn::Max(hn::NegMulAdd(height, height, set(1)), hn::Zero(f)));
        Samples s;
        s.direction = add_product(p.tangent, hn::Mul(radius, hn::Cos(f, azimuth)),
                                  add_product(p.bitangent, hn::Mul(radius, hn::Sin(f, azimuth)),
                                              times(p.geometric_normal, height)));
        look(p, hn::Mul(length_part, set(reach_)), s);
        return s;
    }

    /// What is seen where a step ends.
    HWY_INLINE void look(const P& p, Floats step, Samples& s) const {
        const auto end = add_product(s.direction, step, p.position);
        const auto w = projection_.row(3, end, 1);
        const auto x = hn::Div(projection_.row(0, end, 1), w), y = hn::Div(projection_.row(1, end, 1), w);
        const auto is_within = [](Floats place, int size) {
            return hn::And(hn::Ge(place, hn::Zero(f)), hn::Lt(place, set(static_cast<float>(size))));
        };
        const auto is_inside = hn::And(hn::And(p.exists, is_positive(w)),
                                       hn::And(is_within(x, picture_.width), is_within(y, picture_.height)));
        s.is_outside = hn::AndNot(is_inside, p.exists);
        const auto pixel_x = hn::Floor(x), pixel_y = hn::Floor(y);
        s.place_x = hn::Add(pixel_x, set(0.5f));
        s.place_y = hn::Add(pixel_y, set(0.5f));
        s.pixel = pixel_at(is_inside, pixel_x, pixel_y, picture_.width);
        const auto rounding = hn::Mul(set(-2e-6f), hn::Add(p.rounding, step));
        look_behind(is_inside, end, rounding, s);
    }

    HWY_INLINE void look_behind(Mask is_behind, const Vector3& end, Floats rounding, Samples& s) const {
        s.layers = hn::Zero(f);
        s.is_occluded = is_positive(s.layers);
        for (std::size_t layer = 0; layer < picture_.layers.size(); ++layer) {
            const auto surface = layer_at(s, layer);
            is_behind = hn::And(hn::And(is_behind, surface.exists),
                                hn::Lt(dot(minus(end, surface.position), surface.facing), rounding));
            if (hn::AllFalse(f, is_behind)) break;
            s.layers = hn::Add(s.layers, hn::IfThenElseZero(is_behind, set(1)));
            s.is_occluded =
                hn::Or(hn::And(is_behind, surface.is_entered), hn::AndNot(is_behind, s.is_occluded));
        }
    }

    HWY_INLINE Layers layer_at(const Samples& s, std::size_t layer) const {
        const auto& images = picture_.layers[layer];
        Layers result;
        result.exists = is_positive(look_up(images.positions, s.pixel, 3));
        result.position = look_up(images.positions, s.pixel);
        result.normal = result.facing = look_up(images.normals, s.pixel);
        result.is_entered = hn::Eq(s.place_x, s.place_x);
        if (layer == 0) return result;
        result.is_entered = hn::Lt(dot(result.normal, ray_direction(s)), hn::Zero(f));
        const auto sign = hn::IfThenElse(result.is_entered, set(1), set(-1));
        result.facing = times(result.normal, sign);
        return result;
    }

    /// Whether there is the layer, and an end lies behind it.
    HWY_INLINE bool reach_layer(const Samples& s, std::size_t layer) const {
        return layer < picture_.layers.size() &&
               !hn::AllFalse(f, hn::Gt(s.layers, set(static_cast<float>(layer))));
    }

    /// A layer before the steps' ends: occluder_of, role_of_occluder and sends of samples.glsl.
    HWY_INLINE Occluders occluders_of(const P& p, const Samples& s, std::size_t layer) const {
        const auto surface = layer_at(s, layer);
        Occluders o;
        o.position = surface.position;
        o.facing = surface.facing;
        const auto way = minus(o.position, p.position);
        o.distance = length(way);
        o.to_occluder = times(way, hn::Div(set(1), hn::Max(o.distance, set(1e-30f))));
        o.sending = hn::Neg(dot(surface.normal, o.to_occluder));
        const auto number = set(static_cast<float>(layer + 1));
        o.sends = by_density_ ? hn::Ge(s.layers, number) : hn::And(s.is_occluded, hn::Eq(s.layers, number));
        o.sends = hn::And(hn::And(o.sends, is_positive(o.sending)),
                          p.scatterer.is_above(o.to_occluder, dot(p.scatterer.n, o.to_occluder)));
        const float farthest = picture_.parameters.transport.max_distance;
        if (by_density_ && farthest > 0) o.sends = hn::And(o.sends, hn::Le(o.distance, set(farthest)));
        return o;
    }

    HWY_INLINE Vector3 at_place(const Samples& s, glm::vec3 start, glm::vec3 dx, glm::vec3 dy) const {
        return add_product(set(dx), s.place_x, add_product(set(dy), s.place_y, set(start)));
    }
    HWY_INLINE Vector3 ray_direction(const Samples& s) const {
        return at_place(s, rays_.direction, rays_.direction_dx, rays_.direction_dy);
    }

    HWY_INLINE Vector3 scattered_to_eye(const P& p, const Vector3& direction) const {
        const auto n_dot_l = dot(p.scatterer.n, direction);
        return masked(hn::And(p.is_lit, p.scatterer.is_above(direction, n_dot_l)),
                      p.scatterer.value(direction, n_dot_l));
    }

    HWY_INLINE Vector3 environment(const Vector3& direction) const {
        const auto turns = hn::Mul(atan(hn::Neg(direction.z), hn::Neg(direction.x)), set(0.5f / pi));
        const auto u = hn::IfThenElse(hn::Lt(turns, hn::Zero(f)), hn::Add(turns, set(1)), turns);
        const auto v = hn::Mul(atan(hypotenuse(direction.x, direction.z), direction.y), set(1 / pi));
        const auto texel = [](Floats part, int size) {
            const auto all = static_cast<float>(size);
            return clamped(hn::Floor(hn::Mul(part, set(all))), 0, all - 1);
        };
        const auto all = hn::Eq(u, u);
        return look_up(picture_.environment, pixel_at(all, texel(u, environment_width),
                                                      texel(v, environment_height), environment_width));
    }

    HWY_INLINE Vector3 sky_of(const P& p, const Samples& s) const {
        const auto open = hn::AndNot(s.is_occluded, p.exists);
        const auto light = times(scattered_to_eye(p, s.direction), environment(s.direction));
        return masked(open, times(light, hn::Div(set(pi), p.all_cosines)));
    }

    HWY_INLINE Floats inverse_squares(const Pieces& p, Floats seen_at) const {
        const auto span = hn::Sub(p.t1, p.t0), squared_h = squared(p.h);
        auto sum = hn::Div(atan(hn::Mul(p.h, span), hn::MulAdd(p.t0, p.t1, squared_h)), p.h);
        if (is_perspective_) {
            const auto logarithm =
                hn::Log(f, hn::Div(hn::MulAdd(p.t1, p.t1, squared_h), hn::MulAdd(p.t0, p.t0, squared_h)));
            const auto rest = hn::MulAdd(p.c, logarithm, hn::Mul(hn::Sub(squared(p.c), squared_h), sum));
            sum = hn::Div(hn::Add(span, rest), squared(seen_at));
        }
        return hn::IfThenElseZero(is_positive(span), sum);
    }

    HWY_INLINE Floats inverse_cubes_beyond(const Pieces& p, Floats seen_at) const {
        const auto r0 = hypotenuse(p.h, p.t0), r1 = hypotenuse(p.h, p.t1);
        const auto span = hn::Sub(p.t1, p.t0);
        const auto denominator = hn::Mul(hn::Mul(r0, r1), hn::MulAdd(p.t1, r0, hn::Mul(p.t0, r1)));
        auto sum = hn::Div(hn::Mul(span, hn::Add(p.t1, p.t0)), denominator);
        if (is_perspective_) {
            const auto squares =
                hn::NegMulAdd(squared(p.h), sum, hn::Log(f, hn::Div(hn::Add(p.t1, r1), hn::Add(p.t0, r0))));
            const auto firsts = hn::Sub(hn::Div(set(1), r0), hn::Div(set(1), r1));
            const auto all = hn::MulAdd(squared(p.c), sum, hn::MulAdd(hn::Mul(set(2), p.c), firsts, squares));
            sum = hn::Div(hn::Max(all, hn::Zero(f)), squared(seen_at));
        }
        return hn::IfThenElseZero(is_positive(span), sum);
    }

    HWY_INLINE Floats inverse_cubes(const Pieces& p, Floats seen_at) const {
        const float least = min_length * reach_;
        const auto inner = hn::Sqrt(hn::Max(hn::NegMulAdd(p.h, p.h, set(least * least)), hn::Zero(f)));
        const auto beyond = inverse_cubes_beyond({p.h, hn::Max(p.t0, inner), p.t1, p.c}, seen_at);
        return hn::Add(
            beyond,
            inverse_cubes_beyond({p.h, hn::Max(hn::Neg(p.t1), inner), hn::Neg(p.t0), hn::Neg(p.c)}, seen_at));
    }

    Floats density_of(const P& x, const Samples& s, const Occluders& o, std::size_t layer) const {
        const auto v = normalized(ray_direction(s));
        const auto from_occluder = minus(x.position, o.position);
        Pieces p;
        p.t0 = hn::Neg(dot(v, from_occluder));
        p.h = hn::Max(length(add_product(v, p.t0, from_occluder)), hn::Mul(set(1e-4f), o.distance));
        const auto rim = hn::Sqrt(hn::Max(hn::NegMulAdd(p.h, p.h, set(reach_ * reach_)), hn::Zero(f)));
        const auto falling = hn::Neg(dot(x.geometric_normal, v));
        p.t1 = hn::Max(rim, hn::Add(p.t0, set(0.05f * reach_)));
        const auto lowest = hn::Sub(p.t0, hn::Div(dot(x.geometric_normal, from_occluder), falling));
        p.t1 = hn::IfThenElse(is_positive(falling), hn::Min(p.t1, lowest), p.t1);
        const auto origin = at_place(s, rays_.origin, rays_.origin_dx, rays_.origin_dy);
        const auto seen_at = length(minus(o.position, origin));
        p.c = hn::Sub(seen_at, p.t0);
        const auto cosine = hn::Max(hn::Neg(dot(v, o.facing)), set(layer > 0 ? min_hidden_cosine : 0));
        const auto uniform_lengths = hn::Mul(inverse_squares(p, seen_at), set(1 / reach_));
        const auto logarithmic = hn::Mul(inverse_cubes(p, seen_at), set(-1 / std::log(min_length)));
        return hn::Mul(hn::Mul(cosine, set(0.25f / pi)), hn::Add(uniform_lengths, logarithmic));
    }

    HWY_INLINE Floats area_by_distance(const P& p, const Samples& s, const Occluders& o,
                                       std::size_t layer) const {
        const auto& parameters = picture_.parameters;
        const auto count = static_cast<float>(samples_);
        if (!by_density_) {
            const auto d = hn::Max(o.distance, set(parameters.min_distance * reach_));
            return hn::Div(set(parameters.strength * pi * reach_ * reach_ / count), squared(d));
        }
        const auto density = density_of(p, s, o, layer);
        const auto all = hn::Mul(hn::Mul(set(count), density), squared(o.distance));
        return hn::IfThenElseZero(is_positive(density), hn::Div(set(1), all));
    }

    HWY_INLINE Vector3 sent_by(const P& p, const Samples& s, const Occluders& o, std::size_t layer) const {
        const auto factor = hn::Mul(area_by_distance(p, s, o, layer), o.sending);
        const auto sent = look_up(picture_.layers[layer].senders, s.pixel);
        return masked(o.sends, times(times(scattered_to_eye(p, o.to_occluder), sent), factor));
    }

    void store(Floats values, std::span<float> out, int x) const {
        alignas(64) float parts[lanes];
        hn::Store(values, f, parts);
        std::copy_n(parts, std::min(lanes, picture_.width - x), out.begin() + x);
    }
    void store(Mask exists, const Vector3& colour, Floats alpha, std::span<glm::vec4> out, int x) const {
        alignas(64) float parts[4][lanes];
        const auto kept = masked(exists, colour);
        hn::Store(kept.x, f, parts[0]);
        hn::Store(kept.y, f, parts[1]);
        hn::Store(kept.z, f, parts[2]);
        hn::Store(alpha, f, parts[3]);
        for (int i = 0; i < std::min(lanes, picture_.width - x); ++i)
            out[static_cast<std::size_t>(x + i)] = {parts[0][i], parts[1][i], parts[2][i], parts[3][i]};
    }

    const Picture& picture_;
    const passes::PixelRays& rays_;
    Projection projection_;
    int samples_;
    float reach_;
    bool is_perspective_, by_density_;
};

/// Calls `run` with the Gather of the materials' model.
template <class Run>
void with_gather(const Picture& picture, const Run& run) {
    using Materials = Transport::Materials;
    const auto model = picture.parameters.transport.materials;
    if (model == Materials::lambert)
        run(Gather<Materials::lambert>(picture));
    else if (model == Materials::metalness_blend)
        run(Gather<Materials::metalness_blend>(picture));
    else
        run(Gather<Materials::gltf>(picture));
}

void gather_sky_of(const Picture& picture, const PointRow& row, std::span<glm::vec4> sky,
                   std::span<float> accessibility, std::span<float> cut) {
    with_gather(picture, [&](const auto& gather) { gather.sky(row, sky, accessibility, cut); });
}

void gather_indirect_of(const Picture& picture, const PointRow& row, std::span<glm::vec4> indirect) {
    with_gather(picture, [&](const auto& gather) { gather.indirect(row, indirect); });
}

}  // namespace
}  // namespace ir::methods::ssdo::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ir::methods::ssdo {

HWY_EXPORT(gather_sky_of);
HWY_EXPORT(gather_indirect_of);

void gather_sky(const Picture& picture, const PointRow& row, std::span<glm::vec4> sky,
                std::span<float> accessibility, std::span<float> cut) {
    HWY_DYNAMIC_DISPATCH(gather_sky_of)(picture, row, sky, accessibility, cut);
}

void gather_indirect(const Picture& picture, const PointRow& row, std::span<glm::vec4> indirect) {
    HWY_DYNAMIC_DISPATCH(gather_indirect_of)(picture, row, indirect);
}

PointRow::PointRow(int width) {
    constexpr std::size_t beyond = 16;  // the last vector reads on behind the last pixel
    const auto size = static_cast<std::size_t>(width) + beyond;
    for (auto* plane : {&exists, &is_lit, &specular, &alpha, &n_dot_v}) plane->assign(size, 0.0f);
    for (auto* planes : {&position, &normal, &geometric_normal, &viewer, &diffuse, &f0, &shift})
        for (auto& plane : *planes) plane.assign(size, 0.0f);
}

}  // namespace ir::methods::ssdo
#endif
