#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>

#include "renderers/core/error.h"
#include "renderers/image/colour_map.h"
#include "renderers/image/exr.h"
#include "temporary_folder.h"

namespace ir {
namespace {

/// One grey step of an 8-bit sRGB file, as a linear tolerance at a value.
float step_at(float linear) {
    const float encoded = srgb_from_linear(linear);
    return linear_from_srgb(encoded + 0.51f / 255) - linear_from_srgb(encoded - 0.51f / 255);
}

TEST(Png, KeepsValuesAndOrientation) {
    TemporaryFolder folder;
    Image image(4, 3, 3);
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 4; ++x) {
            image.at(x, y, 0) = x / 4.0f;
            image.at(x, y, 1) = y / 3.0f;
            image.at(x, y, 2) = 0.75f;
        }
    write_png(folder / "a.png", image);
    const Image read = read_image(folder / "a.png");
    ASSERT_EQ(read.width, 4);
    ASSERT_EQ(read.height, 3);
    ASSERT_EQ(read.channels, 3);
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        EXPECT_NEAR(read.pixels[i], image.pixels[i], step_at(image.pixels[i])) << i;
    EXPECT_EQ(folder.files(), 1u);
}

TEST(Png, ExposureAndClamping) {
    TemporaryFolder folder;
    Image image(4, 1, 1);
    image.pixels = {0.25f, 4.0f, -1.0f, std::numeric_limits<float>::quiet_NaN()};
    write_png(folder / "a.png", image, 1);
    const Image read = read_image(folder / "a.png");
    ASSERT_EQ(read.channels, 1);
    EXPECT_NEAR(read.at(0, 0), 0.5f, step_at(0.5f));
    EXPECT_FLOAT_EQ(read.at(1, 0), 1);
    EXPECT_FLOAT_EQ(read.at(2, 0), 0);
    EXPECT_FLOAT_EQ(read.at(3, 0), 0);
}

TEST(Png, AlphaIsNeitherEncodedNorExposedNorMultiplied) {
    TemporaryFolder folder;
    Image image(1, 1, 4);
    image.pixels = {0.5f, 0.25f, 0.125f, 0.4f};
    write_png(folder / "a.png", image, 0);
    const Image read = read_image(folder / "a.png");
    ASSERT_EQ(read.channels, 4);
    EXPECT_NEAR(read.at(0, 0, 0), 0.5f, step_at(0.5f));
    EXPECT_NEAR(read.at(0, 0, 2), 0.125f, step_at(0.125f));
    EXPECT_NEAR(read.at(0, 0, 3), 0.4f, 0.51f / 255);
}

TEST(Png, Errors) {
    TemporaryFolder folder;
    EXPECT_THROW(read_image(folder / "none.png"), InputError);
    EXPECT_THROW(read_image(folder.path()), InputError);
    std::ofstream(folder / "text.png") << "this is no image";
    try {
        read_image(folder / "text.png");
        FAIL() << "a text file was read as an image";
    } catch (const InputError& error) {
        const std::string text = error.what();
        EXPECT_NE(text.find("text.png"), std::string::npos) << text;
        EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    }
    write_png(folder / "a.png", Image(1, 1, 3, 0.5f));
    EXPECT_THROW(read_image(folder / "a.png", "depth"), InputError);
    EXPECT_THROW(write_png(folder / "none/a.png", Image(1, 1, 3)), Error);
    EXPECT_THROW(write_png(folder / "b.png", Image()), Error);
}

}  // namespace
}  // namespace ir
