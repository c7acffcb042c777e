#include "widgets/document/trs.h"

#include <algorithm>
#include <cmath>

namespace ir::widgets {
namespace {

constexpr double rounding = 1e-12;  ///< of the largest element

/// Cosine and sine, exact at multiples of 90 degrees.
glm::dvec2 turn(double degrees) {
    const double quarter = std::fmod(degrees, 360.0) / 90;
    if (quarter == std::floor(quarter)) {
        constexpr glm::dvec2 quarters[] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
        return quarters[(int(quarter) + 4) % 4];
    }
    return {std::cos(glm::radians(degrees)), std::sin(glm::radians(degrees))};
}

/// Rz Ry Rx.
glm::dmat3 rotation(const glm::dvec3& degrees) {
    const auto x = turn(degrees.x), y = turn(degrees.y), z = turn(degrees.z);
    return {z.x * y.x,
            z.y * y.x,
            -y.y,
            z.x * y.y * x.y - z.y * x.x,
            z.y * y.y * x.y + z.x * x.x,
            y.x * x.y,
            z.x * y.y * x.x + z.y * x.y,
            z.y * y.y * x.x - z.x * x.y,
            y.x * x.x};
}

/// Angles of Rz Ry Rx; where y is ±90°, z is 0.
glm::dvec3 angles(const glm::dmat3& r) {
    const double sine = std::clamp(-r[0][2], -1.0, 1.0);
    const bool is_locked = std::abs(sine) > 1 - 1e-14;
    const double x = is_locked ? std::atan2(-r[2][1], r[1][1]) : std::atan2(r[1][2], r[2][2]);
    const double y = is_locked ? std::copysign(glm::radians(90.0), sine) : std::asin(sine);
    const double z = is_locked ? 0 : std::atan2(r[0][1], r[0][0]);
    return glm::degrees(glm::dvec3(x, y, z));
}

/// 29.999999999999996 is 30 to people; the difference is below the rounding allowed.
glm::dvec3 tidied(const glm::dvec3& numbers) {
    glm::dvec3 result;
    for (int i = 0; i < 3; ++i) {
        const double rounded = std::round(numbers[i] * 1e9) / 1e9;
        result[i] = std::abs(rounded - numbers[i]) < 1e-12 * std::max(1.0, std::abs(rounded)) ? rounded + 0.0
                                                                                              : numbers[i];
    }
    return result;
}

}  // namespace

bool nearly_equal(const Matrix& a, const Matrix& b) {
    double largest = 0, difference = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        largest = std::max(largest, std::abs(a[i]));
        difference = std::max(difference, std::abs(a[i] - b[i]));
    }
    return difference <= rounding * largest;
}

Matrix matrix_of(const Trs& trs) {
    const glm::dmat3 r = rotation(trs.rotation_degrees);
    Matrix m{};
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row)
            m[std::size_t(column * 4 + row)] = r[column][row] * trs.scale[column];
    for (int row = 0; row < 3; ++row) m[std::size_t(12 + row)] = trs.translation[row];
    m[15] = 1;
    return m;
}

std::optional<Trs> trs_of(const Matrix& m) {
    Trs trs;
    glm::dmat3 r;
    for (int column = 0; column < 3; ++column) {
        for (int row = 0; row < 3; ++row) r[column][row] = m[std::size_t(column * 4 + row)];
        trs.scale[column] = glm::length(r[column]);
        if (trs.scale[column] == 0) return {};
    }
    if (glm::determinant(r) < 0) trs.scale.x = -trs.scale.x;  // a mirror, by convention along x
    for (int column = 0; column < 3; ++column) r[column] /= trs.scale[column];
    trs.translation = {m[12], m[13], m[14]};
    trs.rotation_degrees = angles(r);
    Trs tidy = trs;
    tidy.rotation_degrees = tidied(trs.rotation_degrees);
    tidy.scale = tidied(trs.scale);
    if (nearly_equal(m, matrix_of(tidy))) return tidy;
    if (nearly_equal(m, matrix_of(trs))) return trs;
    return {};
}

}  // namespace ir::widgets
