#include <gtest/gtest.h>

#include <cmath>
#include <regex>

#include "renderers/plot/line_profile.h"
#include "renderers/plot/placed_plot.h"
#include "renderers/plot/plot_svg.h"

namespace ir {
namespace {

/// x + 100 y in the first channel, ten times that in the second, a hundred times in the third.
Image numbered(int width, int height, int channels = 3) {
    Image image(width, height, channels);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < channels; ++c) image.at(x, y, c) = float((x + 100 * y) * std::pow(10, c));
    return image;
}

std::size_t occurrences(const std::string& text, const std::string& part) {
    std::size_t found = 0;
    for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
    return found;
}

TEST(LineProfile, ReadsThePixelsThatTheLinePasses) {
    const auto image = numbered(40, 30);
    const std::vector<MeasuredImage> images = {{"A", &image, nullptr, nullptr, Semantic::radiance}};
    const auto row = line_profile(images, {3, 7, 12, 7}, 0);
    ASSERT_EQ(row.places.size(), 10u);
    ASSERT_EQ(row.curves.size(), 1u);
    for (int i = 0; i < 10; ++i) {
        EXPECT_EQ(row.curves[0].values[std::size_t(i)], 703 + i);
        EXPECT_DOUBLE_EQ(row.places[std::size_t(i)].distance, i);
    }
    // Backwards and steep: one value for each step along the longer axis, both ends included.
    const auto steep = line_profile(images, {20, 25, 16, 5}, 0);
    ASSERT_EQ(steep.places.size(), 21u);
    EXPECT_EQ(steep.curves[0].values.front(), 2520);
    EXPECT_EQ(steep.curves[0].values.back(), 516);
    EXPECT_DOUBLE_EQ(steep.places.back().distance, std::hypot(4, 20));
    for (std::size_t i = 0; i < steep.places.size(); ++i) {
        EXPECT_EQ(steep.places[i].y, 25 - int(i));
        EXPECT_LE(std::abs(steep.places[i].x - (20 - double(i) / 5)), 0.5);
    }
    EXPECT_EQ(line_profile(images, {5, 5, 5, 5}, 0).places.size(), 1u);
}

TEST(LineProfile, ReadsTheChosenChannels) {
    const auto colour = numbered(8, 8), depth = numbered(8, 8, 1);
    const std::vector<MeasuredImage> images = {{"light", &colour, nullptr, nullptr, Semantic::radiance},
                                               {"normal", &colour, nullptr, nullptr, Semantic::normal},
                                               {"depth", &depth, nullptr, nullptr, Semantic::depth}};
    const PixelLine line{2, 1, 5, 1};
    const auto one = line_profile(images, line, one_number);
    ASSERT_EQ(one.curves.size(), 3u);
    EXPECT_EQ(one.curves[0].name, "light  luminance");
    EXPECT_NEAR(one.curves[0].values[0], 102 * (0.2126 + 7.152 + 7.22), 1e-2);
    EXPECT_NEAR(one.curves[1].values[0], 102 * std::sqrt(1.0 + 100 + 10000), 1e-2);
    EXPECT_EQ(one.curves[2].name, "depth");
    EXPECT_EQ(one.curves[2].values[0], 102);
    const auto all = line_profile(images, line, all_channels);
    ASSERT_EQ(all.curves.size(), 7u);
    EXPECT_EQ(all.curves[1].name, "light  G");
    EXPECT_EQ(all.curves[4].name, "normal  Y");
    EXPECT_EQ(all.curves[1].values[3], 1050);
    EXPECT_EQ(line_profile(images, line, 2).curves.size(), 2u) << "depth has no third channel";
}

TEST(LineProfile, WhatHasNoValueBreaksTheCurveAndIsEmptyInTables) {
    auto image = numbered(32, 4, 1);
    image.at(10, 2) = std::nanf("");
    Image valid(32, 4, 1, 1);
    valid.at(20, 2) = 0;
    const std::vector<MeasuredImage> images = {{"depth, \"seen\"", &image, &valid, nullptr, Semantic::depth}};
    const auto profile = line_profile(images, {0, 2, 31, 2}, one_number);
    const auto plot = plot_of(profile, "Value (m)");
    const auto svg = plot_svg(plot, 640, 400, true);
    EXPECT_EQ(occurrences(svg, "class=\"line "), 4u) << "in the legend, before, between and behind the gaps";
    EXPECT_EQ(occurrences(svg, "<title>"), occurrences(svg, "<g>"));
    EXPECT_LE(occurrences(svg, "<g>"), 9u) << "a curve has few marks";
    EXPECT_GE(occurrences(svg, "<g>"), 5u);
    const auto csv = profile_csv(profile);
    EXPECT_EQ(csv.substr(0, csv.find('\n')), "x,y,distance,\"depth, \"\"seen\"\"\"");
    EXPECT_NE(csv.find("\n9,2,9,209\n10,2,10,\n11,2,11,211\n"), std::string::npos) << csv;
    EXPECT_NE(csv.find("\n20,2,20,\n"), std::string::npos) << csv;
    EXPECT_EQ(occurrences(csv, "\n"), 33u);
}

TEST(LineProfile, GapsOfAnAtlasHaveNoValue) {
    const auto atlas = make_atlas(8, 8, 1, 4);
    const Image image(atlas.width, atlas.height, 1, 5);
    const std::vector<MeasuredImage> images = {{"slices", &image, nullptr, &atlas, Semantic::generic}};
    const auto profile = line_profile(images, {0, 0, atlas.width - 1, 0}, one_number);
    int gaps = 0;
    for (const double value : profile.curves[0].values) gaps += std::isnan(value);
    EXPECT_EQ(gaps, atlas.width - 16);
    EXPECT_GT(gaps, 0);
}

TEST(PlacedPlot, OtherPlotsJoinTheirPointsAcrossGaps) {
    PlotData plot;
    plot.series = {
        {"s",
         {{"a", 0, 1, "", false, {}}, {"b", 1, std::nan(""), "", false, {}}, {"c", 2, 2, "", false, {}}}}};
    const auto placed = place_plot(plot, 400, 300);
    ASSERT_EQ(placed.marks.size(), 2u);
    EXPECT_TRUE(placed.marks[0].begins && placed.marks[0].shown);
    EXPECT_TRUE(!placed.marks[1].begins && placed.marks[1].shown);
    plot.are_curves = true;
    EXPECT_TRUE(place_plot(plot, 400, 300).marks[1].begins);
}

}  // namespace
}  // namespace ir
