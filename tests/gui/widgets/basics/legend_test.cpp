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
    EXPECT_FALSE(found.occurring->nan);
    const qreal without = legend_size(found, 1, 1000).height();
    image.pixels = {std::nanf(""), 2};
    found = prepared(image);
    EXPECT_TRUE(found.occurring->nan);
    image.pixels = {1, 1};
    EXPECT_LT(legend_size(prepared(image), 1, 1000).height(), without);
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
