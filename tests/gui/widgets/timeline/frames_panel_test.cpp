#include "widgets/timeline/frames_panel.h"

#include <gtest/gtest.h>

#include <QAction>
#include <QLabel>
#include <QSignalSpy>
#include <QSlider>
#include <QTest>
#include <QToolButton>

#include "widgets/parameters/number_field.h"

namespace ir::widgets {
namespace {

class FramesPanelTest : public testing::Test {
  protected:
    void SetUp() override {
        panel.resize(700, 80);
        panel.show();
        ASSERT_TRUE(QTest::qWaitForWindowExposed(&panel));
        panel.show_state({.edited = {false, true, false, false},
                          .shown = 2,
                          .is_past = true,
                          .caption = "3 of 4",
                          .used_mib = 1.2,
                          .limit_mib = 512});
    }
    template <class T>
    T* find(const char* name) {
        return panel.findChild<T*>(name);
    }
    FramesPanel panel;
};

TEST_F(FramesPanelTest, ClicksAndKeysChooseFrames) {
    QSignalSpy chosen(&panel, &FramesPanel::frame_chosen), now(&panel, &FramesPanel::now_wanted);
    EXPECT_EQ(find<QSlider>("frames")->value(), 2);
    EXPECT_EQ(chosen.count(), 0) << "what is shown is nobody's choice";
    QTest::mouseClick(find<QToolButton>("older"), Qt::LeftButton);
    QTest::mouseClick(find<QToolButton>("newer"), Qt::LeftButton);
    find<QSlider>("frames")->setFocus();
    QTest::keyClick(find<QSlider>("frames"), Qt::Key_Home);
    ASSERT_EQ(chosen.count(), 3);
    EXPECT_EQ(chosen[0][0].toInt(), 1);
    EXPECT_EQ(chosen[1][0].toInt(), 3);
    EXPECT_EQ(chosen[2][0].toInt(), 0);
    QTest::mouseClick(find<QToolButton>("now"), Qt::LeftButton);
    EXPECT_EQ(now.count(), 1);
    EXPECT_EQ(find<QLabel>("caption")->text(), "3 of 4");
    EXPECT_EQ(find<QLabel>("used")->text(), "2 MiB of");
}

TEST_F(FramesPanelTest, NowHasNothingNewerAndReasonsAreSaid) {
    panel.show_state({.edited = {false}, .shown = 0, .why_no_film = "no picture"});
    for (const char* name : {"older", "newer", "now", "frame-film"})
        EXPECT_FALSE(find<QToolButton>(name)->isEnabled()) << name;
    EXPECT_TRUE(find<QToolButton>("frame-film")->toolTip().contains("no picture"));
    panel.show_state({});
    EXPECT_FALSE(find<QToolButton>("older")->isEnabled());
    panel.show_state({.edited = {false}, .shown = 0, .is_past = true});
    EXPECT_TRUE(find<QToolButton>("newer")->isEnabled()) << "what came after it was not kept";
    EXPECT_TRUE(find<QToolButton>("now")->isEnabled());
}

TEST_F(FramesPanelTest, TheLimitIsTypedAndFilmsAreChosen) {
    QSignalSpy limits(&panel, &FramesPanel::limit_chosen), films(&panel, &FramesPanel::film_wanted);
    auto* limit = find<NumberField>("limit");
    limit->setFocus();
    limit->selectAll();
    QTest::keyClicks(limit, "64");
    QTest::keyClick(limit, Qt::Key_Return);
    ASSERT_GE(limits.count(), 1);
    EXPECT_EQ(limits.last()[0].toDouble(), 64);
    limit->selectAll();
    QTest::keyClicks(limit, "-3");
    QTest::keyClick(limit, Qt::Key_Return);
    EXPECT_GE(limits.last()[0].toDouble(), 0);
    find<QAction>("film-values")->trigger();
    ASSERT_EQ(films.count(), 1);
    EXPECT_EQ(films[0][0].value<FramesPanel::Film>(), FramesPanel::Film::values);
}

}  // namespace
}  // namespace ir::widgets
