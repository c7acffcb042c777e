#include "renderers/methods/deep-screen-space/surfels/host/curve.h"

#include <algorithm>
#include <cmath>

#include "renderers/core/constants.h"
#include "renderers/passes/sampling/pcg.h"
#include "renderers/passes/surface/triangle_plane.h"

namespace ir::methods::deep_screen_space {
namespace {

std::uint32_t place_of(glm::uvec2 corner, bool is_turned) {
    return corner.x | corner.y << 12 | (is_turned ? 1u << 24 : 0u);
}
glm::uvec2 corner_of(const Patch& p) {
    return {p.place & 4095u, p.place >> 12 & 4095u};
}
bool is_turned(const Patch& p) {
    return (p.place >> 24 & 1u) != 0;
}

glm::vec2 weights_in(const Patch& p, glm::vec2 uv) {
    const auto corner = glm::vec2(corner_of(p));
    return (is_turned(p) ? corner + 1.0f - uv : corner + uv) / static_cast<float>(p.splits);
}

Patch part_of(const Patch& p, std::uint32_t splits, glm::uvec2 corner, bool turned) {
    const auto base = corner_of(p);
    const auto part = is_turned(p) ? (base + 1u) * splits - corner - 1u : base * splits + corner;
    return {p.triangle, p.splits * splits, place_of(part, turned != is_turned(p)), 0};
}

float distance_to_segment(glm::vec3 p, glm::vec3 a, glm::vec3 b) {
    const auto ab = b - a;
    const float t = std::clamp(glm::dot(p - a, ab) / std::max(glm::dot(ab, ab), 1e-30f), 0.0f, 1.0f);
    return glm::distance(p, a + t * ab);
}

float distance_to_triangle(glm::vec3 p, glm::vec3 a, glm::vec3 b, glm::vec3 c) {
    const auto n = glm::cross(b - a, c - a);
    const auto is_left_of = [&](glm::vec3 from, glm::vec3 to) {
        return glm::dot(glm::cross(to - from, p - from), n) >= 0;
    };
    if (is_left_of(a, b) && is_left_of(b, c) && is_left_of(c, a))
        return std::abs(glm::dot(p - a, n)) / std::max(glm::length(n), 1e-30f);
    return std::min(
        {distance_to_segment(p, a, b), distance_to_segment(p, b, c), distance_to_segment(p, c, a)});
}

/// on_triangle of place.comp.
glm::vec2 on_triangle(std::uint32_t t) {
    glm::vec2 a(0), b(1, 0), c(0, 1);
    for (int i = 0; i < 16; ++i, t <<= 2) {
        const auto ab = 0.5f * (a + b), bc = 0.5f * (b + c), ca = 0.5f * (c + a);
        switch (t >> 30) {
            case 0:
                b = ab, c = ca;
                break;
            case 1:
                a = bc, b = ca, c = ab;
                break;
            case 2:
                a = ab, c = bc;
                break;
            default:
                a = ca, b = bc;
        }
    }
    return (a + b + c) / 3.0f;
}

}  // namespace

glm::vec3 Curve::corner(std::uint32_t triangle, std::size_t number) const {
    return world_.positions[world_.indices[3 * std::size_t{triangle} + number]];
}

Curve::Corners Curve::corners(std::uint32_t triangle) const {
    const auto a = corner(triangle, 0);
    return {a, corner(triangle, 1) - a, corner(triangle, 2) - a};
}

Curve::Triangle Curve::corners_of(const Corners& c, const Patch& p) {
    const auto at = [&](glm::vec2 uv) {
        const auto weights = weights_in(p, uv);
        return c.a + weights.x * c.ab + weights.y * c.ac;
    };
    return {at({0, 0}), at({1, 0}), at({0, 1})};
}

/// All corners on the far side of one plane.
bool Curve::is_culled(const Triangle& t) const {
    if (!frustum_.culls) return false;
    return std::ranges::any_of(frustum_.frustum, [&](const glm::vec4& plane) {
        const glm::vec3 n(plane);
        return std::max({glm::dot(n, t.a), glm::dot(n, t.b), glm::dot(n, t.c)}) + plane.w < -frustum_.margin;
    });
}

/// Not more than the least ideal area on the triangle.
float Curve::min_ideal_area(const Triangle& t) const {
    const auto along = [&](glm::vec3 p) { return glm::dot(p - ideal_.ideal_eye_ws, ideal_.ideal_axis_ws); };
    const float nearest =
        ideal_.ideal_corner_cosine * distance_to_triangle(ideal_.ideal_eye_ws, t.a, t.b, t.c);
    const float least = std::max(std::min({along(t.a), along(t.b), along(t.c)}), nearest);
    return ideal_area_at(ideal_, std::max(least, ideal_.ideal_nearest));
}

/// Into how many parts along each side, so that each has few surfels and is short beside its distance.
std::uint32_t Curve::splits(const Corners& c, const Patch& p, bool is_first_round) const {
    const float ideal = min_ideal_area(corners_of(c, p)), whole = static_cast<float>(p.splits);
    float needed = std::sqrt(c.area() / (whole * whole * ideal) / surfels_of_patch);
    if (!is_parallel(ideal_)) {
        const auto bc = c.ac - c.ab;
        const float side =
            std::sqrt(std::max({glm::dot(c.ab, c.ab), glm::dot(c.ac, c.ac), glm::dot(bc, bc)})) / whole;
        needed = std::max(needed, side * ideal_.ideal_radius / std::sqrt(ideal / pi) / max_patch_length);
    }
    if (is_first_round && needed > 4) needed = std::sqrt(needed);
    return static_cast<std::uint32_t>(std::clamp(std::ceil(needed), 1.0f, static_cast<float>(max_splits)));
}

/// Rounded at random.
std::uint32_t Curve::units(const Corners& c, const Patch& p) const {
    const float splits = static_cast<float>(p.splits);
    const float surfels = c.area() / (splits * splits * ideal_area_of(p));
    const auto random = passes::pcg4d({p.triangle, p.splits, p.place, seed_}).x;
    return static_cast<std::uint32_t>(surfels * static_cast<float>(units_of_surfel) +
                                      passes::unit_float(random));
}

/// Calls `to` with each part that is not culled.
template <class To>
void Curve::split(const Corners& c, const Patch& whole, bool is_first_round, const To& to) const {
    const auto count = splits(c, whole, is_first_round);
    const auto give = [&](glm::uvec2 corner, bool turned) {
        const auto part = part_of(whole, count, corner, turned);
        if (!is_culled(corners_of(c, part))) to(part);
    };
    for (std::uint32_t row = 0; row < count; ++row)
        for (std::uint32_t column = 0; column < count - row; ++column) {
            give({column, row}, false);
            if (column + row + 1 < count) give({column, row}, true);
        }
}

void Curve::cut(std::uint32_t triangle, std::vector<WorthOfPatch>& patches) const {
    const auto c = corners(triangle);
    const Patch whole{triangle, 1, 0, 0};
    if (!(c.area() > 0) || is_culled(corners_of(c, whole))) return;
    split(c, whole, true, [&](const Patch& part) {
        split(c, part, false, [&](const Patch& patch) { patches.push_back({patch, units(c, patch)}); });
    });
}

glm::vec2 Curve::weights_on(const Patch& patch, float place) const {
    return weights_in(patch, on_triangle(static_cast<std::uint32_t>(place * 4294967296.0f)));
}

glm::vec3 Curve::position(std::uint32_t triangle, glm::vec2 weights) const {
    const auto c = corners(triangle);
    return c.a + weights.x * c.ab + weights.y * c.ac;
}

float Curve::ideal_area_of(const Patch& patch) const {
    return ideal_area(ideal_, position(patch.triangle, weights_in(patch, glm::vec2(1.0f / 3.0f))));
}

glm::vec3 Curve::normal(std::uint32_t triangle) const {
    return passes::triangle_normal(world_, triangle);
}

}  // namespace ir::methods::deep_screen_space
