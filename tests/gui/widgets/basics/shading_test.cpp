// From numbers to colours: by themselves, and the same on both surfaces.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/gui/widgets/surfaces.h"
#include "widgets/image/image_view.h"

namespace ir::widgets {
namespace {

/// Both surfaces with the same picture and display, pixel by pixel.
void expect_same_on_both(const std::shared_ptr<const Picture>& picture, const Display& display,
                         const std::string& what) {
    ImageView gl(nullptr, ImageView::Surface::best), raster(nullptr, ImageView::Surface::raster);
    QImage shots[2];
    for (auto* view : {&gl, &raster}) {
        view->set_picture(picture);
        view->set_display(display);
        view->set_pixel_grid(false);
        show(*view, {400, 200});
        view->look_at({8, 4}, 24);  // whole pixels, so that no edge falls on the middle of a screen's
        shots[view == &raster] = view->grab().toImage();
    }
    int differing = 0;
    for (int y = 0; y < shots[0].height(); ++y)
        for (int x = 0; x < shots[0].width(); ++x) {
            const QColor a = shots[0].pixelColor(x, y), b = shots[1].pixelColor(x, y);
            differing += std::abs(a.red() - b.red()) > 3 || std::abs(a.green() - b.green()) > 3 ||
                         std::abs(a.blue() - b.blue()) > 3;
        }
    EXPECT_EQ(differing, 0) << what;
    const QImage snapshot = gl.snapshot(true, false);
    EXPECT_EQ(snapshot.size(), shots[1].size());
    QImage seen = shots[1].convertToFormat(snapshot.format());
    seen.setDevicePixelRatio(1);
    EXPECT_EQ(snapshot, seen) << what;
}

TEST(Surfaces, ShowTheSameMeansOfReducedPictures) {
    if (!has_opengl()) GTEST_SKIP() << "Qt has no OpenGL here; start under a virtual X server";
    Image image(400, 300, 1);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = float(i * i % 97) / 96;
    Display display;
    display.mode = Display::Mode::scalar;
    ImageView gl(nullptr, ImageView::Surface::best);
    gl.set_picture(make_picture(image, Semantic::depth));
    gl.set_display(display);
    show(gl, {300, 200});
    gl.look_at({200, 150}, 0.5);
    const QImage shot = gl.grab().toImage(), snapshot = gl.snapshot(false, false);
    int worst = 0;
    for (int y = 0; y < snapshot.height(); ++y)
        for (int x = 0; x < snapshot.width(); ++x)
            worst = std::max(worst, std::abs(shot.pixelColor(x, y).red() - snapshot.pixelColor(x, y).red()));
    EXPECT_LE(worst, 3);
}

TEST(Surfaces, ShowTheSameMarksStripesAndTones) {
    if (!has_opengl()) GTEST_SKIP() << "Qt has no OpenGL here; start under a virtual X server";
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    Picture picture;
    Image image(16, 8, 3);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = float(i % 31) / 10 - 1;
    image.at(3, 3, 1) = nan;
    image.at(5, 3, 2) = inf;
    image.at(7, 3, 0) = -inf;
    Image valid(16, 8, 1, 1.0f);
    for (int x = 0; x < 8; ++x) valid.at(x, 6) = 0;
    picture.image = std::make_shared<const Image>(image);
    picture.valid = std::make_shared<const Image>(valid);
    picture.atlas.tiles = {{0, 0, 0, 0, 10, 8}, {1, 0, 12, 0, 4, 4}};
    const auto shared = std::make_shared<const Picture>(picture);
    for (auto mode :
         {Display::Mode::colour, Display::Mode::vector, Display::Mode::scalar, Display::Mode::ids})
        for (auto tones : {Display::ToneMap::none, Display::ToneMap::reinhard, Display::ToneMap::filmic})
            for (int flags = 0; flags < 4; ++flags) {
                Display display;
                display.mode = mode;
                display.tone_map = tones;
                display.exposure = 0.5;
                display.colour_map = "viridis";
                display.low = -0.35;
                display.high = 1.25;
                display.zebra = flags & 1;
                display.negative_is_bad = display.hide_invalid = flags & 2;
                if (mode != Display::Mode::colour && tones != Display::ToneMap::none) continue;
                expect_same_on_both(shared, display,
                                    std::to_string(int(mode)) + " " + std::to_string(int(tones)) + " " +
                                        std::to_string(flags));
            }
}

TEST(Shading, ToneMapsCompressLightAndKeepBlack) {
    using ToneMap = Display::ToneMap;
    const auto grey = [](ToneMap tones, float light) {
        Display display;
        display.tone_map = tones;
        return int(shade(display, std::vector<float>{light, light, light}.data(), 3)[0]);
    };
    const auto encoded = [&](double light) { return grey(ToneMap::none, float(light)); };
    for (ToneMap tones : {ToneMap::reinhard, ToneMap::filmic}) {
        EXPECT_EQ(grey(tones, 0), 0);
        int before = 0;
        for (float light : {0.05f, 0.2f, 1.0f, 3.0f}) {
            EXPECT_GT(grey(tones, light), before);
            before = grey(tones, light);
        }
        EXPECT_GE(grey(tones, 1e30f), 254);
    }
    EXPECT_NEAR(grey(ToneMap::reinhard, 1), encoded(0.5), 1);
    EXPECT_NEAR(grey(ToneMap::reinhard, 3), encoded(0.75), 1);
    EXPECT_NEAR(grey(ToneMap::filmic, 1), encoded(2.54 / 3.16), 1);
}

TEST(Shading, TheWorstChannelSpeaksForAPixel) {
    Display display;
    display.mode = Display::Mode::scalar;
    display.negative_is_bad = false;
    display.low = -1;
    const float pixel[] = {0.25f, -0.75f, 0.5f}, alone[] = {-0.75f};
    EXPECT_EQ(shade(display, pixel, 3), shade(display, alone, 1));
    display.channel = 2;
    EXPECT_NE(shade(display, pixel, 3), shade(display, alone, 1));
}

TEST(Shading, ZebraTellsBelowFromAbove) {
    Display display;
    display.negative_is_bad = false;
    const auto range = [&](float value) { return out_of_range(display, &value, 1); };
    EXPECT_EQ(range(-0.1f), OutOfRange::below);
    EXPECT_EQ(range(0.9f), OutOfRange::no);
    display.exposure = 1;
    EXPECT_EQ(range(0.9f), OutOfRange::above);  // what a screen cannot show, whatever the tone map
    display.mode = Display::Mode::scalar;
    display.low = 2;
    display.high = 3;
    EXPECT_EQ(range(0.9f), OutOfRange::below);
    EXPECT_EQ(range(3.1f), OutOfRange::above);
    EXPECT_EQ(range(std::numeric_limits<float>::quiet_NaN()), OutOfRange::no);
}

TEST(Shading, NumbersThatAreNamesHaveTheirOwnColours) {
    Display display;
    display.mode = Display::Mode::scalar;
    display.categories = {{-1, "below", tints::dark}, {1, "hit", tints::orange}};
    display.negative_is_bad = false;
    const auto of = [&](float number) { return shade(display, &number, 1); };
    EXPECT_EQ(of(-1), tints::dark);
    EXPECT_EQ(of(1), tints::orange);
    EXPECT_EQ(of(0), colour_without_name);
}

}  // namespace
}  // namespace ir::widgets
