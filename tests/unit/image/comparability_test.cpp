#include <gtest/gtest.h>

#include <utility>

#include "renderers/image/metrics.h"
#include "tests/unit/image/test_pictures.h"

namespace ir {
namespace {

Image turned(const Image& image, bool mirrored, bool upside_down) {
    Image result = image;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < image.channels; ++c)
                result.at(x, y, c) =
                    image.at(mirrored ? image.width - 1 - x : x, upside_down ? image.height - 1 - y : y, c);
    return result;
}

std::string why(const Image& a, const Image& b) {
    return why_not_comparable(a, b);
}

TEST(Comparability, NamesPicturesThatAreTurned) {
    const auto reference = test::colourful(64, 48), image = test::noisy(reference, 0.3f);
    EXPECT_NE(why(turned(image, false, true), reference).find("upside down"), std::string::npos);
    EXPECT_NE(why(turned(image, true, false), reference).find("mirrored"), std::string::npos);
    EXPECT_NE(why(turned(image, true, true), reference).find("180°"), std::string::npos);
    EXPECT_EQ(comparability(turned(image, true, false), reference).misfit, Misfit::orientation);
    const auto lamp = test::high_range(64, 48);
    EXPECT_NE(why(turned(lamp, false, true), lamp), "");
}

TEST(Comparability, NamesSizesAndChannels) {
    const auto on_its_side = comparability(Image(64, 48, 3), Image(48, 64, 3));
    EXPECT_EQ(on_its_side.misfit, Misfit::size);
    EXPECT_NE(on_its_side.why.find("on its side"), std::string::npos);
    EXPECT_NE(on_its_side.why.find("64x48"), std::string::npos);
    EXPECT_NE(why(Image(64, 48, 3), Image(64, 47, 3)).find("64x47"), std::string::npos);
    EXPECT_EQ(comparability(Image(4, 4, 1), Image(4, 4, 3)).misfit, Misfit::channels);
    EXPECT_EQ(why(Image(4, 4, 4), Image(4, 4, 3)), "");
}

TEST(Comparability, SuspectsNeitherNoisyNorSymmetricNorWrongPictures) {
    const auto reference = test::colourful(64, 48);
    EXPECT_EQ(why(reference, reference), "");
    EXPECT_EQ(why(test::noisy(reference, 1), test::noisy(test::shifted(reference), 1)), "");
    EXPECT_EQ(why(test::tinted(reference, 0.2f, 3, 0.5f), reference), "");
    EXPECT_EQ(why(Image(64, 48, 3), reference), "");
    EXPECT_EQ(why(Image(64, 48, 3, 0.5f), Image(64, 48, 3, 0.6f)), "");
    Image symmetric = reference;
    const auto mirrored = turned(reference, true, false);
    for (std::size_t i = 0; i < symmetric.pixels.size(); ++i) symmetric.pixels[i] += mirrored.pixels[i];
    EXPECT_EQ(why(turned(test::noisy(symmetric, 0.2f), true, false), symmetric), "");
    for (int trial = 0; trial < 50; ++trial) {  // noise alone
        Image a(16, 16, 1), b(16, 16, 1);
        for (int i = 0; i < 256; ++i)
            a.pixels[i] = test::random01(i, trial, 1), b.pixels[i] = test::random01(i, trial, 2);
        EXPECT_EQ(why(a, b), "");
    }
    // An error on one side only, such as a missing shadow, is no mirrored picture.
    auto wrong = symmetric;
    for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 16; ++x) wrong.at(x, y, 0) = wrong.at(x, y, 1) = wrong.at(x, y, 2) = 0;
    EXPECT_EQ(why(wrong, symmetric), "");
}

}  // namespace
}  // namespace ir
