#include "renderers/image/difference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "renderers/core/error.h"
#include "renderers/image/flip.h"
#include "tests/unit/image/test_pictures.h"

namespace ir {
namespace {

/// Differs in every pixel and looks different whichever way it is turned.
Image ramp(int channels) {
    Image image(3, 2, channels);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = 0.25f * float(i * i);
    return image;
}

TEST(Difference, KeepsSignAndPlace) {
    Image a = ramp(3), b = a;
    a.at(2, 0, 1) += 0.5f;
    b.at(0, 1, 2) += 0.25f;
    const auto signed_ = difference(a, b, DifferenceKind::signed_);
    EXPECT_TRUE(signed_.valid.empty());
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 3; ++x)
            for (int c = 0; c < 3; ++c) {
                const float expected = x == 2 && y == 0 && c == 1   ? 0.5f
                                       : x == 0 && y == 1 && c == 2 ? -0.25f
                                                                    : 0;
                EXPECT_FLOAT_EQ(signed_.image.at(x, y, c), expected) << x << " " << y << " " << c;
            }
    EXPECT_FLOAT_EQ(difference(a, b, DifferenceKind::absolute).image.at(0, 1, 2), 0.25f);
}

TEST(Difference, RelatesToTheSecondImage) {
    const Image a(1, 1, 1, 3), b(1, 1, 1, -2), black(1, 1, 1);
    const auto relative = [](const Image& x, const Image& y) {
        return difference(x, y, DifferenceKind::relative).image.at(0, 0);
    };
    EXPECT_FLOAT_EQ(relative(a, b), 5 / (2 + relative_difference_floor));
    EXPECT_FLOAT_EQ(relative(b, a), 5 / (3 + relative_difference_floor));
    EXPECT_FLOAT_EQ(relative(a, black), 3 / relative_difference_floor);
    EXPECT_EQ(relative(black, black), 0);
}

TEST(Difference, AlphaIsLeftOut) {
    Image a = ramp(4), b = ramp(4);
    b.at(1, 1, 3) += 7;
    const auto result = difference(a, b, DifferenceKind::absolute);
    EXPECT_EQ(result.image.channels, 3);
    for (float value : result.image.pixels) EXPECT_EQ(value, 0);
    // The reference's stride is that of four channels.
    EXPECT_FLOAT_EQ(difference(Image(3, 2, 4, 0), b, DifferenceKind::relative).image.at(2, 1, 2),
                    b.at(2, 1, 2) / (b.at(2, 1, 2) + relative_difference_floor));
}

TEST(Difference, ExcludedPixelsHaveNoValue) {
    const Image a = ramp(3);
    Image valid_a(3, 2, 1, 1), valid_b(3, 2, 1, 1);
    valid_a.at(1, 0) = 0;
    valid_b.at(2, 1) = 0;
    const auto result = difference(a, a, DifferenceKind::relative, &valid_a, &valid_b);
    ASSERT_FALSE(result.valid.empty());
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 3; ++x) {
            const bool out = (x == 1 && y == 0) || (x == 2 && y == 1);
            EXPECT_EQ(result.valid.at(x, y), out ? 0 : 1);
            EXPECT_EQ(std::isnan(result.image.at(x, y, 2)), out);
        }
}

TEST(Difference, BadValuesOfValidPixelsStayVisible) {
    Image a = ramp(1), b = ramp(1);
    a.at(0, 0) = std::numeric_limits<float>::quiet_NaN();
    a.at(1, 0) = std::numeric_limits<float>::infinity();
    const auto result = difference(a, b, DifferenceKind::signed_);
    EXPECT_TRUE(result.valid.empty());
    EXPECT_TRUE(std::isnan(result.image.at(0, 0)));
    EXPECT_TRUE(std::isinf(result.image.at(1, 0)));
}

TEST(Difference, SquaresGrowWithTheDifference) {
    EXPECT_FLOAT_EQ(difference(Image(1, 1, 1, 3), Image(1, 1, 1, 5), DifferenceKind::squared).image.at(0, 0),
                    4);
}

TEST(Difference, PerceivedErrorsAreOneChannel) {
    const auto b = test::colourful(20, 16), a = test::noisy(b, 0.5f);
    Image valid(20, 16, 1, 1), damaged = a;
    valid.at(3, 4) = 0;
    damaged.at(10, 10, 1) = std::numeric_limits<float>::quiet_NaN();
    for (const auto kind : {DifferenceKind::flip, DifferenceKind::hdr_flip}) {
        EXPECT_EQ(difference(a, b, kind).image.pixels,
                  (kind == DifferenceKind::flip ? flip_error(a, b) : hdr_flip_error(a, b).error).pixels);
        const auto result = difference(damaged, b, kind, &valid);
        EXPECT_EQ(result.image.channels, 1);
        EXPECT_TRUE(std::isnan(result.image.at(3, 4)));
        EXPECT_EQ(result.valid.at(3, 4), 0);
        EXPECT_TRUE(std::isnan(result.image.at(10, 10))) << "a bad value must stay visible";
        EXPECT_EQ(result.valid.at(10, 10), 1);
        EXPECT_GE(result.image.at(11, 10), 0);
    }
}

TEST(Difference, RefusesWhatDoesNotFitAndNamesBothSizes) {
    const auto refusal = [](const Image& a, const Image& b, const Image* mask = nullptr) -> std::string {
        try {
            difference(a, b, DifferenceKind::absolute, mask);
        } catch (const UsageError& error) {
            return error.what();
        }
        return {};
    };
    const std::string sizes = refusal(Image(3, 2, 1), Image(4, 2, 1));
    EXPECT_NE(sizes.find("A 3x2, B 4x2"), std::string::npos) << sizes;
    const std::string channels = refusal(Image(3, 2, 1), Image(3, 2, 2));
    EXPECT_NE(channels.find("A has 1, B has 2"), std::string::npos) << channels;
    const Image mask(2, 3, 1);
    EXPECT_NE(refusal(ramp(1), ramp(1), &mask).find("2x3"), std::string::npos);
}

}  // namespace
}  // namespace ir
