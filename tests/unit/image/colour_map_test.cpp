#include "renderers/image/colour_map.h"

#include <gtest/gtest.h>

#include <cmath>

#include "renderers/core/error.h"

namespace ir {
namespace {

using Entry = ColourMap::value_type;

/// Relative luminance of an sRGB colour [IEC 61966-2-1].
double luminance(const Entry& c) {
    return 0.2126 * linear_from_srgb(c[0] / 255.0f) + 0.7152 * linear_from_srgb(c[1] / 255.0f) +
           0.0722 * linear_from_srgb(c[2] / 255.0f);
}

void expect_near(const Entry& actual, const Entry& expected, int tolerance) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(actual[c], expected[c], tolerance) << "channel " << c;
}

TEST(ColourMap, AllHave256Entries) {
    ASSERT_EQ(colour_map_names().size(), 5u);
    for (const auto& name : colour_map_names()) EXPECT_EQ(colour_map(name).size(), 256u) << name;
}

TEST(ColourMap, EndPoints) {
    expect_near(colour_map("grey").front(), {0, 0, 0}, 0);
    expect_near(colour_map("grey").back(), {255, 255, 255}, 0);
    expect_near(colour_map("viridis").front(), {68, 1, 84}, 0);
    expect_near(colour_map("viridis")[128], {33, 145, 140}, 0);
    expect_near(colour_map("viridis").back(), {253, 231, 37}, 0);
    expect_near(colour_map("magma").front(), {0, 0, 4}, 0);
    expect_near(colour_map("magma").back(), {252, 253, 191}, 0);
    expect_near(colour_map("coolwarm").front(), {59, 76, 192}, 1);
    expect_near(colour_map("coolwarm").back(), {180, 4, 38}, 1);
}

TEST(ColourMap, TurboRunsFromBlueThroughGreenToRed) {
    const auto& map = colour_map("turbo");
    expect_near(map.front(), {35, 23, 27}, 0);  // constant terms of the polynomials
    EXPECT_GT(map[48][2], map[48][0] + 100);
    EXPECT_GT(map[128][1], map[128][0] + 50);
    EXPECT_GT(map[128][1], map[128][2] + 100);
    EXPECT_GT(map[208][0], map[208][1] + 100);
    EXPECT_LT(luminance(map.back()), luminance(map[128]));
}

TEST(ColourMap, CoolwarmIsNeutralInTheMiddle) {
    const auto& map = colour_map("coolwarm");
    for (const int i : {127, 128}) {
        expect_near(map[i], {221, 221, 221}, 3);
        EXPECT_GT(luminance(map[i]), luminance(map.front()));
        EXPECT_GT(luminance(map[i]), luminance(map.back()));
    }
}

TEST(ColourMap, SequentialMapsRiseInLuminance) {
    for (const std::string name : {"grey", "viridis", "magma"}) {
        const auto& map = colour_map(name);
        for (int i = 4; i < 256; ++i) EXPECT_GT(luminance(map[i]), luminance(map[i - 4])) << name << " " << i;
    }
}

TEST(ColourMap, UnknownNameListsTheKnown) {
    try {
        colour_map("jet");
        FAIL() << "jet is not known";
    } catch (const UsageError& error) {
        const std::string text = error.what();
        for (const auto& name : colour_map_names()) EXPECT_NE(text.find(name), std::string::npos) << text;
    }
}

TEST(ColourMap, SrgbTransferFunctions) {
    EXPECT_EQ(srgb_from_linear(0), 0);
    EXPECT_NEAR(srgb_from_linear(1), 1, 1e-6);
    EXPECT_NEAR(srgb_from_linear(0.214041f), 0.5f, 1e-5);
    EXPECT_NEAR(srgb_from_linear(0.0031308f), 0.04045f, 1e-5);
    for (int i = 0; i <= 1000; ++i) {
        const float x = i / 1000.0f;
        EXPECT_NEAR(linear_from_srgb(srgb_from_linear(x)), x, 2e-6);
    }
}

}  // namespace
TEST(StepMap, HasAStepForEachNumber) {
    const auto map =
        step_map({{-1, "below", tints::dark}, {1, "hit", tints::orange}, {4, "far", tints::sky}});
    EXPECT_EQ(map.low, -1.5);
    EXPECT_EQ(map.high, 4.5);
    const auto colour = [&](double number) {
        return map.colours[std::size_t((number - map.low) / (map.high - map.low) * 255 + 0.5)];
    };
    EXPECT_EQ(colour(-1), tints::dark);
    EXPECT_EQ(colour(1), tints::orange);
    EXPECT_EQ(colour(4), tints::sky);
    EXPECT_EQ(colour(2.5), colour_without_name);
}

}  // namespace ir
