#include "renderers/image/ssim.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/unit/image/test_pictures.h"

namespace ir {
namespace {

constexpr double c1 = 1e-4, c2 = 9e-4;

/// [Wang04 eq. 13] by its definition, one pixel and channel, with two loops over the window.
double by_definition(const Image& a, const Image& b, const Image* valid, int x, int y, int c) {
    double w = 0, ma = 0, mb = 0, va = 0, vb = 0, covariance = 0;
    for (int pass = 0; pass < 2; ++pass)
        for (int j = -5; j <= 5; ++j)
            for (int i = -5; i <= 5; ++i) {
                const int u = x + i, v = y + j;
                if (u < 0 || v < 0 || u >= a.width || v >= a.height) continue;
                if (valid && valid->at(u, v) == 0) continue;
                const double weight = std::exp(-(i * i + j * j) / 4.5);
                const double p = a.at(u, v, c), q = b.at(u, v, c);
                if (pass == 0) {
                    w += weight, ma += weight * p, mb += weight * q;
                } else {
                    va += weight / w * (p - ma / w) * (p - ma / w);
                    vb += weight / w * (q - mb / w) * (q - mb / w);
                    covariance += weight / w * (p - ma / w) * (q - mb / w);
                }
            }
    ma /= w, mb /= w;
    return (2 * ma * mb + c1) * (2 * covariance + c2) / ((ma * ma + mb * mb + c1) * (va + vb + c2));
}

TEST(Ssim, IsWhatItsDefinitionSays) {
    const auto reference = test::colourful(30, 22), image = test::noisy(test::shifted(reference), 0.2f);
    Image valid(30, 22, 1, 1.0f);
    for (int y = 4; y < 9; ++y)
        for (int x = 12; x < 19; ++x) valid.at(x, y) = 0;
    for (const Image* mask : {static_cast<const Image*>(nullptr), static_cast<const Image*>(&valid)}) {
        const auto map = ssim_map(image, reference, mask);
        for (int y = 0; y < 22; ++y)
            for (int x = 0; x < 30; ++x) {
                if (mask && mask->at(x, y) == 0) {
                    EXPECT_TRUE(std::isnan(map.at(x, y)));
                    continue;
                }
                double mean = 0;
                for (int c = 0; c < 3; ++c) mean += by_definition(image, reference, mask, x, y, c) / 3;
                EXPECT_NEAR(map.at(x, y), mean, 1e-5) << x << "," << y;
            }
    }
}

TEST(Ssim, OfFlatPicturesComparesTheirBrightness) {
    const auto map = ssim_map(Image(16, 16, 1, 0.5f), Image(16, 16, 1, 0.3f));
    for (const float value : map.pixels)
        EXPECT_NEAR(value, (2 * 0.5 * 0.3 + c1) / (0.25 + 0.09 + c1), 1e-6);  // no structure on either side
}

TEST(Ssim, IsSymmetricAndNegativeForNegatives) {
    const auto a = test::colourful(24, 24), b = test::blurred(a);
    EXPECT_EQ(ssim_map(a, b).pixels, ssim_map(b, a).pixels);
    Image board(24, 24, 1), negative(24, 24, 1);
    for (int y = 0; y < 24; ++y)
        for (int x = 0; x < 24; ++x) {
            board.at(x, y) = float((x + y) & 1);
            negative.at(x, y) = 1 - board.at(x, y);
        }
    EXPECT_LT(ssim_map(board, negative).at(12, 12), -0.9);
}

TEST(Ssim, IsSafeInBrightFlatParts) {
    const auto map = ssim_map(Image(16, 16, 1, 4000.0f), Image(16, 16, 1, 4000.0f));
    for (const float value : map.pixels) EXPECT_NEAR(value, 1, 1e-4);
}

}  // namespace
}  // namespace ir
