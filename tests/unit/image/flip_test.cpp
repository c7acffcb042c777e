#include "renderers/image/flip.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <numeric>

#include "renderers/core/error.h"
#include "renderers/image/exr.h"
#include "tests/unit/image/test_pictures.h"

namespace ir {
namespace {

double mean(const Image& map) {
    return std::accumulate(map.pixels.begin(), map.pixels.end(), 0.0) / double(map.pixels.size());
}

void expect_sane(const Image& map) {
    for (const float value : map.pixels) ASSERT_TRUE(value >= 0 && value <= 1) << value;
}

/// A mean that the authors' own program (C++, version 1.6) computes for the same pair.
struct Published {
    const char* name;
    Image image, reference;
    double mean;
};

TEST(Flip, AgreesWithItsAuthorsProgram) {
    const auto r = test::colourful(96, 64);
    const Published pairs[] = {{"shifted", test::shifted(r), r, 0.211518},
                               {"blurred", test::blurred(r), r, 0.135437},
                               {"noisy", test::noisy(r, 0.3f), r, 0.140810},
                               {"tinted", test::tinted(r, 1, 0.8f, 0.9f), r, 0.317807}};
    for (const auto& pair : pairs)
        EXPECT_NEAR(mean(flip_error(pair.image, pair.reference)), pair.mean, 2e-6) << pair.name;
}

TEST(Flip, OfHighRangesAgreesWithItsAuthorsProgram) {
    const auto r = test::high_range(96, 64), black = test::partly_black(96, 64);
    const Published pairs[] = {{"shifted", test::shifted(r), r, 0.227510},
                               {"blurred", test::blurred(r), r, 0.227856},
                               {"noisy", test::noisy(r, 0.3f), r, 0.104651},
                               {"tinted", test::tinted(r, 1, 0.8f, 0.9f), r, 0.264749},
                               {"black part that is lit", test::noisy(r, 0.3f), black, 0.320040},
                               {"black part, blurred", test::blurred(black), black, 0.223011}};
    for (const auto& pair : pairs) {
        const auto result = hdr_flip_error(pair.image, pair.reference);
        EXPECT_NEAR(mean(result.error), pair.mean, 2e-6) << pair.name;
        EXPECT_NEAR(result.start, -4.28404, 1e-4) << pair.name;
        EXPECT_NEAR(result.stop, 5.40523, 1e-4) << pair.name;
        EXPECT_EQ(result.exposures, 10) << pair.name;
    }
}

/// The figures that the authors publish for the pictures in their repository, which is too large to ship.
TEST(Flip, AgreesWithItsAuthorsPublishedFigures) {
    const char* folder = std::getenv("INTERREFLECT_FLIP_IMAGES");
    if (!folder)
        GTEST_SKIP() << "INTERREFLECT_FLIP_IMAGES does not name the folder with the authors' reference.png, "
                        "test.png, reference.exr and test.exr";
    const auto picture = [&](const char* name) { return read_image(std::filesystem::path(folder) / name); };
    EXPECT_NEAR(mean(flip_error(picture("test.png"), picture("reference.png"))), 0.159691, 1e-6);
    EXPECT_NEAR(mean(hdr_flip_error(picture("test.exr"), picture("reference.exr")).error), 0.283478, 1e-6);
}

TEST(Flip, IsZeroForEqualPicturesAndOneAtMost) {
    const auto picture = test::colourful(40, 30);
    for (const float value : flip_error(picture, picture).pixels) EXPECT_EQ(value, 0);
    for (const float value : hdr_flip_error(picture, picture).error.pixels) EXPECT_EQ(value, 0);
    // Green and blue are the farthest apart of all [Andersson20 §4.1.3].
    Image green(32, 32, 3), blue(32, 32, 3);
    for (std::size_t i = 0; i < green.pixels.size(); i += 3) green.pixels[i + 1] = blue.pixels[i + 2] = 1;
    for (const float value : flip_error(green, blue).pixels) EXPECT_NEAR(value, 1, 1e-5);
}

TEST(Flip, IsSymmetric) {
    const auto a = test::colourful(40, 30), b = test::noisy(a, 0.5f);
    const auto there = flip_error(a, b), back = flip_error(b, a);
    for (std::size_t i = 0; i < there.pixels.size(); ++i) EXPECT_NEAR(there.pixels[i], back.pixels[i], 1e-5);
}

TEST(Flip, ShowsWhatAScreenShows) {
    EXPECT_EQ(mean(flip_error(Image(20, 20, 3, 5), Image(20, 20, 3, 1))), 0);
    EXPECT_EQ(mean(flip_error(Image(20, 20, 3, -5), Image(20, 20, 3, 0))), 0);
    EXPECT_GT(mean(hdr_flip_error(Image(20, 20, 3, 5), Image(20, 20, 3, 1)).error), 0.1);
}

TEST(Flip, OneChannelIsGrey) {
    Image a(20, 15, 1), b(20, 15, 1), a3(20, 15, 3), b3(20, 15, 3);
    for (int i = 0; i < 300; ++i) {
        a.pixels[i] = test::random01(i, 0, 1), b.pixels[i] = test::random01(i, 0, 2);
        for (int c = 0; c < 3; ++c) a3.pixels[3 * i + c] = a.pixels[i], b3.pixels[3 * i + c] = b.pixels[i];
    }
    EXPECT_EQ(flip_error(a, b).pixels, flip_error(a3, b3).pixels);
}

TEST(Flip, SeenFromFarAwayFineDifferencesVanish) {
    const auto picture = test::colourful(64, 64), other = test::noisy(picture, 0.3f);
    const double near = mean(flip_error(other, picture, {.pixels_per_degree = 30}));
    const double far = mean(flip_error(other, picture, {.pixels_per_degree = 200}));
    EXPECT_LT(far, 0.5 * near);
}

TEST(Flip, IsSaneInPicturesOfAnySize) {
    for (const auto& [width, height] : {std::pair{1, 1}, {1, 40}, {40, 1}, {2, 3}, {33, 31}}) {
        expect_sane(flip_error(Image(width, height, 3, 0.2f), Image(width, height, 3, 0.7f)));
        expect_sane(hdr_flip_error(Image(width, height, 1, 0.2f), Image(width, height, 1, 70)).error);
    }
}

TEST(HdrFlip, IsSaneWhereTheReferenceIsBlack) {
    const Image black(40, 30, 3), lit = test::high_range(40, 30);
    const auto all_black = hdr_flip_error(black, black);
    EXPECT_EQ(mean(all_black.error), 0);
    EXPECT_EQ(all_black.exposures, 1);

    // The range of the lit picture: what shows is not 0 by accident.
    const auto against_black = hdr_flip_error(lit, black);
    expect_sane(against_black.error);
    EXPECT_GT(mean(against_black.error), 0.5);
    EXPECT_EQ(against_black.start, hdr_flip_error(lit, lit).start);
    EXPECT_EQ(against_black.stop, hdr_flip_error(lit, lit).stop);

    // The median is black: what is lit has one.
    const auto mostly = test::mostly_black(40, 30);
    const auto half = hdr_flip_error(test::noisy(mostly, 0.3f), mostly);
    expect_sane(half.error);
    EXPECT_TRUE(std::isfinite(half.start) && std::isfinite(half.stop));
    EXPECT_LT(half.start, half.stop);
    EXPECT_GT(mean(half.error), 0.005);
    EXPECT_EQ(half.error.at(2, 15), 0);
}

TEST(HdrFlip, BoundsItsExposures) {
    Image extreme(30, 30, 1, 1e-30f);
    extreme.at(15, 15) = 1e30f;
    const auto result = hdr_flip_error(Image(30, 30, 1, 1), extreme);
    EXPECT_EQ(result.exposures, max_flip_exposures);
    expect_sane(result.error);
    Image denormal(30, 30, 1, 1e-42f), negative(30, 30, 1, -3);
    expect_sane(hdr_flip_error(denormal, extreme).error);
    expect_sane(hdr_flip_error(extreme, denormal).error);
    EXPECT_EQ(mean(hdr_flip_error(negative, Image(30, 30, 1)).error), 0);
}

TEST(HdrFlip, ExposuresComeFromValidPixelsOnly) {
    const auto picture = test::high_range(40, 30);
    auto damaged = picture;
    Image valid(40, 30, 1, 1.0f);
    for (int x = 0; x < 40; ++x) {
        damaged.at(x, 3, 1) = x % 2 ? 1e9f : std::numeric_limits<float>::infinity();
        valid.at(x, 3) = 0;
    }
    const auto range = flip_exposures(picture, damaged, &valid);
    EXPECT_EQ(range.stop, flip_exposures(picture, picture, &valid).stop);
    EXPECT_EQ(range.start, flip_exposures(picture, picture, &valid).start);
}

TEST(HdrFlip, TheMapSaysWhichExposureWasWorst) {
    const auto picture = test::high_range(48, 32);
    const auto result = hdr_flip_error(test::noisy(picture, 0.4f), picture);
    double lamp = 0, dark = 0;
    for (int i = -2; i <= 2; ++i) {
        lamp += result.exposure_map.at(36 + i, 8) / 5;
        dark += result.exposure_map.at(10 + i, 16) / 5;
    }
    EXPECT_LT(lamp, dark);
    for (const float index : result.exposure_map.pixels) EXPECT_LT(index, result.exposures);
}

TEST(Flip, RefusesWhatItCannotSee) {
    EXPECT_THROW(flip_error(Image(4, 4, 2), Image(4, 4, 2)), UsageError);
    EXPECT_THROW(flip_error(Image(4, 4, 3), Image(4, 5, 3)), UsageError);
    EXPECT_THROW(flip_error(Image(4, 4, 3), Image(4, 4, 3), {.pixels_per_degree = 0}), UsageError);
    EXPECT_THROW(flip_error(Image(4, 4, 3), Image(4, 4, 3), {.pixels_per_degree = NAN}), UsageError);
}

}  // namespace
}  // namespace ir
