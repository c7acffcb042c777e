#include "renderers/image/flip_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderers/image/comparison.h"
#include "renderers/image/flip_colour.h"
#include "renderers/image/vector_math.h"

namespace ir::flip {
namespace {

constexpr float colour_exponent = 0.7f;  ///< q_c: large colour differences count less
/// Colour differences up to the part p_c of the largest one fill the errors up to p_t [Andersson20 §4.1.3].
constexpr float knee_part = 0.4f, knee_error = 0.95f;

/// Between the greenest and the bluest of sRGB: the largest difference of all [Andersson20 §4.1.3].
float largest_colour_difference() {
    const auto seen = [](Rgb c) { return hunt_adjusted(to_lab(c)); };
    return std::pow(hyab(seen({0, 1, 0}), seen({0, 0, 1})), colour_exponent);
}

/// Values a block long are summed at once: the sums stay in registers.
constexpr int block = 32;

/// out[x] = Σ weights[i] in[x + i].
IR_WIDE_REGISTERS void convolve(const float* in, const float* weights, int count, float* out, int width) {
    int x = 0;
    for (; x + block <= width; x += block) {
        float sums[block] = {};
        for (int i = 0; i < count; ++i)
            for (int j = 0; j < block; ++j) sums[j] += weights[i] * in[x + i + j];
        for (int j = 0; j < block; ++j) out[x + j] = sums[j];
    }
    for (; x < width; ++x) {
        float sum = 0;
        for (int i = 0; i < count; ++i) sum += weights[i] * in[x + i];
        out[x] = sum;
    }
}

/// out[x] = Σ weights[i] rows[i][x], four rows at a time: memory is read in streams.
IR_WIDE_REGISTERS void convolve_columns(const float* const* rows, const float* weights, int count,
                                        float* __restrict out, int width) {
    int i = count % 4;
    std::fill_n(out, width, 0.0f);
    for (int k = 0; k < i; ++k)
        for (int x = 0; x < width; ++x) out[x] += weights[k] * rows[k][x];
    for (; i < count; i += 4) {
        const float* __restrict r0 = rows[i], * __restrict r1 = rows[i + 1], * __restrict r2 = rows[i + 2], * __restrict r3 = rows[i + 3];
        const float w0 = weights[i], w1 = weights[i + 1], w2 = weights[i + 2], w3 = weights[i + 3];
        for (int x = 0; x < width; ++x) out[x] += w0 * r0[x] + w1 * r1[x] + w2 * r2[x] + w3 * r3[x];
    }
}

/// Replaces red, green and blue by the opponent axes.
IR_WIDE_REGISTERS void to_opponent(float* red, float* green, float* blue, int width) {
    for (int x = 0; x < width; ++x) {
        const Opponent c = to_ycxcz({red[x], green[x], blue[x]});
        red[x] = c.light;
        green[x] = c.red_green;
        blue[x] = c.blue_yellow;
    }
}

/// Replaces filtered YCxCz, clipped to what a screen shows, by CIELAB with Hunt's effect.
IR_WIDE_REGISTERS void to_seen(float* light, float* red_green, float* blue_yellow, int width) {
    for (int x = 0; x < width; ++x) {
        const Rgb shown = clipped(from_ycxcz({light[x], red_green[x], blue_yellow[x]}));
        const Opponent seen = hunt_adjusted(to_lab(shown));
        light[x] = seen.light;
        red_green[x] = seen.red_green;
        blue_yellow[x] = seen.blue_yellow;
    }
}

/// One row as the eye sees it: the filtered colour, and the lengths of the gradient and of the second
/// derivatives.
struct SeenRow {
    const float* __restrict light, * __restrict red_green, * __restrict blue_yellow, * __restrict edge, * __restrict point;
};

/// along_x becomes the length of both.
IR_WIDE_REGISTERS void to_length(float* along_x, const float* along_y, int width) {
    // Detectors work on a luminance of 0 … 1; the offset of YCxCz drops out of derivatives.
    constexpr float scale = 1.0f / 116;
    for (int x = 0; x < width; ++x)
        along_x[x] = scale * std::sqrt(along_x[x] * along_x[x] + along_y[x] * along_y[x]);
}

void pad(float* padded, int margin, int width) {
    std::fill_n(padded, margin, padded[margin]);
    std::fill_n(padded + margin + width, margin, padded[margin + width - 1]);
}

}  // namespace

/// One row after filtering in both directions.
struct Map::Row {
    explicit Row(int width) {
        for (auto* values : {&light, &red_green, &blue_yellow, &edge, &point}) values->resize(width);
    }
    SeenRow pointers() const {
        return {light.data(), red_green.data(), blue_yellow.data(), edge.data(), point.data()};
    }
    std::vector<float> light, red_green, blue_yellow, edge, point;
};

Map::Map(int width, int height, double pixels_per_degree)
    : width_(width),
      height_(height),
      margin_(largest_radius(pixels_per_degree)),
      contrast_(contrast_sensitivity(pixels_per_degree)),
      features_(feature_detectors(pixels_per_degree)),
      error_(std::size_t(width) * height) {
    for (auto& filtered : filtered_)
        for (auto& plane : filtered.planes) plane.resize(error_.size());
}

void Map::filter_row(const RowSource& source, Filtered& filtered, int y) const {
    const int padded = width_ + 2 * margin_;
    std::vector<float> rows(std::size_t(padded) * 3);
    float* channels[3] = {&rows[0], &rows[padded], &rows[2 * padded]};
    source(y, channels[0] + margin_, channels[1] + margin_, channels[2] + margin_);
    to_opponent(channels[0] + margin_, channels[1] + margin_, channels[2] + margin_, width_);
    for (float* channel : channels) pad(channel, margin_, width_);
    const auto filter = [&](int channel, const Taps& taps, Plane plane) {
        convolve(channels[channel] + margin_ - taps.radius, taps.weights.data(), int(taps.weights.size()),
                 &filtered.planes[plane][std::size_t(y) * width_], width_);
    };
    filter(0, contrast_.luminance, luminance);
    filter(1, contrast_.red_green, red_green);
    filter(2, contrast_.blue_yellow[0], blue_yellow_a);
    filter(2, contrast_.blue_yellow[1], blue_yellow_b);
    filter(0, features_.edge, edge);
    filter(0, features_.point, point);
    filter(0, features_.smooth, smooth);
}

void Map::filter_columns(const Filtered& filtered, Row& row, int y) const {
    std::vector<const float*> rows(2 * margin_ + 1);
    const auto filter = [&](Plane plane, const Taps& taps, std::vector<float>& out) {
        for (int i = -taps.radius; i <= taps.radius; ++i)
            rows[i + taps.radius] =
                &filtered.planes[plane][std::size_t(std::clamp(y + i, 0, height_ - 1)) * width_];
        convolve_columns(rows.data(), taps.weights.data(), int(taps.weights.size()), out.data(), width_);
    };
    std::vector<float> other(width_);
    filter(luminance, contrast_.luminance, row.light);
    filter(red_green, contrast_.red_green, row.red_green);
    filter(blue_yellow_a, contrast_.blue_yellow[0], row.blue_yellow);
    filter(blue_yellow_b, contrast_.blue_yellow[1], other);
    for (int x = 0; x < width_; ++x) row.blue_yellow[x] += other[x];
    to_seen(row.light.data(), row.red_green.data(), row.blue_yellow.data(), width_);

    const auto length = [&](Plane along_x, const Taps& along_y, std::vector<float>& out) {
        filter(along_x, features_.smooth, out);
        filter(smooth, along_y, other);
        to_length(out.data(), other.data(), width_);
    };
    length(edge, features_.edge, row.edge);
    length(point, features_.point, row.point);
}

namespace {

/// [Andersson20 §4.1.3]: the colour difference as an error of 0 … 1.
float colour_error(Opponent a, Opponent b, float largest) {
    const float knee = knee_part * largest;
    const float difference = vector_math::power(hyab(a, b), colour_exponent);
    const float below = difference * (knee_error / knee);
    const float above = knee_error + (difference - knee) / (largest - knee) * (1 - knee_error);
    return difference < knee ? below : above;
}

/// [Andersson20 §4.3]: where features differ, the error of the colour is raised.
IR_WIDE_REGISTERS void compare(const SeenRow& a, const SeenRow& b, float largest, float* error, int width) {
    for (int x = 0; x < width; ++x) {
        const float colour = colour_error({a.light[x], a.red_green[x], a.blue_yellow[x]},
                                          {b.light[x], b.red_green[x], b.blue_yellow[x]}, largest);
        const float edge = std::abs(a.edge[x] - b.edge[x]), point = std::abs(a.point[x] - b.point[x]);
        const float stronger = (edge > point ? edge : point) / std::numbers::sqrt2_v<float>;
        const float feature = std::sqrt(stronger < 1 ? stronger : 1.0f);  // the exponent q_f is ½
        error[x] = vector_math::power(colour, 1 - feature);
    }
}

}  // namespace

void Map::compare_row(const Row& image, const Row& reference, float* error) const {
    static const float largest = largest_colour_difference();
    compare(image.pointers(), reference.pointers(), largest, error, width_);
}

const std::vector<float>& Map::compute(const RowSource& image, const RowSource& reference) {
    for_each_row(height_, [&](int y) {
        filter_row(image, filtered_[0], y);
        filter_row(reference, filtered_[1], y);
    });
    for_each_row(height_, [&](int y) {
        Row rows[2] = {Row(width_), Row(width_)};
        filter_columns(filtered_[0], rows[0], y);
        filter_columns(filtered_[1], rows[1], y);
        compare_row(rows[0], rows[1], &error_[std::size_t(y) * width_]);
    });
    return error_;
}

}  // namespace ir::flip
