#include "renderers/image/enlarge.h"

#include <gtest/gtest.h>

namespace ir {
namespace {

Image numbered(int width, int height, int channels = 1) {
    Image image(width, height, channels);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = static_cast<float>(i);
    return image;
}

TEST(Enlarge, EachTexelCoversEquallyManyPixelsWhereTheRatioIsWhole) {
    const auto image = numbered(3, 2, 2);
    for (const int ratio : {2, 3, 5}) {
        const auto large = enlarged(image, 3 * ratio, 2 * ratio);
        for (int y = 0; y < large.height; ++y)
            for (int x = 0; x < large.width; ++x)
                for (int c = 0; c < 2; ++c)
                    ASSERT_EQ(large.at(x, y, c), image.at(x / ratio, y / ratio, c)) << x << ", " << y;
    }
}

TEST(Enlarge, OtherwiseAPixelTakesTheTexelUnderItsCentre) {
    const auto large = enlarged(numbered(2, 1), 5, 1);
    EXPECT_EQ(large.pixels, (std::vector<float>{0, 0, 1, 1, 1})) << "2.5 lies where texel 1 begins";
    EXPECT_EQ(enlarged(numbered(3, 1), 4, 1).pixels, (std::vector<float>{0, 1, 1, 2}));
}

TEST(Enlarge, OnlySizesOfEqualProportionsAreReductions) {
    EXPECT_TRUE(is_reduced(96, 54, 192, 108));
    EXPECT_TRUE(is_reduced(97, 55, 193, 109)) << "rounded up";
    EXPECT_TRUE(is_reduced(48, 27, 192, 108));
    EXPECT_FALSE(is_reduced(192, 108, 192, 108)) << "the same size is none";
    EXPECT_FALSE(is_reduced(192, 54, 192, 108));
    EXPECT_FALSE(is_reduced(64, 64, 192, 108)) << "a map beside a picture";
    EXPECT_FALSE(is_reduced(192, 108, 96, 54));
    EXPECT_FALSE(is_reduced(0, 0, 192, 108));
}

}  // namespace
}  // namespace ir
