#include <QDockWidget>
#include <QTemporaryDir>

#include "renderers/image/exr.h"
#include "tests/gui/window/window_fixture.h"

namespace ir::gui {
namespace {

using widgets::ViewMode;

class CompareWindowTest : public WindowTest {
  protected:
    void SetUp() override {
        WindowTest::SetUp();
        open_scene();
        add_second_experiment(0.75);
    }
    Workspace& workspace() { return window.workspace(); }
    ViewModel& views() { return window.views(); }
    widgets::CompareView& compare() { return window.workspace().active_pane().compare(); }
    bool wait_for_difference() {
        return QTest::qWaitFor([this] { return compare().difference_picture() != nullptr; }, 60000);
    }
};

TEST_F(CompareWindowTest, TwoExperimentsAreComparedInEveryMode) {
    for (const char* action : {"mode-side-by-side", "mode-wipe", "mode-flip", "mode-difference"}) {
        trigger(action);
        ASSERT_GE(compare().compared().pictures.size(), 2u) << action;
        EXPECT_FLOAT_EQ(compare().compared().pictures[0]->image->at(0, 0), 0.25f) << action;
        EXPECT_FLOAT_EQ(compare().compared().pictures[1]->image->at(0, 0), 0.75f) << action;
        EXPECT_TRUE(compare().compared().refusal().isEmpty()) << action;
    }
    ASSERT_TRUE(wait_for_difference());
    EXPECT_FLOAT_EQ(compare().difference_picture()->image->at(0, 0), -0.5f);
}

TEST_F(CompareWindowTest, TheKindOfDifferenceIsChosenInTheHeader) {
    trigger("mode-difference");
    ASSERT_TRUE(wait_for_difference());
    choose(header("difference"), "|A − B|");
    ASSERT_TRUE(QTest::qWaitFor(
        [&] { return compare().difference_picture() && compare().difference_picture()->image->at(0, 0) > 0; },
        60000));
    EXPECT_FLOAT_EQ(compare().difference_picture()->image->at(0, 0), 0.5f);
}

TEST_F(CompareWindowTest, TitlesSayWhatIsComparedWithWhat) {
    const auto title = [this] { return workspace().area().dock(workspace().area().active())->windowTitle(); };
    const auto& experiments = window.session().document().experiments;
    const auto other = QString::fromStdString(views().pictures().owner_name(experiments[1].id));
    const auto alone = title();
    trigger("mode-difference");
    EXPECT_EQ(title(), alone + " − " + other);
    choose(header("difference"), "|A − B|");
    EXPECT_EQ(title(), alone + " · |A − B|, B: " + other);
    trigger("mode-wipe");
    EXPECT_EQ(title(), alone + " · Wipe, B: " + other);
    trigger("mode-flip");
    EXPECT_EQ(title(), alone + " · Flip");
    trigger("mode-single");
    EXPECT_EQ(title(), alone);
}

TEST_F(CompareWindowTest, LinkedDifferencesOfOneKindHaveOneRange) {
    add_second_experiment(0.5);
    trigger("views-2");
    for (const int view : {0, 1}) {
        widgets::ViewState state;
        state.mode = ViewMode::difference;
        state.a = {window.session().document().experiments[0].id, ""};
        state.b = {window.session().document().experiments[std::size_t(view) + 1].id, ""};
        views().set_state(view, state);
    }
    const auto range = [&](int view) {
        const auto& display = workspace().pane(view)->compare().difference_display();
        return std::pair(display.low, display.high);
    };
    const auto own = std::pair(-0.5, 0.5);  // of the larger one
    EXPECT_TRUE(QTest::qWaitFor([&] { return range(0) == own && range(1) == own; }, 60000))
        << range(0).second << " beside " << range(1).second;
    trigger("link");
    EXPECT_TRUE(QTest::qWaitFor([&] { return range(0) != range(1); }, 60000)) << "each its own";
    const int smaller = range(0).second < range(1).second ? 0 : 1;
    EXPECT_EQ(range(1 - smaller), own);
    trigger("link");
    workspace().area().set_active(smaller);
    trigger("views-1");
    EXPECT_TRUE(QTest::qWaitFor([&] { return range(smaller).second < 0.49; }, 60000)) << "alone again";
}

TEST_F(CompareWindowTest, TheLayoutCompareBeginsWithBoth) {
    trigger("layout-compare");
    EXPECT_EQ(workspace().area().open_views().size(), 1u);
    EXPECT_EQ(views().active_state().mode, ViewMode::side_by_side);
    EXPECT_EQ(views().active_state().b.owner, window.session().document().experiments[1].id);
    trigger("mode-wipe");
    trigger("layout-compare");
    EXPECT_EQ(views().active_state().mode, ViewMode::wipe) << "they are compared already";
    const auto tip = window.action("layout-compare")->toolTip();
    EXPECT_TRUE(tip.contains("lens") && tip.contains("stages")) << tip.toStdString();
}

/// As `--layout compare PROJECT` does.
TEST_F(WindowTest, TheLayoutCompareWaitsForAProject) {
    open_scene();
    add_second_experiment(0.75);
    const QTemporaryDir folder;
    const QString project = folder.path() + "/two.interreflect";
    window.session().files().save_as(project.toStdString());
    window.session().files().close();
    window.docks().apply("compare");
    ASSERT_TRUE(window.open_path(project));
    ASSERT_TRUE(settle());
    EXPECT_EQ(window.workspace().area().open_views().size(), 1u);
    EXPECT_EQ(window.views().active_state().mode, ViewMode::side_by_side);
    EXPECT_TRUE(window.findChild<QDockWidget*>("metrics")->isVisible());
}

TEST_F(CompareWindowTest, SwapExchangesAAndB) {
    trigger("mode-difference");
    ASSERT_TRUE(wait_for_difference());
    const auto before = views().active_state();
    QTest::keyClick(&compare().main_view(), Qt::Key_X);
    ASSERT_TRUE(settle());
    EXPECT_EQ(views().active_state().a, before.b);
    EXPECT_EQ(views().active_state().b, before.a);
    ASSERT_TRUE(QTest::qWaitFor(
        [&] { return compare().difference_picture() && compare().difference_picture()->image->at(0, 0) > 0; },
        60000));
}

TEST_F(CompareWindowTest, AForeignImageTakesPart) {
    const QTemporaryDir folder;
    const auto size = window.session().experiment()->size;
    const std::string file = (folder.path() + "/other.exr").toStdString();
    write_exr(file, {{"", {"R", "G", "B"}, Image(size.x, size.y, 3, 0.125f)}}, {});
    window.session().files().add_image(file);
    auto state = views().active_state();
    state.mode = ViewMode::wipe;
    state.b = {"image:" + window.session().document().images[0].id, ""};
    views().set_state(0, state);
    ASSERT_TRUE(QTest::qWaitFor(
        [&] {
            return compare().compared().pictures.size() == 2 && compare().compared().pictures[1]->has_image();
        },
        60000));
    EXPECT_FLOAT_EQ(compare().compared().pictures[1]->image->at(0, 0), 0.125f);
    EXPECT_TRUE(compare().compared().refusal().isEmpty());
}

TEST_F(CompareWindowTest, AForeignImageMeansWhatItIsComparedWithOnEitherSide) {
    const QTemporaryDir folder;
    const auto size = window.session().experiment()->size;
    const std::string file = (folder.path() + "/depth.exr").toStdString();
    write_exr(file, {{"", {"Y"}, Image(size.x, size.y, 1, 0.125f)}}, {});
    window.session().files().add_image(file);
    auto state = views().active_state();
    state.mode = ViewMode::wipe;
    state.b = {state.a.owner, "depth"};
    state.a = {"image:" + window.session().document().images[0].id, ""};
    for (int turn = 0; turn < 2; ++turn) {
        views().set_state(0, state);
        ASSERT_TRUE(settle());
        ASSERT_TRUE(QTest::qWaitFor(
            [&] {
                return compare().compared().pictures[0]->has_image() &&
                       compare().compared().pictures[1]->has_image();
            },
            60000));
        const int ours = turn == 0 ? 1 : 0;
        EXPECT_EQ(compare().compared().pictures[1 - ours]->semantic, Semantic::depth);
        const auto automatic =
            widgets::display_for(Semantic::depth, "", *compare().compared().pictures[ours]->image);
        EXPECT_EQ(compare().compared().shown_display(1 - ours), automatic) << "turn " << turn;
        EXPECT_EQ(compare().compared().shown_display(ours), automatic) << "turn " << turn;
        EXPECT_EQ(workspace().display_key(), "depth");
        std::swap(state.a, state.b);
    }
}

TEST_F(CompareWindowTest, UnequalSizesAreRefusedWithAReason) {
    const auto second = window.session().document().experiments[1].id;
    window.session().edit([&](const projects::Project& project) {
        return projects::edits::set_size(project, second, {40, 30});
    });
    trigger("mode-difference");
    EXPECT_TRUE(QTest::qWaitFor([&] { return !compare().compared().refusal().isEmpty(); }, 60000));
    EXPECT_TRUE(compare().compared().refusal().contains("40"))
        << compare().compared().refusal().toStdString();
}

TEST_F(CompareWindowTest, DifferentScenesAreComparedOnlyWithAWarning) {
    const QTemporaryDir folder;
    trigger("mode-wipe");
    auto* warning = workspace().active_pane().header().findChild<QLabel*>("warning");
    EXPECT_FALSE(warning->isVisible());
    make_scenes_differ();
    EXPECT_TRUE(warning->isVisible());
    EXPECT_TRUE(warning->text().contains("scene"));
}

TEST_F(CompareWindowTest, ZoomIsOneForAllViewsUntilUnlinked) {
    trigger("views-2");
    auto& first = workspace().pane(0)->compare().main_view();
    auto& second = workspace().pane(1)->compare().main_view();
    workspace().pane(0)->compare().active_view().look_at({10, 10}, 8);
    EXPECT_DOUBLE_EQ(second.transform().zoom(), 8);
    trigger("link");
    EXPECT_FALSE(views().linked());
    workspace().pane(0)->compare().active_view().look_at({10, 10}, 16);
    EXPECT_DOUBLE_EQ(first.transform().zoom(), 16);
    EXPECT_DOUBLE_EQ(second.transform().zoom(), 8);
}

TEST_F(CompareWindowTest, ALinkedCameraMovesBothExperimentsAsOneStep) {
    trigger("mode-wipe");
    const auto position = steps();
    trigger("orbit");
    auto& view = compare().main_view();
    QTest::mousePress(&view, Qt::LeftButton, {}, {50, 50});
    for (int x = 55; x < 90; x += 5) QTest::mouseMove(&view, {x, 60});
    QTest::mouseRelease(&view, Qt::LeftButton, {}, {90, 60});
    ASSERT_TRUE(settle());
    EXPECT_EQ(steps(), position + 1);
    const auto& experiments = window.session().document().experiments;
    EXPECT_FALSE(experiments[0].camera.empty());
    EXPECT_EQ(experiments[0].camera, experiments[1].camera);
}

TEST_F(CompareWindowTest, StagesPutTheMethodsPicturesInARow) {
    trigger("mode-stages");
    EXPECT_GE(compare().views().size(), 2u);
    EXPECT_EQ(compare().difference_views().size() + 1, compare().views().size());
}

TEST_F(CompareWindowTest, AComparisonIsKeptInTheProjectAndOpensAgain) {
    trigger("mode-difference");
    ASSERT_TRUE(wait_for_difference());
    trigger("comparison-add");
    ASSERT_EQ(window.session().document().comparisons.size(), 1u);
    const auto kept = window.session().document().comparisons[0];
    EXPECT_EQ(kept.mode, "difference:signed");
    trigger("mode-single");
    workspace().open_comparison(kept);
    ASSERT_TRUE(settle());
    EXPECT_EQ(views().active_state().mode, ViewMode::difference);
    trigger("undo");
    EXPECT_TRUE(window.session().document().comparisons.empty());
}

}  // namespace
}  // namespace ir::gui
