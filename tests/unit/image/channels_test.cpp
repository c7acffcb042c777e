// Which channels of an image are values, and that metrics and differences go by that.
#include "renderers/image/channels.h"

#include <gtest/gtest.h>

#include "renderers/image/difference.h"
#include "renderers/image/metrics.h"

namespace ir {
namespace {

/// Four numbers a pixel, the fourth of which is far off.
Image four(float value, float fourth) {
    Image image(8, 8, 4, value);
    for (std::size_t i = 3; i < image.pixels.size(); i += 4) image.pixels[i] = fourth;
    return image;
}

TEST(Channels, TheFourthBesideAColourOrAVectorIsNoValue) {
    for (const auto semantic : {Semantic::radiance, Semantic::irradiance, Semantic::albedo, Semantic::normal,
                                Semantic::position, Semantic::velocity}) {
        EXPECT_EQ(value_channels(semantic, 4), 3) << to_string(semantic);
        for (const int channels : {1, 2, 3, 5}) EXPECT_EQ(value_channels(semantic, channels), channels);
    }
    for (const auto semantic : {Semantic::generic, Semantic::count, Semantic::accessibility,
                                Semantic::probability, Semantic::distance})
        EXPECT_EQ(value_channels(semantic, 4), 4) << to_string(semantic);
}

TEST(Channels, ValuesAreNotCopiedWhereAllAre) {
    const auto image = four(1, 9);
    Image kept;
    EXPECT_EQ(&values_of(image, Semantic::generic, kept), &image);
    EXPECT_TRUE(kept.empty());
    EXPECT_EQ(values_of(image, Semantic::radiance, kept).pixels, Image(8, 8, 3, 1).pixels);
}

TEST(Channels, MetricsAndDifferencesGoByTheMeaning) {
    const auto a = four(1, 9), b = four(1, 5);
    for (const auto& [semantic, mae, channels] :
         {std::tuple(Semantic::radiance, 0.0, 3), {Semantic::count, 1.0, 4}}) {
        const auto result = compute_metrics(a, b, {"mae", "mean", "ssim"}, {.semantic = semantic});
        EXPECT_DOUBLE_EQ(result.values.at("mae"), mae);
        EXPECT_DOUBLE_EQ(result.values.at("mean"), channels == 3 ? 1 : 3);
        EXPECT_EQ(result.values.at("ssim") < 1, channels == 4);
        EXPECT_EQ(difference(a, b, DifferenceKind::signed_, nullptr, nullptr, semantic).image.channels,
                  channels);
    }
    EXPECT_EQ(comparability(a, Image(8, 8, 3)).misfit, Misfit::none);
    EXPECT_EQ(comparability(a, Image(8, 8, 3), Semantic::count).misfit, Misfit::channels);
}

TEST(Channels, NamesInFilesTellFourValuesFromColours) {
    for (const auto semantic : {Semantic::generic, Semantic::radiance, Semantic::position})
        for (const int channels : {1, 2, 3, 4}) {
            const auto names = channel_names(semantic, channels);
            ASSERT_EQ(int(names.size()), channels);
            EXPECT_EQ(value_channels(semantic_of({"layer", names, Image(1, 1, channels)}), channels),
                      value_channels(semantic, channels));
        }
}

}  // namespace
}  // namespace ir
