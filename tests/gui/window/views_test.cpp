#include <QDockWidget>
#include <QDragEnterEvent>
#include <QHelpEvent>
#include <QLineEdit>
#include <QListView>
#include <QMimeData>
#include <QStackedWidget>
#include <QTemporaryDir>
#include <QToolButton>
#include <QToolTip>
#include <QTreeView>
#include <memory>

#include "tests/gui/events.h"
#include "tests/gui/window/window_fixture.h"
#include "widgets/panels/search_button.h"

namespace ir::gui {
namespace {

using widgets::ViewArea;
using widgets::ViewMode;
using widgets::ViewPane;

class ViewsTest : public WindowTest {
  protected:
    void SetUp() override {
        WindowTest::SetUp();
        open_scene();
    }
    Workspace& workspace() { return window.workspace(); }
    ViewModel& views() { return window.views(); }
    ViewArea& area() { return window.workspace().area(); }
    const engine::LiveRequest& request() { return renderer.requests.back(); }
};

TEST_F(ViewsTest, OneToFourViewsOpenAndCloseByKeysAndOneStays) {
    EXPECT_EQ(area().open_views().size(), 1u);
    for (const auto& [action, count] : {std::pair{"views-2", 2u},
                                        {"views-3", 3u},
                                        {"views-4", 4u},
                                        {"views-2-stacked", 2u},
                                        {"views-1", 1u}}) {
        trigger(action);
        EXPECT_EQ(area().open_views().size(), count) << action;
    }
    trigger("views-4");  // numbered as one reads
    EXPECT_LT(area().dock(2)->x(), area().dock(3)->x());
    EXPECT_LT(area().dock(0)->y(), area().dock(2)->y());
    trigger("views-1");
    QTest::keyClick(&window, Qt::Key_T, Qt::ControlModifier);
    EXPECT_EQ(area().open_views().size(), 2u);
    QTest::keyClick(&window, Qt::Key_W, Qt::ControlModifier | Qt::ShiftModifier);
    EXPECT_EQ(area().open_views().size(), 1u);
    QTest::keyClick(&window, Qt::Key_W, Qt::ControlModifier | Qt::ShiftModifier);
    EXPECT_EQ(area().open_views().size(), 1u);
}

TEST_F(ViewsTest, ViewsAreNumberedAsOneReads) {
    window.resize(1280, 770);
    const auto number = [&](int view) { return area().dock(view)->windowTitle().left(1); };
    using Numbers = std::vector<std::pair<int, const char*>>;
    const auto have = [&](const Numbers& numbers) {
        return std::all_of(numbers.begin(), numbers.end(), [&](const auto& each) {
            return number(each.first) == QLatin1String(each.second);
        });
    };
    const auto are_numbered = [&](const Numbers& numbers) {
        return QTest::qWaitFor([&] { return have(numbers); });
    };
    trigger("views-2-stacked");
    area().set_active(0);
    trigger("view-open");  // beside the upper one
    ASSERT_EQ(area().open_views().size(), 3u);
    ASSERT_GT(area().dock(2)->x(), area().dock(0)->x());
    EXPECT_TRUE(are_numbered({{0, "1"}, {2, "2"}, {1, "3"}}));
    ASSERT_EQ(area().active(), 2);
    for (const int next : {1, 0, 2}) {
        trigger("view-next");
        EXPECT_EQ(area().active(), next) << "in the order of their numbers";
    }
    area().set_active(0);
    trigger("view-close");
    EXPECT_TRUE(are_numbered({{2, "1"}, {1, "2"}}));
    area().set_active(2);
    trigger("views-1");
    EXPECT_TRUE(are_numbered({{2, "1"}}));
    EXPECT_EQ(area().open_views(), std::vector{2});
    // Behind a tab a view is open, too.
    trigger("view-open");
    area().tabifyDockWidget(area().dock(2), area().dock(0));
    EXPECT_TRUE(QTest::qWaitFor([&] { return have({{2, "1"}, {0, "2"}}) || have({{0, "1"}, {2, "2"}}); }));
}

TEST_F(ViewsTest, AnyOutputOfAnyExperimentIsShownInAnyView) {
    add_second_experiment(0.75);
    trigger("views-2");
    area().set_active(1);
    choose(header("owner-a"), QString::fromStdString(window.session().document().experiments[1].name));
    EXPECT_FLOAT_EQ(window.view().image().at(0, 0), 0.75f);
    choose(header("output-a"), "Depth");
    EXPECT_EQ(window.view().picture()->semantic, Semantic::depth);
    area().set_active(0);
    EXPECT_FLOAT_EQ(window.view().image().at(0, 0), 0.25f);
    EXPECT_EQ(window.view().picture()->semantic, Semantic::radiance);
    // One execution an experiment, however many views show it.
    std::set<std::string> tags;
    for (const auto& each : renderer.requests) tags.insert(each.tag);
    EXPECT_EQ(tags.size(), 2u);
}

TEST_F(ViewsTest, AnExperimentThatNobodyLooksAtIsReleased) {
    add_second_experiment(0.75);
    const auto second = window.session().document().experiments[1].id;
    trigger("views-2");
    area().set_active(1);
    views().show_owner(second);
    ASSERT_TRUE(settle());
    renderer.releases.clear();
    trigger("views-1");
    // The view that one works with stays; nobody shows the first experiment any more.
    const auto first = window.session().document().experiments[0].id;
    EXPECT_EQ(std::count(renderer.releases.begin(), renderer.releases.end(), first), 1);
    EXPECT_EQ(std::count(renderer.releases.begin(), renderer.releases.end(), second), 0);
}

TEST_F(ViewsTest, TheActiveViewSaysWhichExperimentIsWorkedOn) {
    add_second_experiment(0.75);
    const auto& experiments = window.session().document().experiments;
    trigger("views-2");
    area().set_active(1);
    views().show_owner(experiments[1].id);
    ASSERT_TRUE(settle());
    EXPECT_EQ(window.session().experiment()->id, experiments[1].id);
    QTest::keyClick(&window, Qt::Key_F6);
    EXPECT_EQ(area().active(), 0);
    EXPECT_EQ(window.session().experiment()->id, experiments[0].id);
}

TEST_F(ViewsTest, PyramidsAndStacksShowOnePartOrAllAtOnce) {
    choose(header("output-a"), "Levels");
    EXPECT_FLOAT_EQ(window.view().image().at(0, 0), 0);
    const int width = window.view().image().width;
    choose(header("part-a"), "Level 2");
    EXPECT_FLOAT_EQ(window.view().image().at(0, 0), 2);
    EXPECT_EQ(window.view().image().width, width / 4);
    choose(header("part-a"), "All levels");
    EXPECT_GT(window.view().image().width, width);
    EXPECT_EQ(window.view().picture()->atlas.tiles.size(), std::size_t(fake_levels));
    choose(header("output-a"), "Slices");
    choose(header("part-a"), "Slice 3");
    EXPECT_FLOAT_EQ(window.view().image().at(0, 0), 3);
    choose(header("part-a"), "All slices");
    EXPECT_EQ(window.view().picture()->atlas.tiles.size(), std::size_t(fake_slices));
}

TEST_F(ViewsTest, OutputsAreSearchedByWordsAndHaveIconsByKind) {
    auto* combo = header("output-a");
    const auto icon_of = [&](const char* label) {
        return combo->itemIcon(combo->findText(label)).pixmap(16).toImage();
    };
    EXPECT_EQ(icon_of("Picture"), icon_of("Depth"));
    EXPECT_NE(icon_of("Picture"), icon_of("Cloud"));
    EXPECT_NE(icon_of("Picture"), icon_of("Levels"));
    EXPECT_NE(icon_of("Levels"), icon_of("Slices"));
    EXPECT_NE(icon_of("Cloud"), icon_of("Numbers"));
    auto* line = combo->findChild<QLineEdit*>();
    auto* list = combo->findChild<QListView*>();
    const auto shown = [&] {
        QStringList names;
        for (int i = 0; i < combo->count(); ++i)
            if (!list->isRowHidden(i) && list->model()->index(i, 0).flags().testFlag(Qt::ItemIsEnabled))
                names << combo->itemText(i);
        return names;
    };
    QTest::mouseClick(combo, Qt::LeftButton);
    ASSERT_TRUE(QTest::qWaitForWindowExposed(line->window()));
    EXPECT_EQ(list->currentIndex().data().toString(), "Picture") << "what is shown";
    const auto all = shown().size();
    EXPECT_GT(all, 5);
    QTest::keyClicks(line, "PT dep");
    EXPECT_EQ(shown(), QStringList("Depth"));
    QTest::keyClick(line, Qt::Key_Return);
    EXPECT_FALSE(line->isVisible());
    ASSERT_TRUE(settle());
    EXPECT_EQ(views().shown_key(), "depth");
    combo->showPopup();
    EXPECT_EQ(shown().size(), all) << "the words are gone";
    QTest::keyClicks(line, "l");
    const auto found = shown();
    ASSERT_GT(found.size(), 2);
    QTest::keyClick(line, Qt::Key_Down);
    EXPECT_EQ(list->currentIndex().data().toString(), found[1]);
    QTest::keyClick(line, Qt::Key_Escape);
    EXPECT_FALSE(line->isVisible());
    EXPECT_EQ(views().shown_key(), "depth") << "nothing was chosen";
    combo->showPopup();
    QTest::keyClicks(line, "xyzzy");
    QTest::keyClick(line, Qt::Key_Return);
    EXPECT_TRUE(line->isVisible()) << "nothing fits, nothing is chosen";
    const auto cloud = list->model()->index(combo->findText("Cloud"), 0);
    line->clear();
    QTest::mouseClick(list->viewport(), Qt::LeftButton, {}, list->visualRect(cloud).center());
    ASSERT_TRUE(settle());
    EXPECT_EQ(views().shown_key(), "cloud");
}

TEST_F(ViewsTest, ABufferThatIsPointedAtInAListShowsItsPicture) {
    std::vector<std::string> asked;
    workspace().set_thumbnails([&](const widgets::ViewSource& source) {
        asked.push_back(source.output);
        QImage picture(8, 6, QImage::Format_RGB32);
        picture.fill(Qt::red);
        return source.output == "depth" ? picture : QImage();
    });
    auto* combo = header("output-a");
    combo->showPopup();
    auto* list = combo->findChild<QListView*>();
    const auto tip = [&](const char* label) {
        const auto at = list->visualRect(list->model()->index(combo->findText(label), 0)).center();
        QHelpEvent event(QEvent::ToolTip, at, list->viewport()->mapToGlobal(at));
        QApplication::sendEvent(list->viewport(), &event);
        return QToolTip::text();
    };
    EXPECT_TRUE(asked.empty()) << "only what is pointed at";
    EXPECT_TRUE(tip("Depth").startsWith("<img")) << QToolTip::text().toStdString();
    EXPECT_FALSE(tip("Levels").contains("<img"));
    EXPECT_TRUE(QToolTip::text().contains("levels"));
    combo->hidePopup();
}

TEST_F(ViewsTest, FurtherPicturesOfARowAreSearchedAndTickedInSuchAList) {
    add_second_experiment(0.75);
    trigger("mode-flip");
    auto& button = *workspace().active_pane().header().findChild<widgets::SearchButton*>("pictures");
    auto* line = button.findChild<QLineEdit*>();
    auto* list = button.findChild<QListView*>();
    const auto row_of = [&](const QString& label) {
        for (int i = 0; i < list->model()->rowCount(); ++i)
            if (const auto row = list->model()->index(i, 0); row.data().toString() == label) return row;
        return QModelIndex();
    };
    const auto is_ticked = [&](const char* label) {
        return row_of(label).data(Qt::CheckStateRole).toInt() == Qt::Checked;
    };
    const auto further = [&] {
        QStringList keys;
        for (const auto& source : views().active_state().more) keys << QString::fromStdString(source.output);
        return keys;
    };
    QTest::mouseClick(&button, Qt::LeftButton);
    ASSERT_TRUE(QTest::qWaitForWindowExposed(line->window()));
    EXPECT_FALSE(row_of("Depth").data(Qt::DecorationRole).isNull());
    EXPECT_FALSE(row_of("Depth").data(Qt::ToolTipRole).toString().isEmpty());
    EXPECT_TRUE(row_of("Other experiments, images and results").isValid());
    QTest::keyClicks(line, "dep");
    QTest::keyClick(line, Qt::Key_Return);
    ASSERT_TRUE(settle());
    EXPECT_EQ(further(), QStringList("depth"));
    EXPECT_TRUE(line->isVisible()) << "several may be chosen";
    EXPECT_TRUE(is_ticked("Depth"));
    EXPECT_TRUE(button.text().contains("3")) << button.text().toStdString();
    QTest::mouseClick(list->viewport(), Qt::LeftButton, {}, list->visualRect(row_of("Depth")).center());
    ASSERT_TRUE(settle());
    EXPECT_TRUE(further().isEmpty());
    EXPECT_FALSE(is_ticked("Depth"));
    QTest::keyClick(line, Qt::Key_Escape);
    EXPECT_FALSE(line->isVisible());
}

TEST_F(ViewsTest, EachKindOfOutputHasItsViewer) {
    const std::pair<const char*, ViewPane::Content> viewers[] = {{"Picture", ViewPane::Content::picture},
                                                                 {"Levels", ViewPane::Content::picture},
                                                                 {"Cloud", ViewPane::Content::space},
                                                                 {"Ball", ViewPane::Content::space},
                                                                 {"Numbers", ViewPane::Content::table}};
    for (const auto& [label, content] : viewers) {
        choose(header("output-a"), label);
        EXPECT_EQ(workspace().active_pane().content(), content) << label;
    }
}

TEST_F(ViewsTest, ABufferInSpaceIsDrawnAndCanBeReadAsATable) {
    choose(header("output-a"), "Cloud");
    ASSERT_TRUE(QTest::qWaitFor([&] { return !renderer.views.empty(); }, 60000));
    const auto& view = renderer.views.back();
    ASSERT_EQ(view.view.layers.size(), 1u);
    EXPECT_EQ(view.view.layers[0].key, "cloud");
    EXPECT_EQ(view.view.layers[0].colour_by, "layer");
    EXPECT_EQ(view.execution, window.session().experiment()->id);
    EXPECT_NE(std::find(request().kept.begin(), request().kept.end(), "cloud"), request().kept.end());
    auto& space = workspace().active_pane().space().view();
    ASSERT_TRUE(QTest::qWaitFor([&] { return !space.picture().colour.empty(); }, 60000));
    auto* table = workspace().active_pane().header().findChild<QToolButton*>("table");
    ASSERT_TRUE(table->isVisible());
    QTest::mouseClick(table, Qt::LeftButton);
    ASSERT_TRUE(settle());
    ASSERT_EQ(workspace().active_pane().content(), ViewPane::Content::table);
    auto& model = workspace().active_pane().table().model();
    EXPECT_EQ(model.rowCount({}), fake_elements);
    EXPECT_EQ(model.index(4, 1).data().toString(), "4");
}

TEST_F(ViewsTest, AFreeCameraAsksForAPictureAndRendersNothingAgain) {
    choose(header("output-a"), "Cloud");
    auto& space = workspace().active_pane().space().view();
    ASSERT_TRUE(QTest::qWaitFor([&] { return !space.picture().colour.empty(); }, 60000));
    const auto requests = renderer.requests.size();
    const auto views = renderer.views.size();
    const QPoint middle = space.picture_area().center();
    QTest::mousePress(&space, Qt::LeftButton, {}, middle);
    QTest::mouseMove(&space, middle + QPoint(30, 10));
    QTest::mouseRelease(&space, Qt::LeftButton, {}, middle + QPoint(30, 10));
    ASSERT_TRUE(QTest::qWaitFor([&] { return renderer.views.size() > views; }, 60000));
    EXPECT_TRUE(renderer.views.back().view.camera.has_value());
    EXPECT_EQ(renderer.requests.size(), requests);
}

TEST_F(ViewsTest, AClickOnTheSphereChoosesTheItemThatTheRegionStandsFor) {
    choose(header("output-a"), "Ball");
    auto& space = workspace().active_pane().space().view();
    ASSERT_TRUE(QTest::qWaitFor([&] { return !space.picture().colour.empty(); }, 60000));
    const QRect area = space.picture_area();
    QTest::mouseClick(&space, Qt::LeftButton, {}, QPoint(area.left() + area.width() / 4, area.center().y()));
    ASSERT_TRUE(settle());
    const auto id = window.session().experiment()->id;
    EXPECT_EQ(views().inspection(id).item("item"), 2);
    EXPECT_EQ(request().inspection.item("item"), 2);
}

TEST_F(ViewsTest, UndockedAndRedockedEveryViewKeepsItsPicture) {
    trigger("views-2");
    for (const int number : area().open_views()) {
        auto* dock = area().dock(number);
        auto& view = workspace().pane(number)->compare().main_view();
        const Image before = view.image();
        ASSERT_FALSE(before.empty());
        const auto middle = [&] {
            QApplication::processEvents();
            const QImage seen = view.grab().toImage();
            return seen.pixelColor(seen.width() / 2, seen.height() / 2);
        };
        const QColor docked = middle();
        EXPECT_NE(docked, widgets::surround_colour);
        dock->setFloating(true);
        ASSERT_TRUE(QTest::qWaitForWindowExposed(dock));
        EXPECT_EQ(middle(), docked) << number;
        dock->setFloating(false);
        test::handle_events();
        EXPECT_EQ(middle(), docked) << number;
        EXPECT_EQ(view.image().pixels, before.pixels);
    }
}

TEST_F(ViewsTest, WhatViewsShowIsRememberedWithTheProject) {
    const QTemporaryDir folder;
    add_second_experiment(0.75);
    trigger("views-2");
    area().set_active(1);
    views().show_owner(window.session().document().experiments[1].id);
    views().show_output("depth");
    views().set_mode(ViewMode::difference);
    ASSERT_TRUE(settle());
    auto display = workspace().display();
    display.low = -2;
    display.high = 2;
    views().choose_display(display);
    const auto shown = views().active_state();
    window.session().files().save_as((folder.path() + "/kept.interreflect").toStdString());
    QTest::keyClick(&window, Qt::Key_S, Qt::ControlModifier);
    trigger("close");
    ASSERT_TRUE(window.open_path(folder.path() + "/kept.interreflect"));
    ASSERT_TRUE(settle());
    EXPECT_EQ(area().open_views().size(), 2u);
    EXPECT_EQ(area().active(), 1);
    EXPECT_EQ(views().active_state(), shown);
    EXPECT_EQ(workspace().display().low, -2);
}

TEST_F(ViewsTest, WhatWasClosedStaysClosedInEveryProject) {
    const QTemporaryDir folder;
    const auto path = [&](const char* name) { return folder.path() + "/" + name + ".interreflect"; };
    trigger("views-4");
    area().set_active(2);
    window.session().files().save_as(path("four").toStdString());
    open_scene();
    ASSERT_EQ(area().open_views().size(), 1u);
    window.session().files().save_as(path("one").toStdString());
    // From four views that are open, and from a window that is new.
    ASSERT_TRUE(window.open_path(path("four")));
    ASSERT_EQ(area().open_views().size(), 4u);
    ASSERT_TRUE(window.open_path(path("one")));
    ASSERT_TRUE(settle());
    EXPECT_EQ(area().open_views().size(), 1u);
    window.session().files().close();
    FakeRenderer fresh_renderer;
    MainWindow fresh(fresh_renderer, fake_registry(), {.remember = false, .surface = painted});
    fresh.show();
    ASSERT_TRUE(fresh.open_path(path("one")));
    EXPECT_EQ(fresh.workspace().area().open_views().size(), 1u);
    fresh.session().files().close();
}

TEST_F(ViewsTest, UndoingAnAddedExperimentShowsWhatWasShownBefore) {
    add_second_experiment(0.75);
    const auto second = window.session().document().experiments[1].id;
    window.session().select_experiment(second);
    ASSERT_TRUE(settle());
    choose(header("output-a"), "Depth");
    trigger("experiment-add");
    ASSERT_NE(views().active_state().a.owner, second);
    trigger("buffer-main");
    trigger("undo");
    EXPECT_EQ(views().active_state().a.owner, second);
    EXPECT_EQ(views().shown_key(), "depth");
    EXPECT_EQ(window.session().experiment()->id, second);
}

TEST_F(WindowTest, BuffersBeginWithResultsAndGoIntoViewsByMenuAndHand) {
    open_scene();
    window.docks().raise("buffers");
    ASSERT_TRUE(settle());
    auto* list = window.findChild<QDockWidget*>("buffers")->findChild<QTreeView*>();
    EXPECT_EQ(list->model()->index(0, 0).data().toString(), "Results");
    auto& rows = *qobject_cast<widgets::RowsModel*>(list->model());
    const auto menu = [&](const char* name) {
        for (auto* action : list->actions())
            if (action->objectName() == name) return action;
        return static_cast<QAction*>(nullptr);
    };
    list->setCurrentIndex(rows.index(0, 0));
    EXPECT_FALSE(menu("buffer-show")->isEnabled()) << "a heading";
    // What is done with pixels of pictures.
    ASSERT_TRUE(menu("pin") && menu("explain"));
    menu("pin")->trigger();
    EXPECT_TRUE(window.inspector().pins().empty());
    EXPECT_NE(label("state").find("Mark a pixel first"), std::string::npos) << label("state");
    QTest::mouseClick(&window.view(), Qt::LeftButton, {}, window.view().rect().center());
    ASSERT_TRUE(settle());
    menu("pin")->trigger();
    ASSERT_EQ(window.inspector().pins().size(), 1u);
    menu("explain")->trigger();
    ASSERT_TRUE(settle());
    EXPECT_EQ(window.inspector().explained(), window.inspector().pins().front());
    trigger("views-1");
    window.views().show_output("");
    ASSERT_TRUE(settle());
    const auto depth = rows.index_of("depth");
    ASSERT_TRUE(depth.isValid());
    list->setCurrentIndex(depth);
    const auto before = window.views().active_state();
    menu("buffer-beside")->trigger();
    ASSERT_TRUE(settle());
    ASSERT_EQ(window.workspace().area().open_views().size(), 2u);
    EXPECT_EQ(window.views().active_state(), before);
    EXPECT_EQ(window.views().state(1).a.output, "depth");
    menu("buffer-compare")->trigger();
    ASSERT_TRUE(settle());
    EXPECT_EQ(window.views().active_state().mode, widgets::ViewMode::side_by_side);
    EXPECT_EQ(window.views().active_state().b.output, "depth");
    // By hand.
    window.views().set_active_state(before);
    ASSERT_TRUE(settle());
    const std::unique_ptr<QMimeData> data(rows.mimeData({depth}));
    auto* pane = window.workspace().pane(0);
    QDragEnterEvent enter(QPoint(20, 60), Qt::CopyAction, data.get(), Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(pane, &enter);
    EXPECT_TRUE(enter.isAccepted());
    QDropEvent drop(QPointF(20, 60), Qt::CopyAction, data.get(), Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(pane, &drop);
    ASSERT_TRUE(settle());
    EXPECT_EQ(window.views().state(0).a.output, "depth");
    emit pane->buffer_dropped("pass:shade");
    EXPECT_EQ(window.views().state(0).a.output, "depth") << "a heading is no buffer";
}

}  // namespace
}  // namespace ir::gui
