#include <gtest/gtest.h>

#include <QLabel>
#include <QSignalSpy>
#include <QTest>
#include <QToolButton>

#include "widgets/parameters/number_field.h"
#include "widgets/timeline/time_bar.h"
#include "widgets/timeline/timeline_panel.h"

namespace ir::widgets {
namespace {

class TimelineTest : public testing::Test {
  protected:
    void SetUp() override {
        state.end = 4;
        state.time = 1;
        state.own_time = 0.5;
        state.tracks = {{"Walk", "the camera Nave", {0, 2, 4}, 0, false}};
        panel.resize(700, 120);
        panel.show_state(state);
        panel.show();
        ASSERT_TRUE(QTest::qWaitForWindowExposed(&panel));
    }
    QToolButton* button(const char* name) { return panel.findChild<QToolButton*>(name); }
    NumberField* field(const char* name) { return panel.findChild<NumberField*>(name); }

    TimelineState state;
    TimelinePanel panel;
};

TEST_F(TimelineTest, ShowsTimeFrameAndEnd) {
    EXPECT_EQ(field("time")->value(), 1);
    EXPECT_EQ(field("frame")->value(), 30);
    EXPECT_EQ(field("end")->value(), 4);
    EXPECT_FALSE(button("set-time")->isEnabled());  // it shows the experiment's own time
    state.is_elsewhere = true;
    panel.show_state(state);
    EXPECT_TRUE(button("set-time")->isEnabled());
    state.read_only = "read-only";
    panel.show_state(state);
    EXPECT_FALSE(button("set-time")->isEnabled());
    EXPECT_EQ(button("set-time")->toolTip(), "read-only");
}

TEST_F(TimelineTest, TheBarSnapsToFramesWithinTheRange) {
    auto& bar = panel.bar();
    for (const double time : {0.0, 1.0 / 30, 2.0, 4.0})
        EXPECT_NEAR(bar.time_at(bar.position_of(time)), time, 1e-9);
    EXPECT_EQ(bar.time_at(-50), 0);
    EXPECT_EQ(bar.time_at(5000), 4);
    QSignalSpy chosen(&bar, &TimeBar::time_chosen);
    QTest::mouseClick(&bar, Qt::LeftButton, {}, QPoint(int(bar.position_of(3)), 10));
    ASSERT_EQ(chosen.count(), 1);
    EXPECT_NEAR(chosen.at(0).at(0).toDouble(), 3, 0.02);
}

TEST_F(TimelineTest, NamesStandOnTheirLinesWhereKeysLeaveRoom) {
    auto& bar = panel.bar();
    const auto shot = [&](const QString& name, std::vector<double> keys) {
        state.tracks[0].name = name;
        state.tracks[0].keys = std::move(keys);
        panel.show_state(state);
        return bar.grab().toImage();
    };
    EXPECT_NE(shot("Walk", {0, 2, 4}), shot({}, {0, 2, 4}));
    EXPECT_NE(shot("Walk", {}), shot({}, {}));
    std::vector<double> dense;
    for (int i = 0; i <= 120; ++i) dense.push_back(i / 30.0);
    EXPECT_EQ(shot("Walk", dense), shot({}, dense));
}

TEST_F(TimelineTest, KeysDoWhatTheMouseDoes) {
    QSignalSpy steps(&panel, &TimelinePanel::step_wanted), plays(&panel, &TimelinePanel::play_wanted),
        times(&panel, &TimelinePanel::time_chosen);
    auto* bar = &panel.bar();
    bar->setFocus();
    QTest::keyClick(bar, Qt::Key_Right);
    QTest::keyClick(bar, Qt::Key_Left, Qt::ShiftModifier);
    QTest::keyClick(bar, Qt::Key_Space);
    QTest::keyClick(bar, Qt::Key_End);
    ASSERT_EQ(steps.count(), 2);
    EXPECT_EQ(steps.at(0).at(0).toInt(), 1);
    EXPECT_EQ(steps.at(1).at(0).toInt(), -10);
    ASSERT_EQ(plays.count(), 1);
    EXPECT_TRUE(plays.at(0).at(0).toBool());
    ASSERT_EQ(times.count(), 1);
    EXPECT_EQ(times.at(0).at(0).toDouble(), 4);
    state.playing = true;
    panel.show_state(state);
    QTest::mouseClick(button("play"), Qt::LeftButton);
    EXPECT_FALSE(plays.at(1).at(0).toBool());
}

TEST_F(TimelineTest, NumbersAreTyped) {
    QSignalSpy times(&panel, &TimelinePanel::time_chosen), ends(&panel, &TimelinePanel::end_chosen);
    const auto type = [](NumberField* field, const char* text) {
        field->setFocus();
        field->selectAll();
        QTest::keyClicks(field, text);
        QTest::keyClick(field, Qt::Key_Return);
    };
    type(field("frame"), "45");
    type(field("end"), "8");
    ASSERT_GE(times.count(), 1);
    EXPECT_DOUBLE_EQ(times.at(0).at(0).toDouble(), 1.5);
    ASSERT_GE(ends.count(), 1);
    EXPECT_EQ(ends.at(0).at(0).toDouble(), 8);
}

TEST_F(TimelineTest, AnEmptyOneSaysWhy) {
    state.empty = "Nothing moves";
    panel.show_state(state);
    EXPECT_TRUE(panel.findChild<QLabel*>("empty")->isVisible());
    EXPECT_FALSE(panel.bar().isVisible());
}

}  // namespace
}  // namespace ir::widgets
