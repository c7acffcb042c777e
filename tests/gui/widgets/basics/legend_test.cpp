#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "widgets/image/image_view.h"
#include "widgets/image/legend.h"

namespace ir::widgets {
namespace {

TEST(Legend, ListsOnlyWhatOccurs) {
    const auto prepared = [](Image image) {
        auto picture = std::make_shared<Picture>(*make_picture(std::move(image), Semantic::generic));
        picture->categories = {{0, "miss", tints::sky}, {1, "hit", tints::orange}, {2, "own", tints::green}};
        const auto display = display_for(Semantic::generic, {}, *picture->image, {}, picture->categories);
        return PictureCache().prepare(picture, display);
    };
    Image image(2, 1, 1);
    image.pixels = {0, 2};
    auto found = prepared(image);
    ASSERT_EQ(found.occurring->categories.size(), 2u);
    EXPECT_EQ(found.occurring->categories[1].label, "own");
    EXPECT_FALSE(found.occurring->bad.nan);
    const qreal without = legend_size(found, 1, 1000).height();
    image.pixels = {std::nanf(""), 2};
    found = prepared(image);
    EXPECT_TRUE(found.occurring->bad.nan);
    image.pixels = {1, 1};
    EXPECT_LT(legend_size(prepared(image), 1, 1000).height(), without);
}

/// A difference has no number where a mask hides both pictures, and no colour for it is seen.
TEST(Legend, LeavesOutWhatAMaskHides) {
    Image image(2, 1, 1), valid(2, 1, 1);
    image.pixels = {std::nanf(""), 2};
    valid.pixels = {0, 1};
    auto picture = std::make_shared<Picture>(*make_picture(image, Semantic::generic));
    picture->valid = std::make_shared<Image>(valid);
    Display display;
    display.mode = Display::Mode::scalar;
    display.hide_invalid = true;
    const auto height = [&] {
        return legend_size(PictureCache().prepare(picture, display), 1, 1000).height();
    };
    const qreal masked = height();
    image.pixels = {1, 2};
    picture->image = std::make_shared<Image>(image);
    EXPECT_EQ(masked, height());
    display.hide_invalid = false;
    const qreal bare = height();
    image.pixels = {std::nanf(""), 2};
    picture->image = std::make_shared<Image>(image);
    EXPECT_GT(height(), bare) << "then it is seen";
}

TEST(Legend, MarksEndsThatValuesGoBeyond) {
    Image image(2, 1, 1);
    image.pixels = {0, 1};
    const auto picture = make_picture(image, Semantic::generic);
    Display display;
    display.mode = Display::Mode::scalar;
    const auto width = [&](double low, double high) {
        display.low = low;
        display.high = high;
        return legend_size(PictureCache().prepare(picture, display), 1, 1000).width();
    };
    EXPECT_EQ(PictureCache().prepare(picture, display).occurring->greatest, 1);
    EXPECT_GT(width(0, 0.25), width(0, 1.25));   // "≥ 0.25"
    EXPECT_GT(width(0.25, 1), width(-0.25, 1));  // "≤ 0.25"
}

TEST(Legend, TicksAreRoundNumbersBetweenTheEnds) {
    EXPECT_EQ(legend_ticks(0, 1, 6), (std::vector<double>{0, 0.2, 0.4, 0.6000000000000001, 0.8, 1}));
    const auto ticks = legend_ticks(-3.3, 8.9, 6);
    EXPECT_EQ(ticks.front(), -3.3);
    EXPECT_EQ(ticks.back(), 8.9);
    EXPECT_TRUE(std::is_sorted(ticks.begin(), ticks.end()));
    EXPECT_GE(ticks.size(), 4u);
    EXPECT_EQ(legend_ticks(2, 2, 6), std::vector<double>{2});
}

}  // namespace
}  // namespace ir::widgets
