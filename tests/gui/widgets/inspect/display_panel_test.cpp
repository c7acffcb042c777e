#include <gtest/gtest.h>

#include <QCheckBox>
#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSignalSpy>
#include <QSlider>
#include <QTest>
#include <QToolButton>
#include <cmath>

#include "widgets/inspect/colour_map_box.h"
#include "widgets/inspect/display_panel.h"
#include "widgets/inspect/histogram_view.h"
#include "widgets/parameters/number_field.h"

namespace ir::widgets {
namespace {

std::shared_ptr<const Image> grey_ramp(int channels = 1) {
    Image image(100, 1, channels);
    for (int x = 0; x < 100; ++x)
        for (int c = 0; c < channels; ++c) image.at(x, 0, c) = float(x - 20) * float(c + 1);
    return std::make_shared<const Image>(std::move(image));
}

class DisplayPanelTest : public testing::Test {
  protected:
    void SetUp() override {
        panel.resize(330, 640);
        panel.show();
        ASSERT_TRUE(QTest::qWaitForWindowExposed(&panel));
        QObject::connect(&panel, &DisplayPanel::display_chosen, [this](const Display& display) {
            last = display;
            ++times;
        });
        panel.set_image("Depth", Semantic::depth, "m", grey_ramp());
        Display display;
        display.mode = Display::Mode::scalar;
        panel.set_display(display, true);
    }
    template <class T>
    T* find(const char* name) {
        auto* found = panel.findChild<T*>(QLatin1String(name));
        EXPECT_NE(found, nullptr) << name;
        return found;
    }
    void click(const char* name) { QTest::mouseClick(find<QAbstractButton>(name), Qt::LeftButton); }
    void tick(const char* name) { QTest::mouseClick(find<QCheckBox>(name), Qt::LeftButton, {}, {8, 8}); }
    void type(const char* name, const char* text) {
        auto* field = find<NumberField>(name);
        field->setFocus();
        field->selectAll();
        QTest::keyClicks(field, QLatin1String(text));
        QTest::keyClick(field, Qt::Key_Return);
    }
    DisplayPanel panel;
    Display last;
    int times = 0;
};

TEST_F(DisplayPanelTest, ShowingEmitsNothing) {
    Display display;
    display.exposure = 3.25;
    display.tone_map = Display::ToneMap::filmic;
    panel.set_display(display, false);
    panel.set_image("Radiance", Semantic::radiance, "", grey_ramp(3));
    panel.set_image("", Semantic::generic, "", nullptr);
    EXPECT_EQ(times, 0);
    EXPECT_EQ(find<NumberField>("exposure")->value(), 3.25);
}

TEST_F(DisplayPanelTest, ShowsTheControlsOfEachMode) {
    EXPECT_TRUE(find<QWidget>("low")->isVisible());
    EXPECT_TRUE(find<QWidget>("colour-map")->isVisible());
    EXPECT_FALSE(find<QWidget>("exposure")->isVisible());
    auto* mode = find<QComboBox>("mode");
    mode->setFocus();
    QTest::keyClick(mode, Qt::Key_Home);
    ASSERT_EQ(times, 1);
    EXPECT_EQ(last.mode, Display::Mode::colour);
    EXPECT_FALSE(find<QWidget>("low")->isVisible());
    EXPECT_TRUE(find<QWidget>("exposure")->isVisible());
    EXPECT_TRUE(find<QWidget>("tone-map")->isVisible());
    QTest::keyClick(mode, Qt::Key_Down);
    EXPECT_EQ(last.mode, Display::Mode::vector);
    EXPECT_TRUE(find<QWidget>("low")->isVisible());
    EXPECT_FALSE(find<QWidget>("colour-map")->isVisible());
}

TEST_F(DisplayPanelTest, TakesNumbersAndFitsTheRange) {
    type("low", "-3.5");
    EXPECT_EQ(last.low, -3.5);
    click("fit-all");
    EXPECT_EQ(last.low, -20);
    EXPECT_EQ(last.high, 79);
    click("fit-most");
    EXPECT_EQ(last.low, -19);
    EXPECT_EQ(last.high, 78);
    click("symmetric");
    EXPECT_EQ(last.low, -78);
    EXPECT_EQ(last.high, 78);
    EXPECT_EQ(times, 4);
}

TEST_F(DisplayPanelTest, DraggingTheHistogramChoosesTheRange) {
    auto& histogram = panel.histogram();
    Display display = panel.display();
    display.low = 0;
    display.high = 40;
    panel.set_display(display, true);
    const auto at = [&](double value) { return QPoint(int(std::lround(histogram.x_of(value))), 30); };
    QTest::mousePress(&histogram, Qt::LeftButton, {}, at(40));
    QTest::mouseMove(&histogram, at(60));
    QTest::mouseRelease(&histogram, Qt::LeftButton, {}, at(60));
    EXPECT_GE(times, 1);
    EXPECT_NEAR(last.high, 60, 1);
    EXPECT_EQ(last.low, 0);
    EXPECT_NEAR(find<NumberField>("high")->value(), last.high, 1e-9);
}

TEST_F(DisplayPanelTest, TheHistogramFollowsImageAndChannel) {
    panel.set_image("Vectors", Semantic::generic, "", grey_ramp(3));
    EXPECT_EQ(panel.histogram().current()->max, 79 * 3);
    auto* channel = find<QComboBox>("channel");
    EXPECT_EQ(channel->count(), 4);
    channel->setFocus();
    QTest::keyClick(channel, Qt::Key_Down);
    EXPECT_EQ(last.channel, 0);
    EXPECT_EQ(panel.histogram().current()->max, 79);
    panel.set_image("Depth", Semantic::depth, "m", grey_ramp());
    EXPECT_EQ(panel.histogram().current()->finite, 100u);
}

TEST_F(DisplayPanelTest, ExposureBySliderFieldAndFit) {
    Display display;
    panel.set_display(display, true);
    find<QSlider>("exposure-slider")->setFocus();
    QTest::keyClick(find<QSlider>("exposure-slider"), Qt::Key_Right);
    EXPECT_NEAR(last.exposure, 0.1, 1e-9);
    type("exposure", "-12.5");
    EXPECT_EQ(last.exposure, -12.5) << "beyond the slider";
    EXPECT_EQ(find<NumberField>("exposure")->value(), -12.5);
    click("fit-exposure");
    EXPECT_EQ(last.exposure, -6.3) << "-log2(78) is -6.285";
    EXPECT_EQ(find<NumberField>("exposure")->text(), "-6.3");
}

TEST_F(DisplayPanelTest, SwitchesMarksAndStripes) {
    tick("marks");
    EXPECT_FALSE(last.mark_bad);
    EXPECT_FALSE(find<QCheckBox>("negative")->isEnabled());
    tick("marks");
    tick("negative");
    EXPECT_FALSE(last.negative_is_bad);
    tick("zebra");
    EXPECT_TRUE(last.zebra);
    EXPECT_FALSE(find<QCheckBox>("hide-invalid")->isEnabled()) << "there is no mask";
}

TEST_F(DisplayPanelTest, InvalidPixelsDoNotCountNorDoGapsOfAnAtlas) {
    auto picture = std::make_shared<Picture>();
    picture->image = grey_ramp();
    Image valid(100, 1, 1);
    for (int x = 0; x < 30; ++x) valid.at(x, 0) = 1;
    picture->valid = std::make_shared<const Image>(valid);
    panel.set_picture(picture);
    EXPECT_EQ(panel.histogram().current()->finite, 30u) << "seen or not";
    EXPECT_TRUE(panel.histogram().summary().endsWith("valid pixels: 30 of 100"));
    EXPECT_FALSE(panel.histogram().summary().contains("values")) << "each has one";
    tick("hide-invalid");
    EXPECT_TRUE(last.hide_invalid);
    EXPECT_EQ(panel.histogram().current()->finite, 30u);
    EXPECT_EQ(panel.histogram().current()->max, 9);
    auto atlas = std::make_shared<Picture>(*picture);
    atlas->valid.reset();
    atlas->atlas = {100, 1, {{0, 0, 0, 0, 10, 1}, {1, 0, 90, 0, 10, 1}}};
    panel.set_picture(atlas);
    EXPECT_EQ(panel.histogram().current()->finite, 20u);
}

TEST_F(DisplayPanelTest, ResetIsOfferedOnceSomethingWasChosen) {
    auto* reset = find<QPushButton>("automatic");
    const QSignalSpy automatic(&panel, &DisplayPanel::automatic_chosen);
    EXPECT_FALSE(reset->isEnabled());
    EXPECT_FALSE(reset->toolTip().isEmpty());
    tick("zebra");
    EXPECT_TRUE(reset->isEnabled());
    QTest::mouseClick(reset, Qt::LeftButton);
    EXPECT_EQ(automatic.count(), 1);
}

TEST_F(DisplayPanelTest, WithoutFiniteValuesNothingCanBeFitted) {
    panel.set_image("Nothing", Semantic::depth, "", std::make_shared<const Image>(4, 4, 1, std::nanf("")));
    EXPECT_FALSE(find<QPushButton>("fit-all")->isEnabled());
    EXPECT_TRUE(find<QLabel>("counts")->text().contains("16 NaN"));
}

TEST(ColourMapBox, ListsUniformMapsFirst) {
    ColourMapBox box;
    QStringList names;
    for (int i = 0; i < box.count(); ++i) names << box.itemData(i).toString();
    EXPECT_LT(names.indexOf("viridis"), names.indexOf("turbo"));
    EXPECT_LT(names.indexOf("coolwarm"), names.indexOf("turbo"));
    EXPECT_FALSE(box.itemIcon(names.indexOf("magma")).isNull());
    const QSignalSpy chosen(&box, &ColourMapBox::chosen);
    box.show_name("magma");
    EXPECT_EQ(chosen.count(), 0);
    EXPECT_EQ(box.name(), "magma");
    box.setFocus();
    QTest::keyClick(&box, Qt::Key_Home);
    EXPECT_EQ(chosen.count(), 1);
}

}  // namespace
}  // namespace ir::widgets
