#include "renderers/image/metrics.h"
#include "renderers/core/constants.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "renderers/core/error.h"
#include "tests/unit/image/test_pictures.h"

namespace ir {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

Image grey(std::initializer_list<float> values) {
    Image image(static_cast<int>(values.size()), 1, 1);
    image.pixels = values;
    return image;
}

double value(const char* metric, const Image& a, const Image& b, const MetricOptions& options = {}) {
    return compute_metrics(a, b, {metric}, options).values.at(metric);
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

TEST(Metrics, RelativeErrorsCountByTheReference) {
    EXPECT_NEAR(value("relmse", grey({2, 0.5f}), grey({1, 0})), (1 / 1.01 + 0.25 / 0.01) / 2, 1e-9);
    EXPECT_NE(value("relmse", grey({2}), grey({1})), value("relmse", grey({1}), grey({2})));
}

TEST(Metrics, PsnrOfATenthIsTwentyDecibels) {
    EXPECT_NEAR(value("psnr", Image(3, 3, 3, 0.5f), Image(3, 3, 3, 0.4f)), 20, 1e-5);
    const auto equal = compute_metrics(Image(3, 3, 3, 0.5f), Image(3, 3, 3, 0.5f), {"psnr", "rmse"});
    EXPECT_TRUE(std::isinf(equal.values.at("psnr")) && equal.values.at("psnr") > 0);
    EXPECT_EQ(equal.values.at("rmse"), 0);
    EXPECT_EQ(equal.values.size(), 2u);
}

TEST(Metrics, EqualPicturesHaveNoErrorWhateverTheMeasure) {
    const auto picture = test::high_range(24, 16);
    const auto result = compute_metrics(picture, picture, metric_names());
    for (const auto& metric : metrics()) {
        const double value = result.values.at(metric.name);
        if (metric.name == "psnr") {
            EXPECT_TRUE(std::isinf(value));
        } else if (metric.best != Best::none) {
            EXPECT_NEAR(value, metric.best == Best::highest ? 1 : 0, 1e-6) << metric.name;
        }
    }
    EXPECT_EQ(result.values.at("mean"), result.values.at("reference-mean"));
}

TEST(Metrics, MoreNoiseIsWorseByAllMeasures) {
    const auto picture = test::colourful(48, 32);
    const auto little = compute_metrics(test::noisy(picture, 0.1f), picture, metric_names());
    const auto much = compute_metrics(test::noisy(picture, 0.4f), picture, metric_names());
    for (const auto& metric : metrics())
        if (metric.best == Best::lowest || metric.best == Best::highest) {
            EXPECT_GT(badness(metric, much.values.at(metric.name)),
                      badness(metric, little.values.at(metric.name)))
                << metric.name;
        }
}

/// By hand: of pixels that count, over channels, with the sign of image - reference; alpha is no channel.
TEST(Metrics, BiasKeepsItsSignAndIsRelativeToTheReferencesMean) {
    Image a(3, 1, 4, 9), b(3, 1, 4, 0);
    const float dark[] = {1, 2, 3}, light[] = {2, 4, 3};
    for (int c = 0; c < 3; ++c) {
        for (const int x : {0, 1}) a.at(x, 0, c) = dark[c], b.at(x, 0, c) = light[c];
    }
    const Image valid = grey({1, 1, 0});
    const std::vector<std::string> names{"mean", "reference-mean", "bias", "relbias"};
    auto result = compute_metrics(a, b, names, {.valid_image = &valid});
    EXPECT_DOUBLE_EQ(result.values.at("mean"), 2);
    EXPECT_DOUBLE_EQ(result.values.at("reference-mean"), 3);
    EXPECT_DOUBLE_EQ(result.values.at("bias"), -1);
    EXPECT_DOUBLE_EQ(result.values.at("relbias"), -1.0 / 3);
    EXPECT_EQ(result.pixels, 2u);
    EXPECT_EQ(result.skipped, 1u);
    result = compute_metrics(b, a, names, {.valid_image = &valid});
    EXPECT_DOUBLE_EQ(result.values.at("bias"), 1);
    EXPECT_DOUBLE_EQ(result.values.at("relbias"), 0.5);
    const auto& bias = metric("bias");
    EXPECT_EQ(badness(bias, -0.2), badness(bias, 0.2));
    EXPECT_TRUE(std::isnan(badness(metric("mean"), 1)));
}

TEST(Metrics, WhatIsNotFiniteHasAReason) {
    EXPECT_EQ(why_not_finite(1), "");
    EXPECT_EQ(why_not_finite(infinity, "psnr", 4), "infinite: the pictures are equal");
    EXPECT_EQ(why_not_finite(-infinity, "relbias", 4), "minus infinite: the mean of the reference is 0");
    EXPECT_EQ(why_not_finite(nan, "rmse", 0), "undefined: no pixel was compared");
    EXPECT_EQ(why_not_finite(nan), "undefined");
}

TEST(Metrics, SkipsInvalidPixels) {
    const Image a = grey({1, nan, 3, 9, 9, 2}), b = grey({0, 1, infinity, 0, 0, 2});
    const Image mask_a = grey({1, 1, 1, 0, 1, 1}), mask_b = grey({1, 1, 1, 1, 0, 1});
    const auto result = compute_metrics(a, b, {"mae"}, {.valid_image = &mask_a, .valid_reference = &mask_b});
    EXPECT_EQ(result.pixels, 2u);
    EXPECT_EQ(result.skipped, 4u);
    EXPECT_DOUBLE_EQ(result.values.at("mae"), 0.5);
}

TEST(Metrics, OneBadChannelSkipsThePixel) {
    Image a(2, 1, 3, 1.0f), b(2, 1, 3, 0.0f);
    a.at(0, 0, 2) = nan;
    const auto result = compute_metrics(a, b, {"mae"});
    EXPECT_EQ(result.pixels, 1u);
    EXPECT_EQ(result.skipped, 1u);
    EXPECT_DOUBLE_EQ(result.values.at("mae"), 1);
}

TEST(Metrics, InvalidPixelsDoNotLeakIntoTheirNeighbours) {
    const auto reference = test::colourful(48, 32);
    auto image = test::noisy(reference, 0.2f);
    Image valid(48, 32, 1, 1.0f);
    for (int y = 8; y < 20; ++y)
        for (int x = 10; x < 30; ++x) valid.at(x, y) = 0;
    const MetricOptions options{.valid_image = &valid};
    const auto before = compute_metrics(image, reference, metric_names(), options);
    for (std::size_t i = 0; i < valid.pixels.size(); ++i)
        if (valid.pixels[i] == 0) image.pixels[3 * i] = i % 3 == 0 ? nan : i % 3 == 1 ? infinity : 1e20f;
    const auto after = compute_metrics(image, reference, metric_names(), options);
    EXPECT_EQ(after.pixels, 48u * 32 - 12 * 20);
    EXPECT_EQ(after.skipped, 12u * 20);
    for (const auto& name : metric_names()) {
        EXPECT_TRUE(std::isfinite(after.values.at(name))) << name;
        EXPECT_EQ(after.values.at(name), before.values.at(name)) << name;
    }
}

TEST(Metrics, ARectangleOrAMaskChoosesWhatCounts) {
    const auto reference = test::colourful(40, 30);
    auto image = reference;
    for (int y = 5; y < 10; ++y)
        for (int x = 20; x < 28; ++x) image.at(x, y, 1) += 0.3f;
    const MetricOptions around{.rectangle = Rectangle{20, 5, 8, 5}};
    const auto inside = compute_metrics(image, reference, {"mae", "flip"}, around);
    EXPECT_EQ(inside.pixels, 40u);
    EXPECT_NEAR(inside.values.at("mae"), 0.1, 1e-6);
    EXPECT_GT(inside.values.at("flip"), value("flip", image, reference));
    EXPECT_EQ(value("mae", image, reference, {.rectangle = Rectangle{0, 12, 40, 18}}), 0);

    Image mask(40, 30, 1);
    for (int x = 0; x < 40; ++x) mask.at(x, 5) = 1;
    const auto both =
        compute_metrics(image, reference, {"mae"}, {.rectangle = Rectangle{18, 0, 4, 30}, .mask = &mask});
    EXPECT_EQ(both.pixels, 4u);
    EXPECT_NEAR(both.values.at("mae"), 0.05, 1e-6);
}

TEST(Metrics, OnlyWhatLiesInTheRegionIsCountedAsSkipped) {
    const Image a = grey({nan, 1, nan, 1}), b(4, 1, 1, 0.0f);
    const auto result = compute_metrics(a, b, {"mae"}, {.rectangle = Rectangle{1, 0, 2, 1}});
    EXPECT_EQ(result.pixels, 1u);
    EXPECT_EQ(result.skipped, 1u);
}

TEST(Metrics, NothingValidIsNaN) {
    const Image none = grey({0, 0});
    const auto result = compute_metrics(grey({1, 2}), grey({1, 2}), metric_names(), {.valid_image = &none});
    for (const auto& name : metric_names()) EXPECT_TRUE(std::isnan(result.values.at(name))) << name;
    EXPECT_EQ(result.skipped, 2u);
}

TEST(Metrics, AlphaIsNotCompared) {
    Image a(1, 1, 4, 0.5f), b(1, 1, 4, 0.5f);
    a.at(0, 0, 3) = 0;
    EXPECT_EQ(value("rmse", a, b), 0);
    EXPECT_EQ(value("mae", a, Image(1, 1, 3, 0.25f)), 0.25);
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
    const Image pixel(1, 1, 1), four(2, 2, 1), mask(2, 1, 1);
    EXPECT_THROW(compute_metrics(Image(4, 3, 1), Image(3, 4, 1), {"rmse"}), UsageError);
    EXPECT_THROW(compute_metrics(Image(4, 3, 1), Image(4, 3, 3), {"rmse"}), UsageError);
    EXPECT_THROW(compute_metrics(pixel, pixel, {"rsme"}), UsageError);
    EXPECT_THROW(signed_difference(Image(1, 2, 1), Image(2, 1, 1)), UsageError);
    EXPECT_THROW(compute_metrics(pixel, pixel, {"rmse"}, {.valid_image = &mask}), UsageError);
    EXPECT_THROW(compute_metrics(pixel, pixel, {"rmse"}, {.mask = &mask}), UsageError);
    EXPECT_THROW(compute_metrics(Image(2, 2, 2), Image(2, 2, 2), {"flip"}), UsageError);
    for (const auto& rectangle : {Rectangle{0, 0, 0, 1}, Rectangle{-1, 0, 2, 2}, Rectangle{1, 0, 2, 2},
                                  Rectangle{0, 0, 1, 2147483647}, Rectangle{2147483647, 0, 2147483647, 1}})
        EXPECT_THROW(compute_metrics(four, four, {"rmse"}, {.rectangle = rectangle}), UsageError);
}

TEST(Metrics, EveryOneIsDescribed) {
    ASSERT_EQ(metric_names().size(), 11u);
    for (const auto& metric : metrics()) {
        EXPECT_FALSE(metric.label.empty()) << metric.name;
        EXPECT_EQ(metric.doc.back(), '.') << metric.name;
        EXPECT_EQ(&ir::metric(metric.name), &metric);
    }
}

TEST(Metrics, SignedDifference) {
    const Image result = signed_difference(grey({1, 2}), grey({3, 0.5f}));
    EXPECT_EQ(result.pixels, (std::vector<float>{-2, 1.5f}));
}

}  // namespace
}  // namespace ir
