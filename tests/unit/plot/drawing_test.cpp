#include <gtest/gtest.h>

#include <algorithm>

#include "renderers/plot/plot_drawing.h"

namespace ir {
namespace {

/// Notes where texts stand; letters are 8 by 12 pixels.
class NotingCanvas : public PlotCanvas {
  public:
    struct Text {
        std::string words;
        Box box;
    };
    std::vector<Text> texts;

    double line_height() const override { return 18; }
    double width_of(const std::string& words, Letters) const override { return 8 * double(words.size()); }
    void text(Place at, const std::string& words, Anchor anchor, const Ink&, Letters letters) override {
        const double width = width_of(words, letters);
        const double share = anchor == Anchor::start ? 0 : anchor == Anchor::middle ? 0.5 : 1;
        if (letters == Letters::upwards)
            texts.push_back({words, {at.x - 6, at.y - (1 - share) * width, at.x + 6, at.y + share * width}});
        else
            texts.push_back({words, {at.x - share * width, at.y - 6, at.x + (1 - share) * width, at.y + 6}});
    }
    void line(const std::vector<Place>&, const Ink&, const Stroke&) override {}
    void shape(const Shape&) override {}
    void box(const Box&, const Ink&) override {}
};

PlotData sample(int series) {
    PlotData data;
    data.title = "Error over directions";
    data.x = {"Time of rendering (ms)", true, {}, {}};
    data.y = {"RMSE of all pixels", true, {}, {}};
    const auto point = [](const std::string& id, double x, double y) {
        PlotPoint made;
        made.id = id;
        made.x = x;
        made.y = y;
        return made;
    };
    for (int s = 0; s < series; ++s) {
        const auto name = std::to_string(s);
        data.series.push_back(
            {"experiment " + name, {point("a" + name, 1 + s, 0.2), point("b" + name, 900, 0.01)}});
    }
    data.level = PlotLevel{0.002, "noise of the reference"};
    return data;
}

TEST(PlotDrawing, TextsLieInsideAndLeaveTheAxesFree) {
    for (const int series : {1, 3, 40})
        for (const auto& [width, height] : {std::pair{640, 400}, {900, 180}, {300, 160}, {1920, 1080}}) {
            const auto what =
                std::to_string(series) + " series, " + std::to_string(width) + " x " + std::to_string(height);
            NotingCanvas canvas;
            const auto data = sample(series);
            const PlotDrawing drawing(data, PlotStyle::paper(), width, height, true, canvas);
            drawing.draw(canvas);
            const auto& area = drawing.area();
            EXPECT_GE(area.height(), 40) << what;
            int titles = 0;
            for (const auto& [words, box] : canvas.texts) {
                EXPECT_TRUE(box.left >= 0 && box.right <= width && box.top >= 0 && box.bottom <= height)
                    << words << " of " << what;
                titles += words == data.x.title || words == data.y.title ? 1 : 0;
                if (words == data.level->label) continue;
                EXPECT_TRUE(box.right <= area.left || box.left >= area.right || box.bottom <= area.top ||
                            box.top >= area.bottom)
                    << words << " of " << what;
            }
            EXPECT_EQ(titles, 2) << what;
        }
}

TEST(PlotDrawing, NamesThatFindNoRoomInTheLegendAreCounted) {
    NotingCanvas canvas;
    const auto data = sample(40);
    PlotDrawing(data, PlotStyle::paper(), 640, 300, true, canvas).draw(canvas);
    int named = 0, rest = 0;
    for (const auto& [words, box] : canvas.texts) {
        named += words.rfind("experiment ", 0) == 0 ? 1 : 0;
        if (words.rfind("and ", 0) == 0) rest = std::stoi(words.substr(4));
    }
    EXPECT_GT(named, 0);
    EXPECT_GT(rest, 0);
    EXPECT_EQ(named + rest, 40);
}

TEST(PlotDrawing, LongTextsAreShortenedToTheirRoom) {
    NotingCanvas canvas;
    auto data = sample(1);
    data.y.title = std::string(200, 'y');
    data.series[0].name = std::string(200, 'n');
    PlotDrawing(data, PlotStyle::paper(), 300, 200, true, canvas).draw(canvas);
    int shortened = 0;
    for (const auto& [words, box] : canvas.texts) {
        EXPECT_TRUE(box.left >= 0 && box.right <= 300 && box.top >= 0 && box.bottom <= 200) << words;
        shortened += words.size() > 3 && words.substr(words.size() - 3) == "…" ? 1 : 0;
    }
    EXPECT_EQ(shortened, 2);
}

}  // namespace
}  // namespace ir
