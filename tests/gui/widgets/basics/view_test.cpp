#include <gtest/gtest.h>

#include <QMainWindow>
#include <QSignalSpy>
#include <QTest>
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

TEST(ImageView, AHintStandsBesideTheLegend) {
    ImageView view(nullptr, ImageView::Surface::raster);
    view.set_picture(make_picture(Image(48, 48, 1), Semantic::depth, {}, "m"));
    view.set_legend(true);
    show(view);
    view.resize(320, 170);
    QApplication::processEvents();
    ASSERT_FALSE(legend_place(view.state(), view.devicePixelRatioF()).is_line);
    const auto& t = view.transform();
    const int legend =
        int(std::ceil(t.offset().x() + t.image_size().width() * t.zoom() + 8 * view.devicePixelRatioF()));
    const auto bare = view.grab().toImage();
    view.set_tool(ImageView::Tool::line);
    const auto hinted = view.grab().toImage();
    EXPECT_NE(hinted, bare) << "there is a hint";
    const QRect right(legend, 0, bare.width() - legend, bare.height());
    EXPECT_EQ(hinted.copy(right), bare.copy(right)) << "it is not under the legend";
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

}  // namespace
}  // namespace ir::widgets
