#include "renderers/image/ssim.h"

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "renderers/image/comparison.h"
#include "renderers/image/vector_math.h"

namespace ir {
namespace {

// [Wang04 §III]
constexpr int radius = 5, window = 2 * radius + 1;
constexpr double deviation = 1.5;
constexpr double c1 = 0.01 * 0.01, c2 = 0.03 * 0.03;

/// What is averaged over a window: weights, means, squares and products.
enum { weight, mean_a, mean_b, square_a, square_b, product, quantities };
using Quantities = std::array<std::vector<double>, quantities>;

const std::array<double, window>& gaussian() {
    static const auto weights = [] {
        std::array<double, window> result{};
        double sum = 0;
        for (int i = 0; i < window; ++i) {
            const double x = i - radius;
            sum += result[i] = std::exp(-x * x / (2 * deviation * deviation));
        }
        for (double& value : result) value /= sum;
        return result;
    }();
    return weights;
}

IR_WIDE_REGISTERS void add_scaled(const double* __restrict in, double scale, double* __restrict out,
                                  int width) {
    for (int x = 0; x < width; ++x) out[x] += scale * in[x];
}

/// What one channel of two images has at a row; beyond the border all is 0.
void fill_row(const Image& a, const Image& b, const std::vector<unsigned char>& valid, int channel, int y,
              Quantities& row) {
    for (auto& values : row) values.assign(a.width + 2 * radius, 0.0);
    for (int x = 0; x < a.width; ++x) {
        if (!valid[std::size_t(y) * a.width + x]) continue;
        const double u = a.at(x, y, channel), v = b.at(x, y, channel);
        const double values[quantities] = {1, u, v, u * u, v * v, u * v};
        for (int q = 0; q < quantities; ++q) row[q][x + radius] = values[q];
    }
}

/// [Wang04 eq. 13] from sums over a window.
double similarity(const Quantities& sums, int x) {
    const double w = sums[weight][x], ma = sums[mean_a][x] / w, mb = sums[mean_b][x] / w;
    const double va = sums[square_a][x] / w - ma * ma, vb = sums[square_b][x] / w - mb * mb;
    const double covariance = sums[product][x] / w - ma * mb;
    return (2 * ma * mb + c1) * (2 * covariance + c2) / ((ma * ma + mb * mb + c1) * (va + vb + c2));
}

/// Adds one channel's similarity, times `share`, to the map.
void add_channel(const Image& a, const Image& b, const std::vector<unsigned char>& valid, int channel,
                 float share, Image& map) {
    std::vector<Quantities> rows(a.height);  // filtered along x
    for_each_row(a.height, [&](int y) {
        Quantities row;
        fill_row(a, b, valid, channel, y, row);
        for (int q = 0; q < quantities; ++q) {
            rows[y][q].assign(a.width, 0.0);
            for (int i = 0; i < window; ++i)
                add_scaled(&row[q][i], gaussian()[i], rows[y][q].data(), a.width);
        }
    });
    for_each_row(a.height, [&](int y) {
        Quantities sums;
        for (int q = 0; q < quantities; ++q) {
            sums[q].assign(a.width, 0.0);
            for (int i = -radius; i <= radius; ++i)
                if (y + i >= 0 && y + i < a.height)
                    add_scaled(rows[y + i][q].data(), gaussian()[i + radius], sums[q].data(), a.width);
        }
        for (int x = 0; x < a.width; ++x)
            map.at(x, y) += valid[std::size_t(y) * a.width + x]
                                ? share * static_cast<float>(similarity(sums, x))
                                : std::numeric_limits<float>::quiet_NaN();
    });
}

}  // namespace

Image ssim_map(const Image& image, const Image& reference, const Image* valid) {
    require_comparable(image, reference, "image", "reference");
    require_mask_size(image, valid, "the mask of valid pixels");
    const auto usable = valid_in_both(image, reference, valid, nullptr);
    const int channels = image.channels;
    Image map(image.width, image.height, 1);
    for (int c = 0; c < channels; ++c)
        add_channel(image, reference, usable, c, 1.0f / static_cast<float>(channels), map);
    return map;
}

}  // namespace ir
