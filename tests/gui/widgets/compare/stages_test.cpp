#include <QComboBox>
#include <QHelpEvent>
#include <QLabel>
#include <QSignalSpy>
#include <QStandardItemModel>
#include <QToolTip>
#include <algorithm>
#include <cmath>

#include "tests/gui/events.h"
#include "tests/gui/widgets/compare/pictures.h"
#include "widgets/views/view_state.h"

namespace ir::widgets {
namespace {

using Mode = CompareView::Mode;

class StagesTest : public CompareTest {
  protected:
    void SetUp() override {
        CompareTest::SetUp();
        if (IsSkipped()) return;
        view = std::make_unique<CompareView>(nullptr, surface());
        view->set_pictures({flat(0.2f, "traced"), flat(0.5f, "smoothed"), flat(0.4f, "clipped")});
        view->set_displays({grey_display(), grey_display(), grey_display()});
        view->set_difference_display(grey_display());
        view->set_difference(DifferenceKind::absolute);
        view->panes().set_pixel_grid(false);
        view->set_mode(Mode::stages);
        show(*view, {1100, 480});
        wait_for_differences(*view);
    }
    QComboBox* list(const char* name) { return view->findChild<QComboBox*>(name); }
    void choose(QComboBox* combo, int index) {
        combo->setCurrentIndex(index);
        emit combo->activated(index);
        wait_for_differences(*view);
    }
    void click_name(int stage) {
        QWidget* board = view->main_view().parentWidget();
        QTest::mouseClick(board, Qt::LeftButton, {}, view->panes().caption_rect(stage).center());
        wait_for_differences(*view);
    }
    std::unique_ptr<CompareView> view;
};

TEST_P(StagesTest, NumbersStandUnderTheDifferences) {
    const auto captions = view->panes().captions();
    ASSERT_EQ(captions.size(), 5);
    EXPECT_EQ(captions[0], "A   traced");
    EXPECT_EQ(captions[3], "RMSE 0.3");
    EXPECT_EQ(captions[4], "RMSE 0.1");
    for (auto* each : view->difference_views())
        EXPECT_LT(each->geometry().bottom(), each->parentWidget()->height() - 12);
}

TEST_P(StagesTest, AllAreComparedWithOneOfTheRow) {
    view->set_stage_pair({StagePair::none, 2});
    wait_for_differences(*view);
    EXPECT_EQ(view->difference_views().size(), 2u);
    EXPECT_EQ(view->panes().captions()[3], "RMSE 0.2");
    EXPECT_EQ(view->panes().captions()[4], "RMSE 0.1");
    view->set_stage_pair({StagePair::none, 0});
    wait_for_differences(*view);
    EXPECT_EQ(view->panes().captions()[3], "RMSE 0.3") << "of B";
    EXPECT_EQ(view->panes().captions()[4], "RMSE 0.2") << "of C";
}

TEST_P(StagesTest, AllAreComparedWithTheReference) {
    const auto truth = flat(0.6f, "truth");
    view->set_references(true, {truth, truth, truth});
    choose(list("stage-b"), list("stage-b")->count() - 1);
    EXPECT_EQ(view->compared().pair, (StagePair{StagePair::none, StagePair::reference}));
    ASSERT_EQ(view->difference_views().size(), 3u);
    EXPECT_EQ(view->views().size(), 3u) << "it is no stage";
    EXPECT_EQ(view->panes().captions().mid(3), QStringList({"RMSE 0.4", "RMSE 0.1", "RMSE 0.2"}));
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_EQ(view->difference_views()[i]->x(), view->views()[i]->x()) << "each below its picture";
    EXPECT_EQ(view->difference_views()[0]->state().label, "|A − Reference|");
    view->set_references(false, {});
    EXPECT_EQ(view->difference_views().size(), 2u);
}

TEST_P(StagesTest, EachPictureIsComparedWithItsOwnReference) {
    auto pictures = view->compared().pictures;
    view->set_references(true, {flat(0.6f, "near"), pictures[2], nullptr});
    view->set_stage_pair({StagePair::none, StagePair::reference});
    wait_for_differences(*view);
    EXPECT_EQ(view->panes().captions().mid(3), QStringList({"RMSE 0.4", "RMSE 0.1"})) << "C has none";
    EXPECT_EQ(view->difference_views()[0]->state().label, "|A − near|");
    EXPECT_EQ(view->difference_views()[1]->state().label, "|B − C|") << "it stands in the row";
    EXPECT_TRUE(view->panes().cells()[3].tip.contains("against near"));
    EXPECT_TRUE(view->panes().cells()[4].tip.contains("against C   clipped"));
    view->set_stage_pair({1, StagePair::reference});
    wait_for_differences(*view);
    EXPECT_EQ(view->findChild<QLabel*>("stage-number")->text(), "RMSE 0.1");
    EXPECT_FLOAT_EQ(view->views().back()->image().at(0, 0), 0.4f);
    view->swap();
    wait_for_differences(*view);
    EXPECT_EQ(view->compared().pair, (StagePair{0, StagePair::reference})) << "the same picture";
    EXPECT_EQ(view->findChild<QLabel*>("stage-number")->text(), "RMSE 0.1");
}

TEST_P(StagesTest, AReferenceHasTheCameraOfItsPicture) {
    view->set_camera(CameraPose());
    view->set_linked(false);
    view->set_references(true, {nullptr, flat(0.6f, "truth"), nullptr});
    view->set_stage_pair({1, StagePair::reference});
    wait_for_differences(*view);
    view->panes().set_tool(ImageView::Tool::orbit);
    auto &second = *view->views()[1], &reference = *view->views().back();
    ASSERT_FLOAT_EQ(reference.image().at(0, 0), 0.6f);
    QSignalSpy moves(view.get(), &CompareView::camera_moved);
    QTest::mousePress(&reference, Qt::LeftButton, {}, {60, 60});
    QTest::mouseMove(&reference, {90, 70});
    QTest::mouseRelease(&reference, Qt::LeftButton, {}, {90, 70});
    ASSERT_GE(moves.count(), 1);
    EXPECT_EQ(moves.last()[1].toInt(), 1);
    EXPECT_NE(second.camera().pose(), CameraPose());
    EXPECT_EQ(reference.camera().pose(), second.camera().pose());
    EXPECT_EQ(view->views()[0]->camera().pose(), CameraPose());
}

TEST_P(StagesTest, WhatHasNoDifferenceLeavesNoBandEmpty) {
    const auto far = flat(0.6f, "far"), near = flat(0.7f, "near");
    const auto show_methods = [&](std::vector<PicturePtr> references) {
        const auto count = references.size();
        view->set_references(true, {});
        std::vector<PicturePtr> pictures;
        for (std::size_t i = 0; i < count; ++i) pictures.push_back(flat(0.1f * float(i)));
        for (const auto& truth : {far, near})
            if (std::find(references.begin(), references.end(), truth) != references.end())
                pictures.push_back(truth);
        references.resize(pictures.size());
        view->set_pictures(pictures);
        view->set_references(true, references);
        view->set_stage_pair({StagePair::none, StagePair::reference});
        wait_for_differences(*view);
    };
    view->resize(1400, 480);
    show_methods({far, near});
    ASSERT_EQ(view->views().size(), 4u);
    EXPECT_EQ(view->views()[2]->x(), view->views()[3]->x()) << "both truths in one column";
    EXPECT_EQ(view->views()[3]->y(), view->difference_views()[0]->y());
    view->resize(600, 900);
    show_methods({far, far});
    ASSERT_TRUE(QTest::qWaitFor([&] { return view->views()[2]->y() > view->views()[0]->y(); }, 60000));
    EXPECT_EQ(view->views()[1]->y(), view->views()[0]->y());
    const auto* truth = view->views()[2];
    EXPECT_GT(truth->geometry().bottom(), truth->parentWidget()->height() - truth->height() / 2);
}

/// A view is told its mode before its pictures.
TEST_P(StagesTest, BeginWithNoPictureAndWithOne) {
    CompareView fresh(nullptr, surface());
    fresh.set_mode(Mode::stages);
    show(fresh, {40, 30});
    EXPECT_EQ(fresh.views().size(), 1u);
    fresh.set_pictures({flat(0.2f)});
    EXPECT_EQ(fresh.views().size(), 1u);
    fresh.resize(2, 2);
    test::handle_events();
    fresh.set_pictures({make_note({}), flat(0.2f)});
    EXPECT_EQ(fresh.difference_views().size(), 1u);
}

TEST(StagesOfAView, APairStaysThatOfItsPictures) {
    ViewState state;
    state.more = {{"b", ""}, {"c", ""}, {"d", ""}};
    state.pair = {StagePair::none, 3};
    const auto leave = [&](const std::string& owner) {
        leave_out(state, [&](const ViewSource& each) { return each.owner == owner; });
    };
    leave("b");
    EXPECT_EQ(state.more.size(), 2u);
    EXPECT_EQ(state.pair, (StagePair{StagePair::none, 2})) << "d still";
    leave("d");
    EXPECT_EQ(state.pair, StagePair());
}

TEST(StagesOfAView, ThePairMovesWithPicturesThatChangePlaces) {
    ViewState state;
    state.mode = ViewMode::stages;
    state.a = {"a", ""};
    state.b = {"other", ""};
    state.more = {{"b", ""}, {"c", ""}};
    state.pair = {1, 2};
    state.chain = true;
    swap_first(state);
    EXPECT_EQ(state.a.owner, "b");
    EXPECT_EQ(state.more.front().owner, "a");
    EXPECT_EQ(state.b.owner, "other");
    EXPECT_EQ(state.pair, (StagePair{0, 2}));
    EXPECT_FALSE(state.chain) << "else its order would come back";
    state.pair = {StagePair::none, StagePair::reference};
    swap_first(state);
    EXPECT_EQ(state.pair, (StagePair{StagePair::none, StagePair::reference}));
    state.mode = ViewMode::wipe;
    state.pair = {0, 1};
    swap_first(state);
    EXPECT_EQ(state.a.owner, "other");
    EXPECT_EQ(state.b.owner, "a");
    EXPECT_EQ(state.pair, (StagePair{0, 1}));
}

TEST_P(StagesTest, WrapWhereThatShowsThemLarger) {
    view->resize(500, 900);
    EXPECT_TRUE(QTest::qWaitFor([&] { return view->views()[2]->y() > view->views()[0]->y(); }, 60000));
    EXPECT_EQ(view->views()[1]->y(), view->views()[0]->y());
    EXPECT_EQ(view->difference_views()[0]->x(), view->views()[0]->x()) << "below the first of its two";
    EXPECT_GT(view->views()[2]->y(), view->difference_views()[0]->geometry().bottom());
    view->resize(1200, 400);
    EXPECT_TRUE(QTest::qWaitFor([&] { return view->views()[2]->y() == view->views()[0]->y(); }, 60000));
}

TEST_P(StagesTest, PicturesShownAlikeStandAlike) {
    view->panes().set_legend(true);
    view->active_view().fit();
    const auto zoom = view->views()[0]->transform().zoom();
    for (auto* each : view->views()) EXPECT_EQ(each->transform().zoom(), zoom);
    EXPECT_FALSE(view->views()[0]->state().legend);
    EXPECT_TRUE(view->views()[2]->state().legend);
    EXPECT_EQ(view->views()[0]->transform().view_from_image({0, 0}),
              view->views()[2]->transform().view_from_image({0, 0}));
}

TEST_P(StagesTest, ClicksOnNamesCompareAnyTwo) {
    QSignalSpy chosen(view.get(), &CompareView::stage_pair_chosen);
    click_name(2);
    EXPECT_EQ(view->difference_views().size(), 2u);
    click_name(0);
    EXPECT_EQ(chosen.count(), 2);
    EXPECT_EQ(view->compared().pair, (StagePair{2, 0}));
    ASSERT_EQ(view->difference_views().size(), 3u);
    ASSERT_EQ(view->views().size(), 4u);
    ImageView& beside = *view->difference_views()[2];
    view->active_view().fit();
    EXPECT_NEAR(grey_at(beside, 8, 6), grey_of(0.2), 2);
    EXPECT_GT(beside.x(), view->views()[2]->geometry().right());
    EXPECT_EQ(beside.x(), view->views()[3]->x()) << "under B";
    EXPECT_EQ(view->findChild<QLabel*>("stage-number")->text(), "RMSE 0.2");
    turn_wheel(&beside, {60, 60}, 3);
    EXPECT_DOUBLE_EQ(view->main_view().transform().zoom(), beside.transform().zoom());
    click_name(0);
    EXPECT_EQ(view->difference_views().size(), 2u) << "chosen no longer";
}

TEST_P(StagesTest, KeysChooseAndClear) {
    view->main_view().setFocus();
    QTest::keyClick(&view->main_view(), Qt::Key_1);
    QTest::keyClick(&view->main_view(), Qt::Key_3);
    EXPECT_EQ(view->compared().pair, (StagePair{0, 2}));
    QTest::keyClick(&view->main_view(), Qt::Key_7);
    EXPECT_EQ(view->compared().pair, (StagePair{0, 2})) << "there is no seventh";
    QTest::keyClick(&view->main_view(), Qt::Key_0);
    EXPECT_EQ(view->compared().pair, StagePair());
    wait_for_differences(*view);
}

TEST_P(StagesTest, APictureOfAnotherSizeAndMethodIsShownAndNotCompared) {
    view->set_pictures({flat(0.2f, "traced"), flat(0.5f, "smoothed"), flat(0.4f, "half", 8, 6)});
    wait_for_differences(*view);
    EXPECT_TRUE(view->compared().refusal().isEmpty());
    EXPECT_EQ(view->panes().captions()[3], "RMSE 0.3");
    EXPECT_EQ(view->panes().captions()[4], "");
    EXPECT_TRUE(view->views()[2]->state().note.isEmpty());
    EXPECT_TRUE(view->difference_views()[1]->state().note.contains("8×6"));
}

TEST_P(StagesTest, StagesOfOneMethodAreComparedAtTheLargerSize) {
    const auto of_method = [](std::shared_ptr<const Picture> picture) {
        auto named = *picture;
        named.origin = "method";
        return std::make_shared<const Picture>(std::move(named));
    };
    Image half(8, 6, 1, 0.5f);
    half.at(1, 2) = 0.9f;  // covers four pixels of 192
    view->set_pictures({of_method(make_picture(half, Semantic::generic, "half")),
                        of_method(flat(0.5f, "whole")), of_method(flat(0.4f, "small", 8, 6))});
    wait_for_differences(*view);
    ASSERT_EQ(view->difference_views().size(), 2u);
    const Image& shown = view->difference_views()[0]->image();
    ASSERT_EQ(QSize(shown.width, shown.height), QSize(16, 12));
    for (int y = 0; y < 12; ++y)
        for (int x = 0; x < 16; ++x)
            ASSERT_NEAR(shown.at(x, y), x / 2 == 1 && y / 2 == 2 ? 0.4f : 0, 1e-6) << x << ", " << y;
    EXPECT_EQ(view->panes().captions()[3],
              QStringLiteral("RMSE %1").arg(std::sqrt(0.16 * 4 / 192), 0, 'g', 4));
    EXPECT_EQ(view->difference_views()[0]->state().label, "|A (8×6) − B|");
    EXPECT_EQ(view->panes().captions()[4], "RMSE 0.1");
    EXPECT_EQ(view->difference_views()[1]->state().label, "|B − C (8×6)|");
    QWidget* board = view->main_view().parentWidget();
    const QPoint caption(view->difference_views()[0]->geometry().center().x(),
                         view->difference_views()[0]->geometry().bottom() + 4);
    QHelpEvent help(QEvent::ToolTip, caption, board->mapToGlobal(caption));
    QApplication::sendEvent(board, &help);
    EXPECT_TRUE(QToolTip::text().contains("A has 8×6 pixels, B has 16×12")) << QToolTip::text().toStdString();
}

TEST_P(StagesTest, TheReferenceIsInTheListWhereThereIsOne) {
    const int last = list("stage-b")->count() - 1;
    auto* item = qobject_cast<QStandardItemModel*>(list("stage-b")->model())->item(last);
    EXPECT_FALSE(item->isEnabled());
    const auto truth = flat(0.45f, "truth");
    view->set_references(true, {truth, truth, truth});
    EXPECT_TRUE(qobject_cast<QStandardItemModel*>(list("stage-b")->model())->item(last)->isEnabled());
    choose(list("stage-a"), 2);
    choose(list("stage-b"), last);
    EXPECT_EQ(view->compared().pair, (StagePair{1, StagePair::reference}));
    ASSERT_EQ(view->difference_views().size(), 3u);
    EXPECT_EQ(view->panes().captions().last(), "RMSE 0.05");
    EXPECT_FLOAT_EQ(view->views().back()->image().at(0, 0), 0.45f);
    view->set_references(false, {});
    EXPECT_EQ(view->difference_views().size(), 2u);
}

INSTANTIATE_TEST_SUITE_P(, StagesTest, testing::Bool(),
                         [](const auto& each) { return each.param ? "opengl" : "raster"; });

}  // namespace
}  // namespace ir::widgets
