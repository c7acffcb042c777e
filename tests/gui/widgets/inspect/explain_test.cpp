#include <gtest/gtest.h>

#include <QCheckBox>
#include <QLabel>
#include <QPushButton>
#include <QSignalSpy>
#include <QTest>

#include "renderers/core/inspection.h"
#include "widgets/inspect/explain_panel.h"
#include "widgets/parameters/number_field.h"

namespace ir::widgets {
namespace {

const std::vector<ExplainOutput> outputs = {
    {"explain_list", "List walked through", "point_set", "The nodes of the pixel's list", 12, true},
    {"explain_rays", "Rays", "line_set", "", 0, true},
    {"explain_map", "Footprint", "image", "", -1, false},
};

class ExplainPanelTest : public testing::Test {
  protected:
    void SetUp() override {
        panel.resize(330, 420);
        panel.show();
        ASSERT_TRUE(QTest::qWaitForWindowExposed(&panel));
    }
    QPushButton* show_button(const char* key) {
        return panel.findChild<QWidget*>(QStringLiteral("output:") + QLatin1String(key))
            ->findChild<QPushButton*>();
    }
    QString title() { return panel.findChild<QLabel*>("title")->text(); }
    QLabel* help() { return panel.findChild<QLabel*>("help"); }
    NumberField* item() { return panel.findChild<NumberField*>("item:map"); }
    QCheckBox* all() { return panel.findChild<QCheckBox*>("all:map"); }
    void tick_all() { QTest::mouseClick(all(), Qt::LeftButton, {}, {8, all()->height() / 2}); }
    ExplainPanel panel;
};

TEST_F(ExplainPanelTest, TellsHowToExplainAPixel) {
    EXPECT_TRUE(title().contains("explains no pixels"));
    panel.set_content({}, outputs, {});
    EXPECT_TRUE(help()->isVisible());
    EXPECT_TRUE(help()->text().contains("Shift"));
    EXPECT_FALSE(show_button("explain_list")->isEnabled());
    EXPECT_FALSE(show_button("explain_list")->toolTip().isEmpty());
    panel.set_content(QPoint(4, 5), outputs, {});
    EXPECT_FALSE(help()->isVisible());
    EXPECT_TRUE(title().contains("4, 5"));
}

TEST_F(ExplainPanelTest, ShowsBuffersAndStops) {
    panel.set_content(QPoint(4, 5), outputs, {});
    const QSignalSpy shown(&panel, &ExplainPanel::show_wanted);
    const QSignalSpy cleared(&panel, &ExplainPanel::pixel_cleared);
    QTest::mouseClick(show_button("explain_list"), Qt::LeftButton);
    QTest::mouseClick(show_button("explain_rays"), Qt::LeftButton);
    QTest::mouseClick(show_button("explain_map"), Qt::LeftButton);
    ASSERT_EQ(shown.count(), 2) << "there are no rays, but the map can still be computed";
    EXPECT_EQ(shown[0][0].toString(), "explain_list");
    EXPECT_EQ(shown[1][0].toString(), "explain_map");
    QTest::mouseClick(panel.findChild<QPushButton*>("clear"), Qt::LeftButton);
    EXPECT_EQ(cleared.count(), 1);
}

TEST_F(ExplainPanelTest, SaysWhyThereAreNone) {
    auto reasoned = outputs;
    reasoned[1].why_none = "None for pixel 4, 5: no ray leaves it.";
    panel.set_content(QPoint(4, 5), reasoned, {});
    const auto rows = panel.findChild<QWidget*>("output:explain_rays")->findChildren<QLabel*>();
    EXPECT_TRUE(rows.at(1)->text().contains("no ray leaves it")) << rows.at(1)->text().toStdString();
    EXPECT_EQ(show_button("explain_rays")->toolTip(), reasoned[1].why_none);
}

TEST_F(ExplainPanelTest, ChoosesItemsOneByOneOrAll) {
    const auto show = [&](int count, int chosen) {
        panel.set_content({}, outputs, {{"map", "Layered depth map", "Direction", count, chosen}});
    };
    const QSignalSpy chosen(&panel, &ExplainPanel::item_chosen);
    show(64, 3);
    EXPECT_EQ(item()->value(), 3);
    item()->setFocus();
    item()->selectAll();
    QTest::keyClicks(item(), "17");
    QTest::keyClick(item(), Qt::Key_Return);
    ASSERT_EQ(chosen.count(), 1);
    EXPECT_EQ(chosen[0][0].toString(), "map");
    EXPECT_EQ(chosen[0][1].toInt(), 17);
    tick_all();
    ASSERT_EQ(chosen.count(), 2);
    EXPECT_EQ(chosen[1][1].toInt(), Inspection::all);
    show(64, Inspection::all);
    EXPECT_FALSE(item()->isEnabled());
    tick_all();
    EXPECT_EQ(chosen[2][1].toInt(), 17) << "back to the one before";
    show(8, 2);
    EXPECT_EQ(item()->maximum(), 7);
    EXPECT_EQ(chosen.count(), 3) << "a shorter list chooses nothing by itself";
    show(0, 0);
    EXPECT_FALSE(item()->isEnabled());
}

TEST_F(ExplainPanelTest, KeepsItsWidgetsFromFrameToFrame) {
    const std::vector<ExplainSelector> selectors = {{"map", "Layered depth map", "", 64, 0}};
    panel.set_content(QPoint(1, 1), outputs, selectors);
    auto* field = item();
    auto* button = show_button("explain_list");
    auto more = outputs;
    more[0].elements = 99;
    panel.set_content(QPoint(2, 2), more, selectors);
    EXPECT_EQ(item(), field);
    EXPECT_EQ(show_button("explain_list"), button);
    bool told = false;
    for (const auto* label : panel.findChildren<QLabel*>()) told |= label->text().contains("99 elements");
    EXPECT_TRUE(told);
}

}  // namespace
}  // namespace ir::widgets
