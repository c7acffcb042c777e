#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "renderers/image/luminance.h"
#include "renderers/image/vector_math.h"

/// The colour spaces of ꟻLIP [Andersson20 §4.1], of linear sRGB whose white is D65.
namespace ir::flip {

struct Rgb {
    float red, green, blue;
};
/// CIE XYZ in parts of the white's, which is (1, 1, 1).
struct Xyz {
    float x, y, z;
};
/// Lightness or luminance, red–green and blue–yellow, in the scale of CIELAB.
struct Opponent {
    float light, red_green, blue_yellow;
};

using Matrix = std::array<std::array<double, 3>, 3>;

/// The inverse by cofactors.
constexpr Matrix inverse(const Matrix& m) {
    const auto cofactor = [&m](int row, int column) {
        const int r1 = (row + 1) % 3, r2 = (row + 2) % 3, c1 = (column + 1) % 3, c2 = (column + 2) % 3;
        return m[r1][c1] * m[r2][c2] - m[r1][c2] * m[r2][c1];
    };
    const double determinant = m[0][0] * cofactor(0, 0) + m[0][1] * cofactor(0, 1) + m[0][2] * cofactor(0, 2);
    Matrix result{};
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column) result[row][column] = cofactor(column, row) / determinant;
    return result;
}

/// The primaries' share of the white [IEC 61966-2-1]: each row adds up to 1.
constexpr Matrix xyz_of_rgb{{{10135552 / 23359437., 8788810 / 23359437., 4435075 / 23359437.},
                             {2613072 / 12288897., 8788810 / 12288897., 887015 / 12288897.},
                             {1425312 / 80288307., 8788810 / 80288307., 70074185 / 80288307.}}};
constexpr Matrix rgb_of_xyz = inverse(xyz_of_rgb);

inline std::array<float, 3> transformed(const Matrix& m, float a, float b, float c) {
    const auto row = [&](int i) { return float(m[i][0]) * a + float(m[i][1]) * b + float(m[i][2]) * c; };
    return {row(0), row(1), row(2)};
}
inline Xyz to_xyz(Rgb c) {
    const auto [x, y, z] = transformed(xyz_of_rgb, c.red, c.green, c.blue);
    return {x, y, z};
}
inline Rgb to_rgb(Xyz c) {
    const auto [red, green, blue] = transformed(rgb_of_xyz, c.x, c.y, c.z);
    return {red, green, blue};
}

inline float clipped(float value) {
    return std::min(std::max(value, 0.0f), 1.0f);
}
inline Rgb clipped(Rgb c) {
    return {clipped(c.red), clipped(c.green), clipped(c.blue)};
}

/// Opponent axes of three numbers that stand for X, Y and Z.
inline Opponent opponent(float x, float y, float z) {
    return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

/// YCxCz: linear, so that filtering it mixes light.
inline Opponent to_ycxcz(Rgb c) {
    const Xyz xyz = to_xyz(c);
    return opponent(xyz.x, xyz.y, xyz.z);
}
inline Rgb from_ycxcz(Opponent c) {
    const float y = (c.light + 16) * (1.0f / 116);
    return to_rgb({y + c.red_green * (1.0f / 500), y, y - c.blue_yellow * (1.0f / 200)});
}

/// CIELAB, nearly uniform in what is seen; the cube root goes on as a line near black.
inline Opponent to_lab(Rgb c) {
    constexpr float knee = 6.0f / 29;
    const auto root = [](float t) {
        const float line = t * (1 / (3 * knee * knee)) + 4.0f / 29;
        return t > knee * knee * knee ? vector_math::power(t, 1.0f / 3) : line;
    };
    const Xyz xyz = to_xyz(c);
    return opponent(root(xyz.x), root(xyz.y), root(xyz.z));
}

/// Hunt's effect: darker colours look less colourful [Andersson20 §4.1.2].
inline Opponent hunt_adjusted(Opponent c) {
    const float factor = 0.01f * c.light;
    return {c.light, factor * c.red_green, factor * c.blue_yellow};
}

/// City-block distance in lightness plus Euclidean distance in chroma [Andersson20 §4.1.3].
inline float hyab(Opponent a, Opponent b) {
    const float u = a.red_green - b.red_green, v = a.blue_yellow - b.blue_yellow;
    return std::abs(a.light - b.light) + std::sqrt(u * u + v * v);
}

/// Luminance with the rounded weights of Rec. 709, as [Andersson21] takes it.
inline float luminance(Rgb c) {
    return ir::luminance(c.red, c.green, c.blue);
}

}  // namespace ir::flip
