#include <gtest/gtest.h>

#include <QSignalSpy>
#include <QTest>
#include <cmath>
#include <limits>
#include <numeric>

#include "renderers/core/constants.h"
#include "widgets/image/display.h"
#include "widgets/inspect/histogram_view.h"

namespace ir::widgets {
namespace {

constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

std::uint64_t total(const Histogram& histogram) {
    std::uint64_t sum = 0;
    for (const auto& counts : histogram.counts) sum = std::accumulate(counts.begin(), counts.end(), sum);
    return sum;
}

Image ramp_of(int width, int height) {
    Image image(width, height, 1);
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        image.pixels[i] = float(i) / float(image.pixels.size() - 1);
    return image;
}

TEST(Histogram, CountsEachFiniteValueOnce) {
    const Histogram h = histogram(ramp_of(100, 100));
    EXPECT_EQ(h.finite, 10000u);
    EXPECT_EQ(total(h), 10000u);
    EXPECT_EQ(h.min, 0);
    EXPECT_EQ(h.max, 1);
    for (const auto count : h.counts[0]) EXPECT_NEAR(double(count), 10000.0 / 256, 2);
    EXPECT_NEAR(h.percentile_1, 0.01, 2e-4);
    EXPECT_NEAR(h.percentile_99, 0.99, 2e-4);
}

TEST(Histogram, KeepsChannelsApart) {
    Image image(4, 1, 3);
    for (int x = 0; x < 4; ++x) {
        image.at(x, 0, 0) = 0;
        image.at(x, 0, 1) = 1;
        image.at(x, 0, 2) = float(x) / 3;
    }
    const Histogram all = histogram(image);
    EXPECT_EQ(all.channels, (std::vector{0, 1, 2}));
    EXPECT_EQ(all.counts[0].front(), 4u);
    EXPECT_EQ(all.counts[1].back(), 4u);
    EXPECT_EQ(all.counts[2].front(), 1u);
    const Histogram one = histogram(image, 1);
    EXPECT_EQ(one.channels, (std::vector{1}));
    EXPECT_EQ(one.finite, 4u);
    EXPECT_EQ(one.min, 1);
}

TEST(Histogram, AndStatisticsAreOfValidPixels) {
    Image image(4, 2, 3, 1.0f), valid(4, 2, 1);
    for (int x = 0; x < 3; ++x) valid.at(x, 0) = 1;
    image.at(3, 1, 0) = 100;
    const auto counted = histogram(image, -1, {}, {.valid = &valid, .semantic = Semantic::position});
    const auto said = statistics(image, Semantic::position, {}, -1, &valid);
    EXPECT_EQ(counted.max, 1);
    EXPECT_EQ(said.max, 1);
    EXPECT_EQ(said.mean, 1);
    EXPECT_EQ(counted.finite, 9u);
    EXPECT_EQ(counted.valid, 3u);
    EXPECT_EQ(counted.pixels, 8u);
    EXPECT_EQ(said.valid, 3u);
    EXPECT_EQ(said.pixels, 8u);
}

/// The line under a picture says the same.
TEST(Histogram, AgreesWithTheStatisticsOfThePicture) {
    Image image(9, 4, 4);
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        image.pixels[i] = i % 4 == 3 ? 100 : 0.5f + float(i % 7);
    image.at(0, 0, 1) = not_a_number;
    image.at(1, 0, 3) = -infinity;
    Atlas atlas{9, 4, {{0, 0, 0, 0, 4, 4}, {1, 0, 6, 0, 3, 2}}};
    for (const auto& tiles : {Atlas{}, atlas})
        for (const auto semantic : {Semantic::radiance, Semantic::position, Semantic::generic}) {
            const auto counted = histogram(image, -1, {}, {nullptr, tiles, semantic});
            const auto said = statistics(image, semantic, tiles);
            EXPECT_EQ(counted.min, said.min);
            EXPECT_EQ(counted.max, said.max);
            EXPECT_EQ(counted.finite, said.finite);
            EXPECT_EQ(counted.nan, said.nan);
            EXPECT_EQ(counted.infinite, said.infinite);
            EXPECT_EQ(said.max, semantic == Semantic::generic ? 100 : 6.5);
        }
}

TEST(Histogram, OfConstantAndOfUselessImages) {
    const Histogram constant = histogram(Image(8, 8, 1, 3.0f));
    EXPECT_LT(constant.axis.low, 3);
    EXPECT_GT(constant.axis.high, 3);
    EXPECT_EQ(total(constant), 64u);
    EXPECT_EQ(constant.percentile_1, 3);
    EXPECT_EQ(total(histogram(Image(8, 8, 1, 0.0f))), 64u);
    const Histogram none = histogram(Image(8, 8, 1, not_a_number));
    EXPECT_EQ(none.finite, 0u);
    EXPECT_EQ(none.nan, 64u);
    EXPECT_EQ(histogram(Image()).finite, 0u);
    EXPECT_EQ(histogram(Image(2, 2, 1), 5).finite, 0u) << "a channel that is not there";
}

TEST(Histogram, CountsWhatIsNotANumberOrNegative) {
    Image image(5, 1, 1, 1.0f);
    image.pixels = {not_a_number, infinity, -infinity, -2, 1};
    const Histogram h = histogram(image);
    EXPECT_EQ(h.nan, 1u);
    EXPECT_EQ(h.infinite, 2u);
    EXPECT_EQ(h.negative, 1u);
    EXPECT_EQ(h.finite, 2u);
    EXPECT_EQ(h.min, -2);
}

TEST(Histogram, AFewOutliersDoNotSqueezeTheRest) {
    Image image = ramp_of(100, 100);
    image.pixels[5000] = 1e6f;
    const Histogram h = histogram(image);
    EXPECT_EQ(h.max, 1e6f);
    EXPECT_LT(h.axis.high, 2);
    EXPECT_EQ(h.above, 1u);
    EXPECT_EQ(total(h) + h.above + h.below, h.finite);
}

std::shared_ptr<const Image> shared(Image image) {
    return std::make_shared<const Image>(std::move(image));
}

class HistogramViewTest : public testing::Test {
  protected:
    void SetUp() override {
        view.resize(330, 140);
        view.show();
        ASSERT_TRUE(QTest::qWaitForWindowExposed(&view));
    }
    QPoint at(double value) const { return {int(std::lround(view.x_of(value))), 40}; }
    HistogramView view;
};

TEST_F(HistogramViewTest, IsNeverOfAnotherImageOrChannel) {
    Image two(64, 64, 2);
    for (std::size_t i = 0; i < two.pixels.size(); i += 2) two.pixels[i + 1] = 5;
    view.set_image(shared(two), Semantic::generic, 0);
    ASSERT_NE(view.current(), nullptr);
    EXPECT_EQ(view.current()->max, 0);
    view.set_image(shared(two), Semantic::generic, 1);
    EXPECT_EQ(view.current()->max, 5);
    view.set_image(shared(ramp_of(10, 10)), Semantic::generic, -1);
    EXPECT_EQ(view.current()->finite, 100u);
    view.set_image(nullptr, Semantic::generic, -1);
    EXPECT_EQ(view.current(), nullptr);
    EXPECT_EQ(view.summary(), "No image");
}

TEST_F(HistogramViewTest, BigImagesAreCountedElsewhereAndTheLastOneWins) {
    QSignalSpy counted(&view, &HistogramView::counted);
    for (int i = 1; i <= 5; ++i)
        view.set_image(shared(Image(1024, 1024, 1, float(i))), Semantic::generic, -1);
    EXPECT_EQ(view.current(), nullptr);
    EXPECT_EQ(view.summary(), "Counting …");
    ASSERT_TRUE(QTest::qWaitFor([&] { return view.current() != nullptr; }, 60000));
    EXPECT_EQ(view.current()->max, 5);
    EXPECT_EQ(counted.count(), 1) << "only the newest is told";
    // A small one right after a big one is not overwritten when the big one is done.
    std::vector<double> told;
    QObject::connect(&view, &HistogramView::counted, &view, [&] { told.push_back(view.current()->max); });
    view.set_image(shared(Image(1024, 1024, 1, 7.0f)), Semantic::generic, -1);
    view.set_image(shared(Image(4, 4, 1, 9.0f)), Semantic::generic, -1);
    EXPECT_EQ(view.current()->max, 9);
    view.set_image(shared(Image(1024, 1024, 1, 8.0f)), Semantic::generic, -1);  // counted after the first
    ASSERT_TRUE(QTest::qWaitFor([&] { return view.current() != nullptr; }, 60000));
    EXPECT_EQ(told, (std::vector<double>{9, 8}));
}

TEST_F(HistogramViewTest, HandlesAreDraggedAndMovedByKeys) {
    view.set_image(shared(ramp_of(64, 64)), Semantic::generic, -1);
    view.set_range(0.25, 0.75);
    QSignalSpy dragged(&view, &HistogramView::range_dragged);
    QTest::mousePress(&view, Qt::LeftButton, {}, at(0.25));
    QTest::mouseMove(&view, at(0.5));
    QTest::mouseRelease(&view, Qt::LeftButton, {}, at(0.5));
    ASSERT_GE(dragged.count(), 1);
    EXPECT_NEAR(dragged.back()[0].toDouble(), 0.5, 0.01);
    EXPECT_EQ(dragged.back()[1].toDouble(), 0.75);
    QTest::keyClick(&view, Qt::Key_Up);  // the other handle
    QTest::keyClick(&view, Qt::Key_Right);
    EXPECT_NEAR(dragged.back()[1].toDouble(), 0.76, 1e-6);
    const auto before = dragged.count();
    view.set_range_shown(false);
    QTest::mousePress(&view, Qt::LeftButton, {}, at(0.76));
    QTest::mouseMove(&view, at(0.9));
    QTest::mouseRelease(&view, Qt::LeftButton, {}, at(0.9));
    EXPECT_EQ(dragged.count(), before) << "no handles, no dragging";
}

TEST_F(HistogramViewTest, AHandleBeyondTheAxisCanBeFetched) {
    view.set_image(shared(ramp_of(64, 64)), Semantic::generic, -1);
    view.set_range(0, 50);
    QSignalSpy dragged(&view, &HistogramView::range_dragged);
    QTest::mousePress(&view, Qt::LeftButton, {}, at(1));
    QTest::mouseMove(&view, at(0.9));
    QTest::mouseRelease(&view, Qt::LeftButton, {}, at(0.9));
    ASSERT_GE(dragged.count(), 1);
    EXPECT_NEAR(dragged.back()[1].toDouble(), 0.9, 0.01);
}

TEST_F(HistogramViewTest, TheWheelZoomsAndADoubleClickShowsAll) {
    view.set_image(shared(ramp_of(64, 64)), Semantic::generic, -1);
    QWheelEvent wheel(QPointF(at(0.5)), view.mapToGlobal(QPointF(at(0.5))), {}, {0, 240}, Qt::NoButton,
                      Qt::NoModifier, Qt::NoScrollPhase, false);
    QApplication::sendEvent(&view, &wheel);
    ASSERT_NE(view.current(), nullptr);
    EXPECT_GT(view.current()->axis.low, 0.1);
    EXPECT_LT(view.current()->axis.high, 0.9);
    EXPECT_GT(view.current()->below + view.current()->above, 0u);
    EXPECT_NEAR(view.value_at(at(0.5).x()), 0.5, 0.01);
    QTest::mouseDClick(&view, Qt::LeftButton, {}, at(0.5));
    EXPECT_EQ(view.current()->axis, (Axis{0, 1}));
}

TEST_F(HistogramViewTest, DrawsEveryKindOfImage) {
    const auto picture = [&] {
        view.repaint();
        return view.grab().toImage();
    };
    view.set_image(shared(Image(8, 8, 1, not_a_number)), Semantic::generic, -1);
    const QImage none = picture();
    EXPECT_EQ(view.summary(), "64 values, 64 NaN");
    view.set_image(shared(Image(8, 8, 1, 2.0f)), Semantic::generic, -1);
    const QImage constant = picture();
    view.set_image(shared(Image(8, 8, 3, -1.0f)), Semantic::radiance, -1);
    EXPECT_EQ(view.summary(), "192 values, 192 negative");
    EXPECT_NE(none, constant);
    EXPECT_NE(picture(), constant);
    view.set_image(shared(ramp_of(64, 64)), Semantic::generic, -1);
    const QImage logarithmic = picture();
    Image uneven = ramp_of(64, 64);
    for (std::size_t i = 0; i < 2000; ++i) uneven.pixels[i] = 0;
    view.set_image(shared(uneven), Semantic::generic, -1);
    const QImage uneven_log = picture();
    view.set_logarithmic(false);
    EXPECT_NE(picture(), uneven_log);
    EXPECT_NE(uneven_log, logarithmic);
}

}  // namespace
}  // namespace ir::widgets
