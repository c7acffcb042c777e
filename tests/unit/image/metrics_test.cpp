#include "renderers/image/metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "renderers/core/error.h"

namespace ir {
namespace {

Image grey(std::initializer_list<float> values) {
    Image image(static_cast<int>(values.size()), 1, 1);
    image.pixels = values;
    return image;
}

TEST(Metrics, HandComputedValues) {
    const auto result =
        compute_metrics(grey({1, 2, 3, 4}), grey({1, 1, 5, 0}), {"rmse", "mae", "psnr"});  // 0, 1, -2, 4
    EXPECT_EQ(result.pixels, 4u);
    EXPECT_EQ(result.skipped, 0u);
    EXPECT_DOUBLE_EQ(result.values.at("rmse"), std::sqrt(21.0 / 4));
    EXPECT_DOUBLE_EQ(result.values.at("mae"), 7.0 / 4);
    EXPECT_NEAR(result.values.at("psnr"), -7.2016, 1e-4);  // 10 log10(1 / 5.25)
}

TEST(Metrics, PsnrOfATenthIsTwentyDecibels) {
    const auto result = compute_metrics(Image(3, 3, 3, 0.5f), Image(3, 3, 3, 0.4f), {"psnr"});
    EXPECT_NEAR(result.values.at("psnr"), 20, 1e-5);
    const auto equal = compute_metrics(Image(3, 3, 3, 0.5f), Image(3, 3, 3, 0.5f), {"psnr", "rmse"});
    EXPECT_TRUE(std::isinf(equal.values.at("psnr")) && equal.values.at("psnr") > 0);
    EXPECT_EQ(equal.values.at("rmse"), 0);
    EXPECT_EQ(equal.values.size(), 2u);
}

TEST(Metrics, SkipsInvalidPixels) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float infinity = std::numeric_limits<float>::infinity();
    const Image a = grey({1, nan, 3, 9, 9, 2}), b = grey({0, 1, infinity, 0, 0, 2});
    const Image mask_a = grey({1, 1, 1, 0, 1, 1}), mask_b = grey({1, 1, 1, 1, 0, 1});
    const auto result = compute_metrics(a, b, {"mae"}, {.valid_image = &mask_a, .valid_reference = &mask_b});
    EXPECT_EQ(result.pixels, 2u);
    EXPECT_EQ(result.skipped, 4u);
    EXPECT_DOUBLE_EQ(result.values.at("mae"), 0.5);
}

TEST(Metrics, OneBadChannelSkipsThePixel) {
    Image a(2, 1, 3, 1.0f), b(2, 1, 3, 0.0f);
    a.at(0, 0, 2) = std::numeric_limits<float>::quiet_NaN();
    const auto result = compute_metrics(a, b, {"mae"});
    EXPECT_EQ(result.pixels, 1u);
    EXPECT_EQ(result.skipped, 1u);
    EXPECT_DOUBLE_EQ(result.values.at("mae"), 1);
}

TEST(Metrics, NothingValidIsNaN) {
    const Image none = grey({0, 0});
    const auto result = compute_metrics(grey({1, 2}), grey({1, 2}), {"rmse"}, {.valid_image = &none});
    EXPECT_TRUE(std::isnan(result.values.at("rmse")));
    EXPECT_EQ(result.skipped, 2u);
}

TEST(Metrics, AlphaIsNotCompared) {
    Image a(1, 1, 4, 0.5f), b(1, 1, 4, 0.5f);
    a.at(0, 0, 3) = 0;
    EXPECT_EQ(compute_metrics(a, b, {"rmse"}).values.at("rmse"), 0);
    EXPECT_EQ(compute_metrics(a, Image(1, 1, 3, 0.25f), {"mae"}).values.at("mae"), 0.25);
    EXPECT_EQ(signed_difference(a, b).channels, 3);
}

TEST(Metrics, RefusesWhatCannotBeCompared) {
    try {
        compute_metrics(Image(4, 3, 1), Image(4, 2, 1), {"rmse"});
        FAIL() << "different sizes were compared";
    } catch (const UsageError& error) {
        const std::string text = error.what();
        EXPECT_NE(text.find("4x3"), std::string::npos) << text;
        EXPECT_NE(text.find("4x2"), std::string::npos) << text;
    }
    EXPECT_THROW(compute_metrics(Image(4, 3, 1), Image(3, 4, 1), {"rmse"}), UsageError);
    EXPECT_THROW(compute_metrics(Image(4, 3, 1), Image(4, 3, 3), {"rmse"}), UsageError);
    EXPECT_THROW(compute_metrics(Image(1, 1, 1), Image(1, 1, 1), {"rsme"}), UsageError);
    EXPECT_THROW(signed_difference(Image(1, 2, 1), Image(2, 1, 1)), UsageError);
    const Image mask(2, 1, 1);
    EXPECT_THROW(compute_metrics(Image(1, 1, 1), Image(1, 1, 1), {"rmse"}, {.valid_image = &mask}), UsageError);
}

TEST(Metrics, SignedDifference) {
    const Image result = signed_difference(grey({1, 2}), grey({3, 0.5f}));
    EXPECT_EQ(result.pixels, (std::vector<float>{-2, 1.5f}));
}

}  // namespace
}  // namespace ir
