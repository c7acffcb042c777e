// A method with a chain of stages, in the window.

#include <QDockWidget>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QToolButton>
#include <algorithm>

#include "tests/gui/window/window_fixture.h"

namespace ir::gui {
namespace {

using widgets::StagePair;
using widgets::ViewMode;

class StagesWindowTest : public WindowTest {
  protected:
    void SetUp() override {
        WindowTest::SetUp();
        open_scene();
        set_method("filter");
    }
    void set_method(const std::string& id) {
        window.session().edit([&](const projects::Project& project) {
            return projects::edits::set_method(project, fake_registry(), window.session().experiment()->id,
                                               id);
        });
        ASSERT_TRUE(settle());
    }
    void set_value(const std::string& key, const Value& value) {
        window.session().edit([&](const projects::Project& project) {
            return projects::edits::set_values(project, fake_registry(), window.session().experiment()->id,
                                               {{key, value}});
        });
        ASSERT_TRUE(settle());
    }
    Workspace& workspace() { return window.workspace(); }
    ViewModel& views() { return window.views(); }
    widgets::CompareView& compare() { return window.workspace().active_pane().compare(); }
    /// A row of 32×24, 64×48 and 64×48 pixels.
    void show_unequal_stages() {
        renderer.halves_rough = true;
        const auto id = window.session().experiment()->id;
        window.session().edit([&](const auto& project) {
            return projects::edits::set_size(project, id, {64, 48});
        });
        trigger("stages");
        ASSERT_EQ(compare().compared().pictures[0]->size(), QSize(32, 24));
        ASSERT_EQ(compare().compared().pictures[1]->size(), QSize(64, 48));
    }
    std::string values() {
        return workspace().active_pane().findChild<QLabel*>("values")->text().toStdString();
    }
    QStringList names() {
        QStringList all;
        for (const auto& picture : compare().compared().pictures) all << picture->label;
        return all;
    }
};

TEST_F(StagesWindowTest, TheChainStandsInARowInItsOrder) {
    trigger("stages");
    EXPECT_EQ(names(), QStringList({"Traced", "Smoothed", "Composed"}));
    ASSERT_TRUE(compare().compared().refusal().isEmpty()) << compare().compared().refusal().toStdString();
    EXPECT_EQ(compare().panes().captions().mid(3), QStringList({"RMSE 0.375", "RMSE 0.125"}));
    choose(header("difference"), "|A − B|");
    EXPECT_EQ(views().active_state().difference, DifferenceKind::absolute);
    EXPECT_EQ(compare().difference_views().size(), 2u);
}

TEST_F(StagesWindowTest, StagesComeAndGoWithTheSettings) {
    trigger("stages");
    set_value("smooth", false);
    EXPECT_EQ(names(), QStringList({"Traced", "Composed"}));
    set_value("smooth", true);
    EXPECT_EQ(names(), QStringList({"Traced", "Smoothed", "Composed"}));
}

TEST_F(StagesWindowTest, AChosenExposureIsThatOfAllPicturesOfLight) {
    const QTemporaryDir folder;
    trigger("views-2");
    workspace().area().set_active(1);
    trigger("stages");
    workspace().area().set_active(0);
    const auto main = [&]() -> widgets::ImageView& { return workspace().pane(0)->compare().main_view(); };
    const auto row = [&] { return workspace().pane(1)->compare().views(); };
    const auto is_everywhere = [&](double exposure, widgets::Display::ToneMap map) {
        auto all = row();
        all.push_back(&main());
        return std::all_of(all.begin(), all.end(), [&](auto* view) {
            return view->display().exposure == exposure && view->display().tone_map == map;
        });
    };
    using ToneMap = widgets::Display::ToneMap;
    const double automatic = main().display().exposure;
    ASSERT_TRUE(is_everywhere(automatic, ToneMap::none));
    trigger("zebra");
    EXPECT_TRUE(main().display().zebra);
    EXPECT_FALSE(row().front()->display().zebra) << "the buffer's own";
    trigger("brighter");
    EXPECT_TRUE(is_everywhere(automatic + 0.5, ToneMap::none));
    views().show_output("rough");
    ASSERT_TRUE(settle());
    EXPECT_TRUE(is_everywhere(automatic + 0.5, ToneMap::none)) << "another buffer";
    EXPECT_FALSE(workspace().is_automatic());
    auto* tone_map = window.findChild<QComboBox*>("tone-map");
    choose(tone_map, "Filmic");
    EXPECT_TRUE(is_everywhere(automatic + 0.5, ToneMap::filmic));
    views().show_output("depth");
    ASSERT_TRUE(settle());
    EXPECT_TRUE(workspace().is_automatic()) << "no light";
    trigger("buffer-main");
    // Each has its own while views are not linked.
    trigger("link");
    trigger("brighter");
    const double own = main().display().exposure;
    EXPECT_NE(row().front()->display().exposure, own);
    trigger("link");
    EXPECT_TRUE(is_everywhere(automatic + 0.5, ToneMap::filmic));
    window.session().files().save_as((folder.path() + "/kept.interreflect").toStdString());
    QTest::keyClick(&window, Qt::Key_S, Qt::ControlModifier);
    trigger("close");
    ASSERT_TRUE(window.open_path(folder.path() + "/kept.interreflect"));
    ASSERT_TRUE(settle());
    EXPECT_TRUE(is_everywhere(automatic + 0.5, ToneMap::filmic)) << "remembered";
    EXPECT_TRUE(main().display().zebra);
    trigger("display-reset");
    EXPECT_TRUE(is_everywhere(automatic, ToneMap::none));
    EXPECT_TRUE(workspace().is_automatic());
}

/// A session of before had an exposure for each buffer.
TEST_F(StagesWindowTest, AnExposureThatWasRememberedForABufferCounts) {
    projects::Json memory;
    workspace().save(memory);
    memory["displays"] = {{"rough", {{"exposure", 3.0}, {"tone_map", "reinhard"}}}};
    workspace().load(memory);
    ASSERT_TRUE(settle());
    EXPECT_EQ(window.view().display().exposure, 3.0);
    EXPECT_EQ(window.view().display().tone_map, widgets::Display::ToneMap::reinhard);
}

TEST_F(StagesWindowTest, AnyStageIsComparedWithTheReference) {
    trigger("stages");
    auto* list = workspace().active_pane().findChild<QComboBox*>("stage-b");
    const int last = list->count() - 1;
    EXPECT_EQ(list->itemText(last), "Reference");
    EXPECT_EQ(list->model()->flags(list->model()->index(last, 0)) & Qt::ItemIsEnabled, 0);
    trigger("match");  // shows it as B
    const auto truth = window.session().experiment(views().active_state().a.owner)->reference;
    ASSERT_FALSE(truth.empty());
    trigger("stages");
    auto state = views().active_state();
    state.pair = {0, StagePair::reference};
    views().set_state(0, state);
    ASSERT_TRUE(settle());
    ASSERT_EQ(compare().difference_views().size(), 3u);
    EXPECT_EQ(compare().panes().captions().last(), "RMSE 0.5") << "0.75 instead of 0.25";
    EXPECT_EQ(compare().compared().pictures.size(), 3u) << "the reference is no stage";
    state.pair = {StagePair::none, StagePair::reference};
    views().set_state(0, state);
    ASSERT_TRUE(settle());
    ASSERT_EQ(compare().difference_views().size(), 3u) << "all with it";
    EXPECT_EQ(compare().panes().captions()[3], "RMSE 0.5");
}

/// A method that sees less far has another truth.
TEST_F(StagesWindowTest, EachExperimentIsComparedWithItsOwnReference) {
    set_method("fake");
    add_second_experiment(0.75);
    auto& session = window.session();
    const auto first = session.document().experiments[0].id, second = session.document().experiments[1].id;
    const auto set = [&](const std::string& id, const char* key, double value) {
        ASSERT_TRUE(session.edit([&](const projects::Project& project) {
            return projects::edits::set_values(project, fake_registry(), id, {{key, value}});
        }));
        session.end_gesture();
    };
    set(second, "max_distance", 1);
    for (const auto& id : {first, second}) {
        views().show_owner(id);
        ASSERT_TRUE(settle());
        trigger("match");
    }
    const auto far = session.experiment(first)->reference, near = session.experiment(second)->reference;
    ASSERT_NE(far, near);
    set(near, "level", 0.5);
    widgets::ViewState state;
    state.mode = ViewMode::stages;
    state.a = {first, ""};
    state.more = {{second, ""}};
    state.pair.b = StagePair::reference;
    views().set_active_state(state);
    ASSERT_TRUE(settle());
    EXPECT_EQ(compare().panes().captions().mid(2), QStringList({"RMSE 0", "RMSE 0.25"}))
        << "not of one truth";
    const auto name = QString::fromStdString(session.experiment(near)->name);
    EXPECT_TRUE(compare().panes().cells()[3].tip.contains(name))
        << compare().panes().cells()[3].tip.toStdString();
    state.more.push_back({near, ""});
    views().set_active_state(state);
    ASSERT_TRUE(settle());
    EXPECT_EQ(compare().panes().captions().mid(3), QStringList({"RMSE 0", "RMSE 0.25"}));
    EXPECT_EQ(compare().difference_views()[1]->state().label, "B − C") << "it stands in the row";
    // The numbers of all of them, not of A and B.
    auto* dock = window.findChild<QDockWidget*>("metrics");
    dock->show();
    dock->raise();
    ASSERT_TRUE(settle());
    const auto& model = window.metrics().panel().model();
    const auto& names = metric_names();
    const auto rmse = int(std::find(names.begin(), names.end(), "rmse") - names.begin());
    using Model = widgets::MetricsModel;
    EXPECT_NEAR(model.value(rmse, Model::column_of(0, Model::image_column)).value_or(-1), 0, 1e-6);
    EXPECT_NEAR(model.value(rmse, Model::column_of(1, Model::image_column)).value_or(-1), 0.25, 1e-6);
    EXPECT_EQ(model.headerData(Model::column_of(1, Model::image_column), Qt::Horizontal, Qt::DisplayRole),
              "B − C");
    trigger("swap");
    EXPECT_EQ(compare().panes().captions().mid(3), QStringList({"RMSE 0.25", "RMSE 0"}));
    EXPECT_EQ(views().active_state().pair, state.pair);
}

TEST_F(StagesWindowTest, AnUnlinkedCameraIsThatOfItsPicture) {
    set_method("fake");
    add_second_experiment(0.75);
    const auto& experiments = window.session().document().experiments;
    const auto first = experiments[0].id, second = experiments[1].id;
    widgets::ViewState state;
    state.mode = ViewMode::stages;
    state.a = state.b = {first, ""};
    state.more = {{second, ""}};
    views().set_active_state(state);
    views().set_linked(false);
    ASSERT_TRUE(settle());
    emit compare().camera_moved(widgets::CameraPose(), 1);
    EXPECT_TRUE(window.session().camera().moved_pose(second)) << "it stands second in the row";
    EXPECT_FALSE(window.session().camera().moved_pose(first)) << "the B of other modes";
    window.session().camera().forget_move();
}

TEST_F(StagesWindowTest, ADoubleClickShowsAPictureAlone) {
    trigger("stages");
    const auto row = views().active_state();
    const auto double_click = [&](widgets::ImageView* view) {
        QTest::mouseDClick(view, Qt::LeftButton, {}, view->rect().center());
        ASSERT_TRUE(settle());
    };
    double_click(compare().views()[1]);
    EXPECT_EQ(views().active_state().mode, ViewMode::single);
    EXPECT_EQ(views().active_state().a, row.more.front());
    ASSERT_EQ(compare().views().size(), 1u);
    EXPECT_EQ(window.view().picture()->label.section(" · ", -1), "Smoothed");
    double_click(&window.view());
    EXPECT_EQ(views().active_state(), row);
    double_click(compare().difference_views()[0]);
    EXPECT_EQ(views().active_state().mode, ViewMode::difference);
    EXPECT_EQ(views().active_state().a, row.a);
    EXPECT_EQ(views().active_state().b, row.more.front());
    window.view().setFocus();
    QTest::keyClick(&window.view(), Qt::Key_Escape);
    ASSERT_TRUE(settle());
    EXPECT_EQ(views().active_state(), row) << "Esc goes back, too";
    // Side by side; the second one is of another experiment.
    trigger("experiment-duplicate");
    trigger("mode-side-by-side");
    const auto both = views().active_state();
    ASSERT_NE(both.a.owner, both.b.owner);
    double_click(compare().views()[1]);
    EXPECT_EQ(views().active_state().a, both.b);
    EXPECT_EQ(window.session().experiment()->id, both.b.owner) << "what is shown is worked on";
    trigger("mode-wipe");
    EXPECT_EQ(views().active_state().a, both.a) << "another mode is of both again";
    EXPECT_EQ(views().active_state().b, both.b);
    trigger("mode-single");
    const auto alone = views().active_state();
    double_click(&window.view());
    EXPECT_EQ(views().active_state(), alone) << "nothing stood beside it";
    // A drawing hand shows nothing else.
    trigger("mode-side-by-side");
    trigger("rectangle");
    double_click(compare().views()[0]);
    EXPECT_EQ(views().active_state().mode, ViewMode::side_by_side);
}

/// In a row of one owner there is room for what the pictures differ in.
TEST_F(StagesWindowTest, ARowSaysEachNameOnce) {
    trigger("stages");
    EXPECT_EQ(compare().panes().captions().front(), "A   Traced");
    for (const auto* view : compare().views()) EXPECT_EQ(view->state().label, QString());
    set_method("fake");
    auto state = views().active_state();
    state.chain = false;
    state.more = {{state.a.owner, "depth"}, {state.a.owner, "noise"}};
    views().set_active_state(state);
    ASSERT_TRUE(settle());
    EXPECT_EQ(names(), QStringList({"Picture", "Depth", "Noise"}));
    trigger("mode-side-by-side");
    EXPECT_NE(compare().views().front()->state().label, QString()) << "no captions there";
}

TEST_F(StagesWindowTest, SwappingMovesThePairAndMakesARowOfOnesOwn) {
    trigger("stages");
    auto state = views().active_state();
    state.pair = {1, 2};
    views().set_active_state(state);
    ASSERT_TRUE(settle());
    const auto number = compare().panes().captions().last();
    trigger("swap");
    EXPECT_EQ(views().active_state().pair, (StagePair{0, 2}));
    EXPECT_FALSE(views().active_state().chain);
    EXPECT_EQ(compare().panes().captions().last(), number);
    EXPECT_EQ(views().active_state().a.output, "smoothed");
}

TEST_F(StagesWindowTest, TheSessionRemembersRowAndPair) {
    trigger("stages");
    auto state = views().active_state();
    state.pair = {2, 0};
    views().set_state(0, state);
    projects::Json memory;
    workspace().save(memory);
    trigger("mode-single");
    workspace().load(memory);
    ASSERT_TRUE(settle());
    EXPECT_TRUE(views().active_state().chain);
    EXPECT_EQ(views().active_state().pair, (StagePair{2, 0}));
    EXPECT_EQ(compare().difference_views().size(), 3u);
    memory["views"]["states"][0]["pair"] = {900, "x"};  // nobody trusts the file
    workspace().load(memory);
    ASSERT_TRUE(settle());
    EXPECT_EQ(views().active_state().pair, StagePair());
}

TEST_F(StagesWindowTest, ThePixelUnderTheCursorIsThatOfThePictureThere) {
    show_unequal_stages();
    auto &half = *compare().views()[0], &whole = *compare().views()[1];
    auto& difference = *compare().difference_views()[1];
    QSignalSpy moved(&workspace(), &Workspace::cursor_moved);
    emit half.cursor_moved({10, 6});
    EXPECT_EQ(moved.last().at(0).toPoint(), QPoint(21, 13));
    EXPECT_NE(values().find("x   10  y    6   R 0.75"), std::string::npos) << values();
    emit whole.cursor_moved({40, 30});
    EXPECT_EQ(moved.last().at(0).toPoint(), QPoint(40, 30));
    EXPECT_NE(values().find("x   40  y   30   R 0.375"), std::string::npos) << values();
    emit difference.cursor_moved({63, 47});
    EXPECT_EQ(moved.last().at(0).toPoint(), QPoint(63, 47));
    EXPECT_NE(values().find("x   63  y   47   R 0.125"), std::string::npos) << values();
    emit whole.cursor_moved({40, 30});
    type_level("0.5");  // a new frame; the cursor rests
    EXPECT_NE(values().find("x   40  y   30   R 0.625"), std::string::npos) << values();
}

TEST_F(StagesWindowTest, APixelIsMarkedInEveryPictureWhereItIs) {
    show_unequal_stages();
    auto &half = *compare().views()[0], &whole = *compare().views()[1];
    window.inspector().explain({41, 31});
    ASSERT_TRUE(settle());
    EXPECT_EQ(whole.state().marks.picked, QPoint(41, 31));
    EXPECT_EQ(half.state().marks.picked, QPoint(20, 15));
    whole.set_mark(&widgets::Marks::picked, {12, 8});  // as a click does
    emit whole.picked_changed({12, 8});
    EXPECT_EQ(half.state().marks.picked, QPoint(6, 4));
    window.inspector().explain({12, 8});
    ASSERT_TRUE(settle());
    EXPECT_EQ(whole.state().marks.picked, QPoint(12, 8)) << "the mark stays";
}

TEST_F(StagesWindowTest, MetricsMeasureWhatTheRowMeasures) {
    show_unequal_stages();
    auto* dock = window.findChild<QDockWidget*>("metrics");
    dock->show();
    dock->raise();
    ASSERT_TRUE(settle());
    auto& panel = window.metrics().panel();
    EXPECT_EQ(panel.fields().size, QSize(64, 48));
    EXPECT_FALSE(panel.findChild<QLabel*>("refusal")->isVisible())
        << panel.findChild<QLabel*>("refusal")->text().toStdString();
    const auto& names = metric_names();
    const auto rmse = int(std::find(names.begin(), names.end(), "rmse") - names.begin());
    const auto measured = panel.model().value(rmse, widgets::MetricsModel::image_column);
    ASSERT_TRUE(measured);
    EXPECT_NEAR(*measured, 0.375, 1e-6);
    EXPECT_EQ(compare().panes().captions()[3], "RMSE 0.375");
    workspace().tools().set_region({64, 48}, {32, 24, 8, 8});
    ASSERT_TRUE(settle());
    EXPECT_NEAR(panel.model().value(rmse, widgets::MetricsModel::rectangle_column).value_or(-1), 0.375, 1e-6);
}

TEST_F(StagesWindowTest, PicturesThatDoNotChangeAreNotMadeAnew) {
    trigger("match");
    trigger("stages");
    auto state = views().active_state();
    state.pair = {0, StagePair::reference};
    views().set_state(0, state);
    ASSERT_TRUE(settle());
    const auto pictures = compare().compared().pictures;
    const auto references = compare().compared().references;
    ASSERT_FALSE(references.empty());
    window.session().edit(
        [](const projects::Project& project) { return projects::edits::set_notes(project, "a note"); });
    ASSERT_TRUE(settle());
    EXPECT_EQ(compare().compared().pictures, pictures);
    EXPECT_EQ(compare().compared().references, references);
    set_value("level", 0.5);
    EXPECT_NE(compare().compared().pictures, pictures);
    EXPECT_EQ(names(), QStringList({"Traced", "Smoothed", "Composed"}));
}

TEST_F(StagesWindowTest, AMethodWithoutStagesSaysSo) {
    trigger("stages");
    set_method("fake");
    EXPECT_FALSE(window.action("stages")->isEnabled());
    EXPECT_TRUE(window.action("stages")->toolTip().contains("none"));
    const auto* warning = workspace().active_pane().header().findChild<QLabel*>("warning");
    EXPECT_TRUE(warning->isVisible());
    EXPECT_TRUE(warning->text().contains("names no stages")) << warning->text().toStdString();
    workspace().active_pane().header().findChild<QToolButton*>("chain")->click();
    ASSERT_TRUE(settle());
    EXPECT_FALSE(views().active_state().chain);
    EXPECT_GT(compare().compared().pictures.size(), 1u) << "a row of other pictures";
}

}  // namespace
}  // namespace ir::gui
