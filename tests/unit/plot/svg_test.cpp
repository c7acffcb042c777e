#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <regex>
#include <set>

#include "renderers/plot/placed_plot.h"
#include "renderers/plot/plot_style.h"
#include "renderers/plot/plot_svg.h"

namespace ir {
namespace {

PlotData sample() {
    PlotData data;
    data.title = "Error <of> \"maps\"";
    data.x = {"Time (ms)", true, {}, {}};
    data.y = {"RMSE", true, {}, {}};
    data.series = {{"fast & good", {{"a", 1, 0.2, "a", true, {}}, {"b", 100, 0.1, "b", false, {}}}},
                   {"slow", {{"c", 90, 0.05, "c", true, {}}, {"d", 2000, 0.004, "d", true, {}}}}};
    data.ring_name = "front";
    data.join_rings = true;
    data.level = PlotLevel{0.002, "noise"};
    return data;
}

std::size_t count(const std::string& text, const std::string& expression) {
    const std::regex pattern(expression);
    return std::size_t(std::distance(std::sregex_iterator(text.begin(), text.end(), pattern), {}));
}

TEST(PlotSvg, PointsStandWhereTheScalesPutThem) {
    const auto svg = plot_svg(sample(), 640, 400, true);
    // Within the axes, from left to right as their times.
    const std::regex circle(
        R"re(<g><title>(\w)</title><(?:circle cx="([\d.]+)" cy="([\d.]+)"|polygon points="([\d.]+),([\d.]+)))re");
    std::map<std::string, std::pair<double, double>> places;
    for (std::sregex_iterator it(svg.begin(), svg.end(), circle), end; it != end; ++it)
        places[(*it)[1]] = {std::stod((*it)[2].length() ? (*it)[2] : (*it)[4]),
                            std::stod((*it)[3].length() ? (*it)[3] : (*it)[5])};
    ASSERT_EQ(places.size(), 4u) << svg;
    EXPECT_LT(places["a"].first, places["c"].first);
    EXPECT_LT(places["b"].first, places["d"].first);
    EXPECT_LT(places["a"].second, places["b"].second) << "a larger error stands higher";
    EXPECT_GT(places["d"].second, places["c"].second);
    // A decade of error is everywhere as long.
    const double decade = (places["b"].second - places["a"].second) / std::log10(2.0);
    EXPECT_NEAR((places["c"].second - places["a"].second) / std::log10(4.0), decade, 0.15 * decade);
    for (const auto& [id, place] : places) {
        EXPECT_GT(place.first, 30) << id;
        EXPECT_LT(place.first, 640 - 10) << id;
        EXPECT_GT(place.second, 50) << id;
        EXPECT_LT(place.second, 400 - 40) << id;
    }
}

TEST(PlotSvg, NamesAreEscaped) {
    const auto svg = plot_svg(sample(), 640, 400, true);
    EXPECT_NE(svg.find("Error &lt;of&gt; &quot;maps&quot;"), std::string::npos);
    EXPECT_NE(svg.find("fast &amp; good"), std::string::npos);
    EXPECT_EQ(svg.find("<of>"), std::string::npos);
}

TEST(PlotSvg, RingsTheLevelAndEmptyPlotsAreDrawn) {
    const auto svg = plot_svg(sample(), 640, 400, true);
    EXPECT_EQ(count(svg, "class=\"ring\""), 3u);
    EXPECT_EQ(count(svg, "class=\"level\""), 1u);
    EXPECT_EQ(count(svg, "class=\"line s[01]\""), 4u) << "two of the legend, two of the series";
    EXPECT_EQ(count(plot_svg({}, 640, 400, true), "<g>"), 0u);
    auto alone = sample();
    alone.series.resize(1);
    alone.series[0].points = {{"x", 3, std::nan(""), "x", false, {}}};
    EXPECT_EQ(count(plot_svg(alone, 640, 400, false), "<g>"), 0u);
    EXPECT_EQ(plot_svg(sample(), 640, 400, false).find("Error &lt;of"),
              plot_svg(sample(), 640, 400, false).rfind("Error &lt;of"))
        << "a part of a page leaves the title to it";
}

TEST(PlotSvg, BarsLieInTheirRowsFromWhereTheyBegin) {
    PlotData data;
    data.title = "Waterfall";
    data.x.title = "RMSE";
    data.are_bars = true;
    data.y.names = {"left", "a stage", "as it is"};  // from below
    data.series = {{"", {}}};
    const auto add = [&](const char* id, double row, double from, double to) {
        PlotPoint point;
        point.id = point.label = id;
        point.x = to;
        point.y = row;
        point.value = from;
        data.series[0].points.push_back(point);
    };
    add("base", 2, 0, 1);
    add("stage", 1, 1, 0.25);
    add("left", 0, 0, 0.25);
    const auto svg = plot_svg(data, 640, plot_svg_height_of(data), true);
    const std::regex bar(
        R"re(<g><title>(\w+)</title><rect x="([\d.]+)" y="([\d.]+)" width="([\d.]+)" height="([\d.]+)")re");
    std::map<std::string, std::array<double, 4>> bars;
    for (std::sregex_iterator it(svg.begin(), svg.end(), bar), end; it != end; ++it)
        bars[(*it)[1]] = {std::stod((*it)[2]), std::stod((*it)[3]), std::stod((*it)[4]), std::stod((*it)[5])};
    ASSERT_EQ(bars.size(), 3u) << svg;
    const auto &base = bars["base"], &stage = bars["stage"], &left = bars["left"];
    EXPECT_NEAR(stage[0] + stage[2], base[0] + base[2], 0.1) << "begins where the one before ends";
    EXPECT_NEAR(stage[0], left[0] + left[2], 0.1);
    EXPECT_NEAR(stage[2], 0.75 * base[2], 0.1);
    EXPECT_LT(base[1] + base[3], stage[1]) << "the first row stands at the top";
    EXPECT_LT(stage[1] + stage[3], left[1]);
    for (const auto& name : data.y.names) EXPECT_NE(svg.find(">" + name + "</text>"), std::string::npos);
    EXPECT_EQ(count(svg, "class=\"line"), 0u);
    // Many rows keep their names, as the picture grows with them.
    for (int i = 0; i < 40; ++i) data.y.names.push_back("row " + std::to_string(i));
    const auto tall = plot_svg(data, 640, plot_svg_height_of(data), true);
    for (const auto& name : data.y.names) EXPECT_NE(tall.find(">" + name + "</text>"), std::string::npos);
}

TEST(PlotSvg, LongTitlesAreBrokenAndThenEndInAnEllipsis) {
    auto data = sample();
    data.title = "From Horizon-based ambient occlusion to Horizon-based ambient occlusion 2";
    auto svg = plot_svg(data, 400, 300, true);
    EXPECT_NE(svg.find(">From Horizon-based ambient occlusion to</text>"), std::string::npos) << svg;
    EXPECT_NE(svg.find(">Horizon-based ambient occlusion 2</text>"), std::string::npos);
    data.title += ", which goes on and on and on and on";
    svg = plot_svg(data, 400, 300, true);
    EXPECT_NE(svg.find("…</text>"), std::string::npos);
    EXPECT_EQ(svg.find("on and on and on</text>"), std::string::npos);
    for (int i = 0; i < 500'000; ++i) data.title += " on";  // a book takes no longer
    EXPECT_NE(plot_svg(data, 400, 300, true).find("…</text>"), std::string::npos);
}

TEST(PlotStyle, SeriesDifferInColourOrShape) {
    for (int a = 0; a < 40; ++a)
        for (int b = 0; b < a; ++b)
            EXPECT_TRUE(PlotStyle::paper().series(a) != PlotStyle::paper().series(b) ||
                        mark_corners(a) != mark_corners(b))
                << a << " and " << b;
}

/// Values 1, 10, 100 and none, at two by two places.
PlotData tiles() {
    PlotData data;
    data.title = "RMSE over a and b";
    data.x = {"a", false, {"small", "large"}, {}};
    data.y = {"b", false, {"4", "8"}, {}};
    data.heat = PlotHeat{"RMSE"};
    const auto tile = [](const char* id, double x, double y, double value) {
        PlotPoint point{id, x, y, id};
        point.value = value;
        return point;
    };
    data.series = {{"b = 4", {tile("p", 0, 0, 1), tile("q", 1, 0, 10)}}, {"b = 8", {tile("r", 0, 1, 100)}}};
    return data;
}

TEST(PlotSvg, TilesOfAHeatMapTouchAndHaveTheColoursOfTheirValues) {
    const auto svg = plot_svg(tiles(), 640, 400, true);
    const std::regex rect(
        R"re(<g><title>(\w)</title><rect x="([\d.]+)" y="([\d.]+)" width="([\d.]+)" height="([\d.]+)" fill="(#\w+)")re");
    std::map<std::string, std::vector<double>> boxes;
    std::map<std::string, std::string> colours;
    for (std::sregex_iterator it(svg.begin(), svg.end(), rect), end; it != end; ++it) {
        for (int i = 2; i <= 5; ++i) boxes[(*it)[1]].push_back(std::stod((*it)[i]));
        colours[(*it)[1]] = (*it)[6];
    }
    ASSERT_EQ(boxes.size(), 3u) << svg;
    EXPECT_NEAR(boxes["p"][0] + boxes["p"][2], boxes["q"][0], 0.02);
    EXPECT_NEAR(boxes["r"][1] + boxes["r"][3], boxes["p"][1], 0.02) << "larger values of b stand higher";
    // Two decades: the middle one in the middle of the colours.
    const auto placed = place_plot(tiles(), 500, 300);
    ASSERT_TRUE(placed.heat && placed.heat->log);
    EXPECT_NEAR(placed.heat->at(0.5), 10, 1e-9);
    EXPECT_EQ(colours["q"], placed.heat->colour(10));
    EXPECT_EQ(std::set<std::string>({colours["p"], colours["q"], colours["r"]}).size(), 3u);
    EXPECT_EQ(placed.heat->ink(1), "#ffffff");
    EXPECT_EQ(placed.heat->ink(100), "#000000");
    EXPECT_EQ(count(svg, ">10</text>"), 1u) << "the value is written in its tile";
    EXPECT_EQ(count(svg, "class=\"line "), 0u);
}

TEST(PlotSvg, AHeatMapOfOneValueHasAColour) {
    auto data = tiles();
    data.series = {{"b = 4", {data.series[0].points[0]}}};
    EXPECT_EQ(count(plot_svg(data, 640, 400, true), "class=\"tile\""), 1u);
}

}  // namespace
}  // namespace ir
