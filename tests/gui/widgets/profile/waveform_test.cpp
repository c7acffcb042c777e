#include <QCheckBox>
#include <cmath>
#include <limits>

#include "tests/gui/widgets/metrics/pictures.h"
#include "widgets/profile/profile_panel.h"
#include "widgets/profile/waveform_view.h"

namespace ir::widgets {
namespace {

const std::atomic<bool> not_cancelled = false;

Waveform wave_of(const Image& image, const QRect& rectangle, const Axis& axis, int choice = all_channels,
                 Semantic semantic = Semantic::radiance) {
    const MeasuredImage measured{"A", &image, nullptr, nullptr, semantic};
    return waveform(measured, pixel_numbers(semantic, image.channels, choice), rectangle, axis,
                    not_cancelled);
}

TEST(WaveformTest, CountsTheValuesOfEachColumn) {
    Image image(4, 3, 3);  // column x has the red value x, one pixel of the last column has none
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 4; ++x) image.at(x, y, 0) = float(x);
    image.at(3, 1, 0) = std::numeric_limits<float>::quiet_NaN();
    const auto wave = wave_of(image, {0, 0, 4, 3}, {0, 4});
    ASSERT_EQ(wave.columns, 4);
    ASSERT_EQ(wave.channels.size(), 3u);
    for (int x = 0; x < 4; ++x) EXPECT_EQ(wave.count(0, x, x * Waveform::rows / 4), x == 3 ? 2u : 3u) << x;
    EXPECT_EQ(wave.count(1, 2, 0), 3u) << "green is 0 everywhere";
    EXPECT_EQ(wave.most, 3u);
    // Of a rectangle only, and nothing of what lies beyond the axis.
    const auto part = wave_of(image, {1, 1, 2, 1}, {0, 1.5});
    ASSERT_EQ(part.columns, 2);
    EXPECT_EQ(part.pixel_of(0), 1);
    EXPECT_EQ(part.count(0, 0, int(1 / 1.5 * Waveform::rows)), 1u);
    std::uint32_t red = 0;
    for (const auto count : part.channels[0].counts) red += count;
    EXPECT_EQ(red, 1u);
}

TEST(WaveformTest, WidePicturesShareColumnsAndLoseNoPixel) {
    const Image image(Waveform::max_columns * 2 + 7, 2, 1, 0.5f);
    const auto wave = wave_of(image, {0, 0, image.width, 2}, {0, 1}, one_number, Semantic::generic);
    EXPECT_EQ(wave.columns, Waveform::max_columns);
    EXPECT_EQ(wave.pixel_of(wave.columns), image.width);
    std::uint64_t all = 0;
    for (const auto count : wave.channels.at(0).counts) all += count;
    EXPECT_EQ(all, std::uint64_t(image.width) * 2);
    EXPECT_TRUE(wave.channels[0].name.empty());
}

TEST(WaveformTest, ThePanelShowsThemOnRequestWithTheirNumbers) {
    ProfilePanel panel;
    show(panel, {1300, 260});
    const auto a = radiance(ramp(), "A"), b = radiance(with_error(ramp()), "B");
    const auto wait = [&] { return QTest::qWaitFor([&] { return !panel.is_computing(); }, 60000); };
    panel.set_fields({.within = {{"A", a}, {"B", b}}});
    ASSERT_TRUE(wait());
    EXPECT_FALSE(panel.waveforms().isVisible());
    EXPECT_TRUE(panel.waveforms().waveforms().empty()) << "nothing is counted for nobody";
    auto* box = panel.findChild<QCheckBox*>("waveforms");
    QTest::mouseClick(box, Qt::LeftButton, {}, QPoint(8, box->height() / 2));
    ASSERT_TRUE(wait());
    ASSERT_TRUE(QTest::qWaitFor([&] { return panel.waveforms().waveforms().size() == 2; }, 60000));
    EXPECT_TRUE(panel.waveforms().isVisible());
    EXPECT_TRUE(panel.shows_waveforms());
    EXPECT_EQ(panel.waveforms().waveforms()[0].axis, panel.waveforms().waveforms()[1].axis);
    const auto text = panel.waveforms().text_at(panel.waveforms().place_of(1).center());
    EXPECT_TRUE(text.startsWith("B\nColumn")) << text.toStdString();
    EXPECT_TRUE(panel.waveforms().text_at({1, 1}).isEmpty());
    // A rectangle narrows them, nothing but NaN leaves an empty view.
    panel.set_fields({.within = {{"A", a}}, .rectangle = {2, 2, 4, 4}});
    ASSERT_TRUE(QTest::qWaitFor(
        [&] {
            const auto& waves = panel.waveforms().waveforms();
            return waves.size() == 1 && waves[0].columns == 4;
        },
        60000));
    Image nothing(4, 4, 3, std::numeric_limits<float>::quiet_NaN());
    panel.set_fields({.within = {{"N", radiance(nothing, "N")}}});
    ASSERT_TRUE(QTest::qWaitFor([&] { return panel.waveforms().waveforms().empty(); }, 60000));
    EXPECT_FALSE(panel.waveforms().grab().isNull());
}

}  // namespace
}  // namespace ir::widgets
