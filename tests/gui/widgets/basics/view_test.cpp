#include <gtest/gtest.h>

#include <QMainWindow>
#include <QSignalSpy>
#include <QTest>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>
#include <limits>

#include "renderers/core/error.h"
#include "tests/gui/widgets/surfaces.h"
#include "widgets/image/image_view.h"
#include "widgets/image/legend.h"
#include "widgets/panels/value_strip.h"

namespace ir::widgets {
namespace {

/// Four colours in the corners: red top left, green top right, blue bottom left, white bottom right.
Image corners() {
    Image image(8, 8, 3);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x) {
            image.at(x, y, 0) = (y < 4) == (x < 4);
            image.at(x, y, 1) = x >= 4;
            image.at(x, y, 2) = y >= 4;
        }
    return image;
}

QColor colour_at(ImageView& view, double x, double y) {
    const QImage shot = view.grab().toImage();
    const QPointF at = view.transform().view_from_image({x, y});
    return shot.pixelColor(int(at.x()), int(at.y()));
}

void show(ImageView& view) {
    show(view, {320, 240});
}

class EachSurface : public SurfaceTest {};

INSTANTIATE_TEST_SUITE_P(Surfaces, EachSurface, testing::Values(true, false), surface_name);

TEST_P(EachSurface, RowZeroIsAtTheTop) {
    ImageView view(nullptr, surface());
    view.set_picture(make_picture(corners(), Semantic::radiance));
    show(view);
    EXPECT_STREQ(view.canvas().kind(), GetParam() ? "OpenGL" : "raster");
    EXPECT_EQ(colour_at(view, 1.5, 1.5).name(), "#ff0000");
    EXPECT_EQ(colour_at(view, 6.5, 1.5).name(), "#00ff00");
    EXPECT_EQ(colour_at(view, 1.5, 6.5).name(), "#0000ff");
    EXPECT_EQ(colour_at(view, 6.5, 6.5).name(), "#ffffff");
}

TEST_P(EachSurface, SurroundingsAreNeutralGrey) {
    ImageView view(nullptr, surface());
    view.set_picture(make_picture(corners(), Semantic::radiance));
    show(view, {400, 200});
    EXPECT_EQ(view.grab().toImage().pixelColor(5, 100), surround_colour);
}

TEST_P(EachSurface, MarksBadValues) {
    ImageView view(nullptr, surface());
    Image image(4, 1, 1, 0.5f);
    image.at(0, 0) = std::numeric_limits<float>::quiet_NaN();
    image.at(1, 0) = std::numeric_limits<float>::infinity();
    image.at(2, 0) = -1;
    view.set_picture(make_picture(image, Semantic::radiance));
    show(view);
    EXPECT_EQ(colour_at(view, 0.1, 0.9).name(), "#ff00ff");
    EXPECT_EQ(colour_at(view, 1.1, 0.9).name(), "#ffff00");
    EXPECT_EQ(colour_at(view, 2.1, 0.9).name(), "#2850ff");
    Display plain = view.display();
    plain.mark_bad = false;
    view.set_display(plain);
    EXPECT_EQ(colour_at(view, 2.1, 0.9).name(), "#000000");
}

TEST_P(EachSurface, ExposureDoublesLightPerStop) {
    ImageView view(nullptr, surface());
    view.set_picture(make_picture(Image(4, 4, 3, 0.25f), Semantic::radiance));
    Display display;
    display.exposure = 1;
    view.set_display(display);
    show(view);
    const auto expected = shade({}, std::vector<float>{0.5f, 0.5f, 0.5f}.data(), 3);
    EXPECT_NEAR(colour_at(view, 1.1, 1.1).red(), expected[0], 1);
}

/// How many pixels of the middle of a zoomed pixel are not of its flat colour.
int written_pixels(ImageView& view, QPoint pixel, const QColor& flat) {
    const QImage shot = view.grab().toImage();
    int count = 0;
    for (double v = 0.1; v < 0.9; v += 0.02)
        for (double u = 0.1; u < 0.9; u += 0.02) {
            const QPointF at = view.transform().view_from_image({pixel.x() + u, pixel.y() + v});
            count += shot.pixelColor(at.toPoint()) != flat;
        }
    return count;
}

TEST_P(EachSurface, WritesNumbersIntoLargePixels) {
    ImageView view(nullptr, surface());
    view.set_picture(make_picture(corners(), Semantic::radiance));
    show(view);
    view.look_at({4, 4}, 64 * view.devicePixelRatio());
    EXPECT_GT(written_pixels(view, {3, 3}, QColor(255, 0, 0)), 20);
    view.set_pixel_grid(false);
    EXPECT_EQ(written_pixels(view, {3, 3}, QColor(255, 0, 0)), 0);
}

TEST_P(EachSurface, SaysHowAToolIsUsedAndThatAPictureIsOld) {
    ImageView view(nullptr, surface());
    view.set_picture(make_picture(corners(), Semantic::radiance));
    show(view, {640, 300});
    const QImage plain = view.grab().toImage();
    view.set_stale(true);
    const QImage stale = view.grab().toImage();
    EXPECT_NE(plain, stale);
    view.set_tool(ImageView::Tool::orbit);
    EXPECT_NE(view.grab().toImage(), stale);
}

TEST_P(EachSurface, SurvivesAMoveToAnotherWindow) {
    QMainWindow first, second;
    auto* view = new ImageView(nullptr, surface());
    view->set_picture(make_picture(corners(), Semantic::radiance));
    for (QMainWindow* window : {&first, &second, &first}) {
        window->setCentralWidget(view);
        window->resize(300, 300);
        window->show();
        ASSERT_TRUE(QTest::qWaitForWindowExposed(window));
        EXPECT_EQ(colour_at(*view, 1.5, 1.5).name(), "#ff0000");
        window->takeCentralWidget();
    }
    delete view;
}

TEST(Surfaces, ShowTheSameColours) {
    if (!has_opengl()) GTEST_SKIP() << "Qt has no OpenGL here; start under a virtual X server";
    Image ramp(64, 1, 1);
    for (int x = 0; x < 64; ++x) ramp.at(x, 0) = float(x) / 63;
    for (auto semantic :
         {Semantic::radiance, Semantic::depth, Semantic::accessibility, Semantic::id, Semantic::normal}) {
        Image image = ramp;
        if (semantic == Semantic::id)
            for (auto& value : image.pixels) value = std::round(value * 63);
        const Display display = display_for(semantic, "", image);
        ImageView gl(nullptr, ImageView::Surface::best), raster(nullptr, ImageView::Surface::raster);
        for (auto* view : {&gl, &raster}) {
            view->set_picture(make_picture(image, semantic));
            view->set_display(display);
            show(*view, {640, 40});
        }
        for (int x = 0; x < 64; ++x) {
            const QColor a = colour_at(gl, x + 0.4, 0.5), b = colour_at(raster, x + 0.4, 0.5);
            EXPECT_NEAR(a.red(), b.red(), 3) << to_string(semantic) << " " << x;
            EXPECT_NEAR(a.green(), b.green(), 3) << to_string(semantic) << " " << x;
            EXPECT_NEAR(a.blue(), b.blue(), 3) << to_string(semantic) << " " << x;
        }
    }
}

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

TEST_P(EachSurface, LegendAndLabelsLieOverThePicture) {
    ImageView view(nullptr, surface());
    view.set_picture(make_picture(Image(8, 8, 1, 0.5f), Semantic::depth, "depth", "m"));
    show(view, {400, 300});
    const auto corner = [&] {  // bottom right
        const QImage shot = view.grab().toImage();
        return shot.copy(shot.width() * 3 / 4, shot.height() / 3, shot.width() / 4, shot.height() * 2 / 3);
    };
    const QImage plain = view.grab().toImage(), plain_corner = corner();
    view.set_labels("A   ours");
    EXPECT_NE(view.grab().toImage(), plain);
    EXPECT_EQ(corner(), plain_corner);
    view.set_legend(true);
    EXPECT_NE(corner(), plain_corner);
    const auto whole = ImageView::SnapshotScale::picture_pixels;
    EXPECT_EQ(view.snapshot(false, false, whole).size(), QSize(8, 8));
    EXPECT_GT(view.snapshot(false, true, whole).width(), 8);  // beside the picture, not over it
    EXPECT_EQ(view.snapshot(false, true, whole).copy(0, 0, 8, 8), view.snapshot(false, false, whole));
}

TEST_P(EachSurface, ASharedPictureIsNotCopied) {
    ImageView view(nullptr, surface());
    const auto picture = make_picture(corners(), Semantic::radiance);
    view.set_picture(picture);
    show(view);
    view.grab();
    EXPECT_EQ(&view.image(), picture->image.get());
    const int uploads = view.canvas().upload_count();
    Picture stale = *picture;
    stale.stale = true;
    view.set_picture(std::make_shared<const Picture>(stale));  // the same pixels
    view.look_at({3, 3}, 20);
    view.grab();
    EXPECT_EQ(view.canvas().upload_count(), uploads);
}

TEST(Pictures, PlacesAreToldWithinTheirTile) {
    Picture picture = *make_picture(Image(10, 4, 1), Semantic::depth);
    EXPECT_EQ(locate(picture, {7, 2}), (PicturePixel{0, 0, {7, 2}}));
    EXPECT_TRUE(place_text(picture, {10, 0}).isEmpty());
    picture.atlas.width = 10;
    picture.atlas.height = 4;
    picture.atlas.tiles = {{0, 3, 0, 0, 4, 4}, {1, 3, 6, 0, 2, 2}, {0, 4, 8, 0, 2, 4}};
    EXPECT_EQ(locate(picture, {7, 1}), (PicturePixel{1, 3, {1, 1}}));
    EXPECT_EQ(locate(picture, {5, 1}).pixel, QPoint(-1, -1));  // a gap
    EXPECT_TRUE(place_text(picture, {5, 1}).isEmpty());
    EXPECT_EQ(place_text(picture, {7, 1}).simplified(), "slice 3 · level 1 x 1 y 1");
    EXPECT_EQ(tile_name(picture.atlas, picture.atlas.tiles[2]), "slice 4 · level 0");
}

/// A picture of 16:9 in a view of 16:9: whatever stands beside it takes room from it.
TEST_P(EachSurface, TheLegendStandsBesideThePictureOrInALineBelow) {
    Image wide(160, 90, 1);
    for (std::size_t i = 0; i < wide.pixels.size(); ++i) wide.pixels[i] = float(i);
    for (const QSize size : {QSize(640, 360), QSize(320, 180), QSize(900, 360)}) {
        ImageView view(nullptr, surface());
        view.set_picture(make_picture(wide, Semantic::depth, {}, "m"));
        view.set_legend(true);
        show(view);
        view.resize(size);
        QApplication::processEvents();
        const auto place = legend_place(view.state(), view.devicePixelRatioF());
        EXPECT_EQ(place.is_line, size.width() < 900);
        const auto& t = view.transform();
        const QRectF picture(t.offset(), t.image_size() * t.zoom());
        EXPECT_LE(picture.right(), t.view_size().width() - place.margins.width() + 1);
        EXPECT_LE(picture.bottom(), t.view_size().height() - place.margins.height() + 1);
        EXPECT_GT(picture.width() * picture.height(),
                  0.8 * std::min(t.view_size().width() * t.view_size().width() * 9 / 16,
                                 t.view_size().height() * t.view_size().height() * 16 / 9));
        view.set_legend(false);
        EXPECT_TRUE(legend_place(view.state(), 1).margins.isNull());
    }
}

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

TEST(Legend, TicksAreRoundNumbersBetweenTheEnds) {
    EXPECT_EQ(legend_ticks(0, 1, 6), (std::vector<double>{0, 0.2, 0.4, 0.6000000000000001, 0.8, 1}));
    const auto ticks = legend_ticks(-3.3, 8.9, 6);
    EXPECT_EQ(ticks.front(), -3.3);
    EXPECT_EQ(ticks.back(), 8.9);
    EXPECT_TRUE(std::is_sorted(ticks.begin(), ticks.end()));
    EXPECT_GE(ticks.size(), 4u);
    EXPECT_EQ(legend_ticks(2, 2, 6), std::vector<double>{2});
}

TEST(ImageView, TheSecondPictureHasTheSizeOfTheFirst) {
    ImageView view;
    view.set_picture(make_picture(Image(4, 4, 1), Semantic::depth));
    EXPECT_THROW(view.set_second(make_picture(Image(5, 4, 1), Semantic::depth)), UsageError);
    view.set_second(make_picture(Image(4, 4, 1), Semantic::depth));
    view.set_picture(make_picture(Image(8, 8, 1), Semantic::depth));  // another resolution drops it
    EXPECT_FALSE(view.state().pictures[1].picture);
}

TEST(ImageView, TellsThePixelUnderTheCursor) {
    ImageView view;
    view.set_picture(make_picture(corners(), Semantic::radiance));
    show(view);
    QSignalSpy moves(&view, &ImageView::cursor_moved);
    const QPointF at = view.transform().view_from_image({5.5, 2.5});
    QTest::mouseMove(&view, at.toPoint() / view.devicePixelRatio());
    ASSERT_TRUE(QTest::qWaitFor([&] { return moves.count() > 0; }));
    // The pointer of a shared screen may first report where it was.
    ASSERT_TRUE(QTest::qWaitFor([&] { return moves.last().first().toPoint() == QPoint(5, 2); }));
    const QPoint pixel = moves.last().first().toPoint();
    ValueStrip strip;
    strip.show_pixel(*make_picture(view.image(), Semantic::radiance, {}, "W"), pixel);
    EXPECT_EQ(strip.text().toStdString(), "x    5  y    2   R 0  G 1  B 0 W");
}

/// Alpha is 1 in a black picture; four numbers of another meaning are four.
TEST(ValueStrip, StatisticsLeaveAlphaOut) {
    Image black(4, 4, 4);
    for (std::size_t i = 3; i < black.pixels.size(); i += 4) black.pixels[i] = 1;
    ValueStrip strip;
    strip.set_picture(black, Semantic::radiance, "black", {});
    EXPECT_TRUE(strip.text().contains("max 0  mean 0")) << strip.text().toStdString();
    strip.set_picture(black, Semantic::count, "counts", {});
    EXPECT_TRUE(strip.text().contains("max 1  mean 0.25")) << strip.text().toStdString();
    EXPECT_EQ(display_for(Semantic::normal, "", black).high, 1);
    EXPECT_EQ(display_for(Semantic::position, "", black).high, 0) << "the range is that of the values";
}

TEST(ValueStrip, SaysNothingOfPixelsThatASmallerPictureLacks) {
    const auto shown = make_picture(corners(), Semantic::radiance);
    const auto& picture = *shown;
    const int width = picture.image->width, height = picture.image->height;
    ValueStrip strip;
    strip.set_picture(*picture.image, Semantic::radiance, "corners", {});
    const auto summary = strip.text();
    strip.show_pixel(picture, {width - 1, height - 1});
    EXPECT_TRUE(strip.text().startsWith("x")) << strip.text().toStdString();
    for (const QPoint outside : {QPoint(-1, -1), QPoint(width, 0)}) {
        strip.show_pixel(picture, outside);
        EXPECT_EQ(strip.text(), summary);
    }
}

TEST(ImageView, WheelZoomsAboutTheCursor) {
    ImageView view;
    view.set_picture(make_picture(Image(100, 100, 1), Semantic::generic));
    show(view);
    const QPointF cursor(200, 90);
    const QPointF before = view.transform().image_from_view(cursor * view.devicePixelRatio());
    const double zoom = view.transform().zoom();
    QWheelEvent wheel(cursor, view.mapToGlobal(cursor), {}, {0, 240}, Qt::NoButton, Qt::NoModifier,
                      Qt::NoScrollPhase, false);
    QApplication::sendEvent(&view, &wheel);
    EXPECT_NEAR(view.transform().zoom(), zoom * 1.25 * 1.25, 1e-9);
    const QPointF after = view.transform().image_from_view(cursor * view.devicePixelRatio());
    EXPECT_NEAR(after.x(), before.x(), 0.5 / view.transform().zoom() + 1e-9);
    EXPECT_NEAR(after.y(), before.y(), 0.5 / view.transform().zoom() + 1e-9);
}

TEST(ImageView, AnOrbitIsOneGestureAndKeepsTheTarget) {
    ImageView view;
    view.set_picture(make_picture(corners(), Semantic::radiance));
    show(view);
    CameraPose start;
    view.camera().set_pose(start);
    view.set_tool(ImageView::Tool::orbit);
    QSignalSpy moves(&view, &ImageView::camera_moved), ends(&view, &ImageView::camera_gesture_finished);
    QTest::mousePress(&view, Qt::LeftButton, {}, {100, 100});
    QTest::mouseMove(&view, {120, 100});
    QTest::mouseMove(&view, {140, 110});
    QTest::mouseRelease(&view, Qt::LeftButton, {}, {140, 110});
    EXPECT_GE(moves.count(), 1);
    EXPECT_EQ(ends.count(), 1);
    EXPECT_EQ(view.camera().pose().target, start.target);
    EXPECT_NE(view.camera().pose().eye, start.eye);
    EXPECT_NEAR(glm::length(view.camera().pose().eye - view.camera().pose().target), 5, 1e-9);
}

TEST(ImageView, InspectingNeverMovesTheCamera) {
    ImageView view;
    view.set_picture(make_picture(corners(), Semantic::radiance));
    show(view);
    QSignalSpy moves(&view, &ImageView::camera_moved), picks(&view, &ImageView::picked_changed);
    QTest::mousePress(&view, Qt::LeftButton, {}, {100, 100});
    QTest::mouseMove(&view, {180, 150});
    QTest::mouseRelease(&view, Qt::LeftButton, {}, {180, 150});
    EXPECT_EQ(moves.count(), 0);
    EXPECT_EQ(picks.count(), 0);
    const QPointF at = view.transform().view_from_image({2.5, 3.5});
    QTest::mouseClick(&view, Qt::LeftButton, {}, at.toPoint() / view.devicePixelRatio());
    EXPECT_EQ(view.state().marks.picked, QPoint(2, 3));
}

TEST(ImageView, KeysFlyTheCamera) {
    ImageView view;
    view.set_picture(make_picture(corners(), Semantic::radiance));
    show(view);
    view.camera().set_pose({});
    view.set_tool(ImageView::Tool::fly);
    QSignalSpy ends(&view, &ImageView::camera_gesture_finished);
    QTest::keyPress(&view, Qt::Key_W);
    QTest::qWait(60);
    QTest::keyRelease(&view, Qt::Key_W);
    EXPECT_LT(view.camera().pose().eye.z, 5);
    EXPECT_DOUBLE_EQ(view.camera().pose().eye.x, 0);
    EXPECT_TRUE(ends.wait(2000));
}

TEST(ViewTransform, AnotherResolutionKeepsTheRegion) {
    ViewTransform t;
    t.set_view_size({400, 400});
    t.set_image_size({100, 100});
    t.look_at({25, 75}, 16);
    t.set_image_size({50, 50});
    EXPECT_DOUBLE_EQ(t.zoom(), 32);
    EXPECT_NEAR(t.centre().x(), 12.5, 1 / t.zoom());
    EXPECT_NEAR(t.centre().y(), 37.5, 1 / t.zoom());
}

TEST(CameraMotion, OrbitStopsBeforeThePole) {
    CameraPose pose;
    pose = orbited(pose, 0, 10);
    EXPECT_NEAR(glm::length(pose.eye), 5, 1e-9);
    EXPECT_GT(pose.eye.y, 4.99);
    EXPECT_GT(glm::length(glm::cross(glm::normalize(pose.target - pose.eye), pose.up)), 0.005);
}

TEST(CameraMotion, LookingTurnsTheTargetAboutTheEye) {
    const CameraPose pose = looked({}, glm::radians(90.0), 0);
    EXPECT_EQ(pose.eye, glm::dvec3(0, 0, 5));
    EXPECT_NEAR(pose.target.x, -5, 1e-9);
    EXPECT_NEAR(pose.target.z, 5, 1e-9);
}

TEST(CameraMotion, SlidingByOneMovesByThePictureHeight) {
    CameraPose pose;
    pose.fov_y_degrees = 90;
    EXPECT_NEAR(slid(pose, 1, 0).eye.x, 10, 1e-9);
    EXPECT_NEAR(slid(pose, 0, 1).target.y, 10, 1e-9);
}

}  // namespace
}  // namespace ir::widgets
