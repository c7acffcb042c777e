// Horizons on the host, many pixels at a time: shaders/methods/hbao/march.comp and march.glsl, whose names
// are used here and which say what is computed. [Bavoil08]
#include "renderers/methods/hbao/host/march_pixels.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "renderers/passes/sampling/pattern_shift.h"
#include "renderers/passes/sampling/pcg.h"
#include "renderers/passes/vectors/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "renderers/methods/hbao/host/march_pixels.cpp"
#include <hwy/foreach_target.h>

#include "renderers/passes/vectors/views.inl"

HWY_BEFORE_NAMESPACE();
namespace ir::methods::hbao::HWY_NAMESPACE {
namespace {

using namespace passes::vectors::HWY_NAMESPACE;

/// An angle with what is computed of it.
struct Angle {
    Floats value, sine, cosine;
};
HWY_INLINE Angle angle_of(Floats value) {
    return {value, hn::Sin(f, value), hn::Cos(f, value)};
}
HWY_INLINE Angle select(Mask where, const Angle& a, const Angle& b) {
    return {hn::IfThenElse(where, a.value, b.value), hn::IfThenElse(where, a.sine, b.sine),
            hn::IfThenElse(where, a.cosine, b.cosine)};
}

/// Some pixels beside each other.
struct Points {
    Mask exists;
    Floats pixel_x;
    float pixel_y = 0;
    Vector3 position, normal, geometric_normal, zenith, across, down;
    Floats view_distance, here_w, position_length;
    Floats turn, shift;
};

struct Slices {
    Vector3 direction;
    Angle tangent, first, last;
    Floats normal_x, normal_y;  ///< the shading normal's cosines with v and d
    Floats direction_x, direction_y, length_px, steps;
    Mask cut;
};

class March {
  public:
    March(const MarchRules& rules, const MarchedSurfaces& surfaces)
        : rules_(rules),
          parameters_(rules.parameters),
          surfaces_(surfaces),
          projection_{rules.constants.pixel_from_world},
          is_perspective_(rules.constants.rays.origin_dx == glm::vec3(0)),
          published_(rules.parameters.weighting == Weighting::published),
          max_distance_(rules.parameters.transport.max_distance),
          bias_(rules.parameters.angle_bias * pi / 180),
          bias_sine_(std::sin(bias_)) {}

    void row(int y, std::span<glm::vec4> sums) const {
        for (int x = 0; x < rules_.width; x += lanes) {
            const auto points = points_at(x, y);
            Floats open = hn::Zero(f), all = open, cut = open, samples = open;
            if (!hn::AllFalse(f, points.exists))
                for (int i = 0; i < parameters_.directions; ++i) add(points, i, open, all, cut, samples);
            alignas(64) float parts[4][lanes];
            const Floats of[] = {open, all, cut, samples};
            for (int part = 0; part < 4; ++part)
                hn::Store(hn::IfThenElseZero(points.exists, of[part]), f, parts[part]);
            for (int i = 0; i < std::min(lanes, rules_.width - x); ++i)
                sums[static_cast<std::size_t>(x + i)] = {parts[0][i], parts[1][i], parts[2][i], parts[3][i]};
        }
    }

  private:
    Points points_at(int x, int y) const {
        const auto& rays = rules_.constants.rays;
        const auto at = static_cast<std::size_t>(y) * static_cast<std::size_t>(rules_.width) +
                        static_cast<std::size_t>(x);
        Points p;
        p.geometric_normal = load(surfaces_.geometric_normal, at);
        p.exists = hn::Gt(dot(p.geometric_normal, p.geometric_normal), hn::Zero(f));
        p.position = select(p.exists, load(surfaces_.position, at), set(glm::vec3(0)));
        p.normal = normalized(load(surfaces_.normal, at));
        const auto is_plane = hn::Gt(dot(p.normal, p.geometric_normal), set(1 - 1e-6f));
        p.normal = select(is_plane, p.geometric_normal, p.normal);
        p.pixel_x = hn::Iota(f, static_cast<float>(x));
        p.pixel_y = static_cast<float>(y);
        const auto middle = hn::Add(p.pixel_x, set(0.5f));
        const auto column = set(rays.direction + (p.pixel_y + 0.5f) * rays.direction_dy);
        p.zenith = times(normalized(add_product(set(rays.direction_dx), middle, column)), set(-1));
        const auto along = set(rays.origin_dx + rays.direction_dx);
        p.across = normalized(minus(along, times(p.zenith, dot(along, p.zenith))));
        p.down = cross(p.zenith, p.across);
        p.view_distance = is_perspective_ ? length(minus(p.position, set(rays.origin))) : set(infinity);
        p.here_w = projection_.row(3, p.position, 1);
        p.position_length = length(p.position);
        set_shift(p, x, y);
        return p;
    }

    void set_shift(Points& p, int first_x, int y) const {
        alignas(64) float turn[lanes], shift[lanes];
        for (int i = 0; i < lanes; ++i) {
            const glm::ivec2 pixel(first_x + i, y);
            turn[i] = 0, shift[i] = 1;
            if (parameters_.turning == Turning::pattern) {
                const auto shifts = passes::pattern_shift(pixel);
                turn[i] = shifts.x, shift[i] = shifts.y;
            } else if (parameters_.turning == Turning::hash) {
                const auto bits = passes::pcg2d(glm::uvec2(pixel));
                turn[i] = passes::unit_float(bits.x), shift[i] = passes::unit_float(bits.y);
            }
        }
        p.turn = hn::Load(f, turn);
        p.shift = hn::Load(f, shift);
    }

    Slices slices_of(const Points& p, int index) const {
        const auto azimuth = hn::Mul(hn::Add(p.turn, set(static_cast<float>(index))),
                                     set(2 * pi / static_cast<float>(parameters_.directions)));
        Slices s;
        s.direction = plus(times(p.across, hn::Cos(f, azimuth)), times(p.down, hn::Sin(f, azimuth)));
        s.normal_x = dot(p.normal, p.zenith);
        s.normal_y = dot(p.normal, s.direction);
        const auto middle = atan(s.normal_y, s.normal_x);
        s.first = angle_of(clamped(hn::Sub(middle, set(0.5f * pi)), 0, pi));
        s.last = angle_of(clamped(hn::Add(middle, set(0.5f * pi)), 0, pi));
        const auto rise = hn::Max(dot(p.geometric_normal, p.zenith), hn::Zero(f));
        s.tangent = angle_of(
            clamped(hn::Add(atan(dot(p.geometric_normal, s.direction), rise), set(0.5f * pi)), 0, pi));
        aim(s, p);
        return s;
    }

    void aim(Slices& s, const Points& p) const {
        const auto start_x = hn::Add(p.pixel_x, set(0.5f)), start_y = set(p.pixel_y + 0.5f);
        const auto w = projection_.row(3, s.direction, 0);
        const auto step_x = hn::Div(hn::NegMulAdd(start_x, w, projection_.row(0, s.direction, 0)), p.here_w);
        const auto step_y = hn::Div(hn::NegMulAdd(start_y, w, projection_.row(1, s.direction, 0)), p.here_w);
        const auto size = hn::Sqrt(hn::MulAdd(step_x, step_x, hn::Mul(step_y, step_y)));
        s.direction_x = hn::Div(step_x, size);
        s.direction_y = hn::Div(step_y, size);
        const auto reach = hn::Max(reach_px(s, p, start_x, start_y, size), set(1));
        const auto picture = hn::Min(picture_px(start_x, s.direction_x, static_cast<float>(rules_.width)),
                                     picture_px(start_y, s.direction_y, static_cast<float>(rules_.height)));
        s.cut = hn::Gt(reach, picture);
        s.length_px = hn::Min(reach, picture);
        s.steps = hn::Min(set(static_cast<float>(parameters_.steps)), hn::Ceil(s.length_px));
    }

    Floats reach_px(const Slices& s, const Points& p, Floats start_x, Floats start_y, Floats step) const {
        if (max_distance_ == 0) return set(infinity);
        if (!is_perspective_) return hn::Mul(step, set(max_distance_));
        const auto part = hn::Div(set(max_distance_), p.view_distance);
        const auto depth = hn::Sqrt(hn::Max(hn::NegMulAdd(part, part, set(1)), hn::Zero(f)));
        const auto edge = minus(times(s.direction, part), times(p.zenith, depth));
        const auto w = projection_.row(3, edge, 0);
        const auto x = hn::Sub(hn::Div(projection_.row(0, edge, 0), w), start_x),
                   y = hn::Sub(hn::Div(projection_.row(1, edge, 0), w), start_y);
        const auto is_limited = hn::And(hn::Lt(part, set(1)), hn::Gt(w, hn::Zero(f)));
        return hn::IfThenElse(is_limited, hn::Sqrt(hn::MulAdd(x, x, hn::Mul(y, y))), set(infinity));
    }

    /// Pixels along one axis until the last pixel's middle.
    HWY_INLINE Floats picture_px(Floats start, Floats direction, float size) const {
        const auto end = hn::IfThenElse(hn::Gt(direction, hn::Zero(f)), set(size - 0.5f), set(0.5f));
        return hn::IfThenElse(hn::Eq(direction, hn::Zero(f)), set(infinity),
                              hn::Div(hn::Sub(end, start), direction));
    }

    HWY_INLINE Floats primitive(const Slices& s, const Angle& a) const {
        const auto turned = hn::NegMulAdd(a.sine, a.cosine, a.value);
        return hn::Mul(set(0.5f),
                       hn::MulAdd(s.normal_x, hn::Mul(a.sine, a.sine), hn::Mul(s.normal_y, turned)));
    }

    HWY_INLINE Floats weight_up_to(const Slices& s, const Angle& angle) const {
        if (published_) return hn::Sub(set(1), angle.cosine);
        const auto below = select(hn::Lt(angle.value, s.last.value), angle, s.last);
        const auto a = select(hn::Gt(below.value, s.first.value), below, s.first);
        return hn::IfThenElseZero(hn::Gt(s.last.value, s.first.value),
                                  hn::Sub(primitive(s, a), primitive(s, s.first)));
    }

    void add(const Points& p, int index, Floats& open, Floats& all, Floats& cut, Floats& samples) const {
        const auto s = slices_of(p, index);
        const auto start =
            published_ ? angle_of(hn::Max(hn::Sub(s.tangent.value, set(bias_)), hn::Zero(f))) : s.tangent;
        const auto first = weight_up_to(s, start);
        auto horizon = start.cosine, above = first, closed = hn::Zero(f);
        const auto length_of_step = hn::Div(s.length_px, s.steps);
        const auto most = hn::GetLane(hn::MaxOfLanes(f, hn::IfThenElseZero(p.exists, s.steps)));
        for (float step = 0; step < most; ++step) {
            const auto t = hn::Mul(hn::Add(set(step), p.shift), length_of_step);
            raise(p, s, hn::And(p.exists, hn::Lt(set(step), s.steps)), hn::Max(t, set(1)), horizon, above,
                  closed);
        }
        open = hn::Add(open, hn::Sub(first, closed));
        all = hn::Add(all, published_ ? first : weight_up_to(s, s.last));
        cut = hn::Add(cut, hn::IfThenElseZero(s.cut, set(1)));
        samples = hn::Add(samples, s.steps);
    }

    /// One sample of each pixel. Its angle is only computed where it raises the horizon; until then cosines
    /// do.
    HWY_INLINE void raise(const Points& p, const Slices& s, Mask takes, Floats t, Floats& horizon,
                          Floats& above, Floats& closed) const {
        const auto width = static_cast<float>(rules_.width), height = static_cast<float>(rules_.height);
        const auto x =
            clamped(hn::Floor(hn::MulAdd(t, s.direction_x, hn::Add(p.pixel_x, set(0.5f)))), 0, width - 1);
        const auto y = clamped(hn::Floor(hn::MulAdd(t, s.direction_y, set(p.pixel_y + 0.5f))), 0, height - 1);
        const auto at = pixel_at(takes, x, y, rules_.width);
        const Vector3 position{hn::GatherIndex(f, surfaces_.position[0].data(), at),
                               hn::GatherIndex(f, surfaces_.position[1].data(), at),
                               hn::GatherIndex(f, surfaces_.position[2].data(), at)};
        const auto way = minus(position, p.position);
        const auto distance = length(way);
        const auto cosine = clamped(hn::Div(dot(way, p.zenith), hn::Max(distance, set(1e-30f))), -1, 1);
        const auto rounding = hn::Mul(set(2e-6f), hn::Add(p.position_length, distance));
        // All false where there is no surface.
        auto raises =
            hn::And(hn::Gt(dot(way, p.geometric_normal), hn::MulAdd(set(bias_sine_), distance, rounding)),
                    hn::Gt(cosine, horizon));
        if (max_distance_ > 0) raises = hn::And(raises, hn::Lt(distance, set(max_distance_)));
        const auto is_itself = hn::And(hn::Eq(x, p.pixel_x), hn::Eq(y, set(p.pixel_y)));
        raises = hn::And(hn::And(raises, takes), hn::Not(is_itself));
        if (hn::AllFalse(f, raises)) return;
        const auto safe = hn::IfThenElseZero(raises, cosine);
        const auto sine = hn::Sqrt(hn::Max(hn::NegMulAdd(safe, safe, set(1)), hn::Zero(f)));
        const auto still = weight_up_to(s, {published_ ? safe : hn::Acos(f, safe), sine, safe});
        const auto taken = hn::Mul(occlusion(distance), hn::Sub(above, still));
        closed = hn::Add(closed, hn::IfThenElseZero(raises, taken));
        above = hn::IfThenElse(raises, still, above);
        horizon = hn::IfThenElse(raises, cosine, horizon);
    }

    HWY_INLINE Floats occlusion(Floats distance) const {
        if (max_distance_ == 0 || parameters_.transport.falloff == Transport::Falloff::hard) return set(1);
        const auto part = hn::Div(distance, set(max_distance_));
        return hn::NegMulAdd(part, part, set(1));
    }

    const MarchRules& rules_;
    const Parameters& parameters_;
    const MarchedSurfaces& surfaces_;
    Projection projection_;
    bool is_perspective_, published_;
    float max_distance_, bias_, bias_sine_;
};

void march_row_of(const MarchRules& rules, const MarchedSurfaces& surfaces, int y,
                  std::span<glm::vec4> sums) {
    March(rules, surfaces).row(y, sums);
}

}  // namespace
}  // namespace ir::methods::hbao::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ir::methods::hbao {

HWY_EXPORT(march_row_of);

void march_row(const MarchRules& rules, const MarchedSurfaces& surfaces, int y, std::span<glm::vec4> sums) {
    HWY_DYNAMIC_DISPATCH(march_row_of)(rules, surfaces, y, sums);
}

MarchedSurfaces::MarchedSurfaces(int width, int height) {
    constexpr std::size_t beyond = 16;  // the last vector reads on behind the last pixel
    const auto size = static_cast<std::size_t>(width) * static_cast<std::size_t>(height) + beyond;
    for (auto& plane : position) plane.assign(size, std::numeric_limits<float>::quiet_NaN());
    for (auto* planes : {&normal, &geometric_normal})
        for (auto& plane : *planes) plane.assign(size, 0.0f);
}

void MarchedSurfaces::set(std::size_t pixel, const glm::vec4& at, glm::vec3 shading, glm::vec3 geometric) {
    for (int i = 0; i < 3; ++i) {
        const auto part = static_cast<std::size_t>(i);
        position[part][pixel] = at.w > 0 ? at[i] : std::numeric_limits<float>::quiet_NaN();
        normal[part][pixel] = shading[i];
        geometric_normal[part][pixel] = geometric[i];
    }
}

}  // namespace ir::methods::hbao
#endif
