#include "renderers/image/exposure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace ir {
namespace {

/// Luminances spread over some stops about a middle.
Image picture(double middle, double stops, int lamps = 0) {
    Image image(100, 100, 3);
    std::mt19937 random(3);
    std::normal_distribution<double> spread(0, stops);
    for (int i = 0; i < 10000; ++i) {
        const auto value = float(i < lamps ? 1e4 : middle * std::exp2(spread(random)));
        for (int c = 0; c < 3; ++c) image.pixels[std::size_t(3 * i + c)] = value;
    }
    return image;
}

TEST(Exposure, TheMeanBecomesMiddleGrey) {
    for (const double middle : {1e-4, 0.02, 0.18, 30.0})
        EXPECT_NEAR(automatic_exposure(picture(middle, 1)), std::log2(0.18 / middle), 0.26) << middle;
}

TEST(Exposure, AFewLampsChangeNothing) {
    EXPECT_NEAR(automatic_exposure(picture(0.02, 1, 90)), automatic_exposure(picture(0.02, 1)), 0.26);
}

TEST(Exposure, AtMostASeventhIsClipped) {
    const auto wide = picture(0.02, 4);
    const double scale = std::exp2(automatic_exposure(wide));
    int clipped = 0;
    for (int i = 0; i < 10000; ++i) clipped += wide.pixels[std::size_t(3 * i)] * scale > 1;
    EXPECT_LE(clipped, 10000 / 7 + 400);
}

TEST(Exposure, WhatIsNoLightDoesNotCount) {
    auto some = picture(0.02, 1);
    const double before = automatic_exposure(some);
    for (std::size_t i = 0; i < 3000; ++i)
        some.pixels[i] = i % 2 ? 0 : std::numeric_limits<float>::infinity();
    EXPECT_NEAR(automatic_exposure(some), before, 0.26);
    EXPECT_EQ(automatic_exposure(Image(8, 8, 3)), 0);
    EXPECT_EQ(automatic_exposure(Image()), 0);
}

}  // namespace
}  // namespace ir
