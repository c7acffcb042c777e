// Sweeps in the window: run, pause, resume, cancel.
#include <QLabel>
#include <QPushButton>
#include <QSignalSpy>

#include "app/engine/execution.h"
#include "projects/document_json.h"
#include "tests/gui/window/sweeps_fixture.h"

namespace ir::gui {
namespace {

namespace edits = projects::edits;
namespace fs = std::filesystem;

TEST_F(SweepsWindowTest, AnEmptyDockOffersASweepAndSaysWhatRunningNeeds) {
    auto* button = find<QPushButton>("empty-button");
    ASSERT_TRUE(button->isVisible());
    QTest::mouseClick(button, Qt::LeftButton);
    ASSERT_TRUE(settle());
    ASSERT_EQ(window.session().document().sweeps.size(), 1u);
    EXPECT_EQ(sweep().experiment, window.session().experiment()->id);
    window.docks().raise("sweeps");
    ASSERT_TRUE(settle());
    EXPECT_FALSE(find<QToolButton>("run")->isEnabled());
    EXPECT_TRUE(find<QToolButton>("run")->toolTip().contains("Save the project first"));
    save();
    EXPECT_TRUE(find<QToolButton>("run")->isEnabled()) << find<QToolButton>("run")->toolTip().toStdString();
    trigger("undo");
    EXPECT_TRUE(button->isVisible());
    EXPECT_EQ(fake.runs, 0);
}

TEST_F(SweepsWindowTest, ASweepThatCannotRunSaysWhy) {
    add_sweep({99.0});  // beyond the range
    ASSERT_TRUE(QTest::qWaitFor(
        [this] {
            const auto* empty = find<QLabel>("empty");
            return empty->isVisible() && empty->text().contains("level");
        },
        60000));
}

TEST_F(SweepsWindowTest, TheGridIsThereBeforeItRunsAndRowsAppearAsTheyEnd) {
    save();
    add_sweep();
    ASSERT_EQ(panel().model().rowCount(), 6);
    EXPECT_EQ(cell(2, 1), "2");
    EXPECT_EQ(count_done(), 0);
    fake.allowed = 2;
    press("run");
    ASSERT_TRUE(QTest::qWaitFor([&] { return count_done() == 2; }, 60000));
    EXPECT_TRUE(QTest::qWaitFor([&] { return find<QLabel>("doing")->text().startsWith("3 of 6"); }, 60000))
        << find<QLabel>("doing")->text().toStdString();
    EXPECT_EQ(panel().model().line(2).state, widgets::SweepLine::State::running);
    EXPECT_FALSE(window.is_settled());
    fake.allowed = 1000;
    ASSERT_TRUE(finish());
    EXPECT_EQ(count_done(), 6);
    EXPECT_EQ(cell(0, column("RMSE")), "0.25");
    EXPECT_TRUE(find<QLabel>("foot")->text().contains("6 of 6"));
    ASSERT_TRUE(QTest::qWaitFor([&] { return sheet().pictures().read_count() >= 1 && finish(); }, 60000));
}

TEST_F(SweepsWindowTest, PausesBetweenVariationsGoesOnAndCancels) {
    save();
    add_sweep();
    fake.allowed = 1;
    press("run");
    ASSERT_TRUE(QTest::qWaitFor(
        [&] { return panel().model().line(1).state == widgets::SweepLine::State::running; }, 60000));
    press("pause");
    EXPECT_EQ(find<QToolButton>("pause")->text(), "Resume");
    EXPECT_TRUE(find<QLabel>("doing")->text().startsWith("Pauses after"));
    fake.allowed = 1000;
    ASSERT_TRUE(QTest::qWaitFor([&] { return find<QLabel>("doing")->text() == "Paused"; }, 60000));
    EXPECT_EQ(fake.rendered, 2) << "the one that was under way is whole";
    fake.allowed = 3;
    press("pause");
    ASSERT_TRUE(QTest::qWaitFor([&] { return count_done() == 3; }, 60000));
    sheet().setFocus();
    QTest::keyClick(&sheet(), Qt::Key_Escape);
    ASSERT_TRUE(finish());
    EXPECT_EQ(count_done(), 3);
    EXPECT_EQ(find<QToolButton>("run")->text(), "Run");
    fake.allowed = 1000;
    run_to_end();
    EXPECT_EQ(fake.runs, 2);
    EXPECT_EQ(fake.rendered, 6) << "three were there already";
    // Also a run that waits is cancelled.
    window.session().edit([&](const projects::Project& p) {
        auto changed = p.sweeps.front();
        changed.axes[0].values.push_back(8);
        return edits::change(p, changed);
    });
    ASSERT_TRUE(settle());
    EXPECT_EQ(count_done(), 6);
    fake.allowed = 6;
    press("run");
    ASSERT_TRUE(QTest::qWaitFor([&] { return fake.runs == 3; }, 60000));
    press("pause");
    fake.allowed = 1000;
    ASSERT_TRUE(QTest::qWaitFor([&] { return find<QLabel>("doing")->text() == "Paused"; }, 60000));
    press("run");
    ASSERT_TRUE(finish());
    EXPECT_LT(count_done(), 8);
}

TEST_F(SweepsWindowTest, AnotherSweepIsSeenWhileOneRuns) {
    save();
    add_sweep({4, 2, 9}, {1});
    dock().add_sweep();
    window.session().edit([&](const projects::Project& p) {
        auto changed = p.sweeps.back();
        changed.axes = {{"seed", {1, 2}}};
        return edits::change(p, changed);
    });
    window.docks().raise("sweeps");
    const auto first = sweep().id, second = window.session().document().sweeps.back().id;
    ASSERT_NE(first, second);
    dock().show_sweep(first);
    ASSERT_TRUE(settle());
    QSignalSpy said(&dock(), &SweepsDock::said);
    fake.allowed = 1;
    press("run");
    ASSERT_TRUE(QTest::qWaitFor([&] { return count_done() == 1; }, 60000));
    dock().show_sweep(second);
    ASSERT_TRUE(QTest::qWaitFor([&] { return panel().model().rowCount() == 2; }, 60000));
    fake.allowed = 2;
    EXPECT_TRUE(QTest::qWaitFor([&] { return find<QLabel>("doing")->text().startsWith("3 of 3"); }, 60000))
        << find<QLabel>("doing")->text().toStdString();
    EXPECT_EQ(count_done(), 0);
    dock().show_sweep(first);
    ASSERT_EQ(panel().model().rowCount(), 3);
    EXPECT_EQ(count_done(), 2) << "also what ended when it was not seen";
    EXPECT_EQ(panel().model().line(2).state, widgets::SweepLine::State::running);
    dock().show_sweep(second);
    fake.allowed = 1000;
    ASSERT_TRUE(finish());
    ASSERT_FALSE(said.isEmpty());
    EXPECT_EQ(said.last().at(0).toString(), "The sweep is through; 1 variation failed");
}

TEST_F(SweepsWindowTest, AClickLoadsTheSettingInOneStep) {
    save();
    add_sweep();
    run_to_end();
    const auto before = steps();
    const double level = level_now();
    click_cell(3);
    EXPECT_EQ(level_now(), 2);
    EXPECT_EQ(window.session().experiment()->seed, 2u);
    EXPECT_EQ(steps(), before + 1);
    EXPECT_EQ(count_done(), 6) << "the variations are what they were";
    EXPECT_EQ(panel().table().currentIndex().row(), 3) << "the selection is the table's, too";
    trigger("undo");
    EXPECT_EQ(level_now(), level);
    // More are chosen without loading.
    click_cell(0, Qt::ControlModifier);
    EXPECT_EQ(level_now(), level);
    EXPECT_EQ(panel().text().count('\n'), 2);
    // By keys alone.
    click_cell(0);
    sheet().setFocus();
    QTest::keyClick(&sheet(), Qt::Key_End);
    QTest::keyClick(&sheet(), Qt::Key_Return);
    EXPECT_EQ(level_now(), 1);
    panel().set_tab(widgets::SweepPanel::table_tab);
    panel().table().setFocus();
    QTest::keyClick(&panel().table(), Qt::Key_Up, Qt::ControlModifier);
    QTest::keyClick(&panel().table(), Qt::Key_Home);
    QTest::keyClick(&panel().table(), Qt::Key_Return);
    EXPECT_EQ(level_now(), 4);
}

TEST_F(SweepsWindowTest, AMenuOfAVariationLoadsIt) {
    save();
    add_sweep();
    run_to_end();
    const auto index = sheet().model()->index(3, 0);
    QTest::mousePress(sheet().viewport(), Qt::RightButton, {}, sheet().boxes(index).first.center());
    EXPECT_EQ(panel().table().currentIndex().row(), 3) << "what lies under the cursor";
    ASSERT_EQ(sheet().actions().first()->objectName(), "load");
    EXPECT_NE(level_now(), 2);
    sheet().actions().first()->trigger();
    ASSERT_TRUE(settle());
    EXPECT_EQ(level_now(), 2);
    EXPECT_TRUE(index.data(Qt::ToolTipRole).toString().contains("loads this setting"));
}

TEST_F(SweepsWindowTest, AParameterIsSweptInOneStep) {
    dock().add_sweep();
    window.docks().raise("sweeps");
    ASSERT_TRUE(settle());
    auto* text = panel().findChild<QLabel*>("empty");
    auto* button = panel().findChild<QPushButton*>("empty-button");
    EXPECT_TRUE(text->isVisible() && text->text().contains("varies nothing yet"))
        << text->text().toStdString();
    EXPECT_TRUE(text->text().contains("Save the project first"));
    EXPECT_EQ(button->text(), "Add a parameter …");
    auto before = steps();
    button->click();
    ASSERT_TRUE(settle());
    ASSERT_EQ(sweep().axes.size(), 1u);
    EXPECT_EQ(steps(), before + 1);
    EXPECT_EQ(window.document().editor().item().id.toStdString(), sweep().id) << "where its values are typed";
    trigger("undo");
    // From the parameter's own menu: of the shown sweep.
    auto* parameters = window.findChild<widgets::ParameterPanel*>();
    emit parameters->sweep_wanted("level");
    ASSERT_TRUE(settle());
    ASSERT_EQ(sweep().axes.size(), 1u);
    EXPECT_EQ(sweep().axes[0].key, "level");
    EXPECT_EQ(sweep().axes[0].values, (std::vector<projects::Json>{level_now()}));
    before = steps();
    emit parameters->sweep_wanted("level");
    ASSERT_TRUE(settle());
    EXPECT_EQ(steps(), before) << "it varies already";
    // Of another experiment: a new one.
    add_second_experiment(5);
    const auto second = window.session().document().experiments[1].id;
    window.session().select_experiment(second);
    ASSERT_TRUE(settle());
    before = steps();
    emit parameters->sweep_wanted("level");
    ASSERT_TRUE(settle());
    EXPECT_EQ(steps(), before + 1);
    ASSERT_EQ(window.session().document().sweeps.size(), 2u);
    EXPECT_EQ(window.session().document().sweeps[1].experiment, second);
    EXPECT_EQ(dock().chosen(), window.session().document().sweeps[1].id);
}

TEST_F(SweepsWindowTest, AnotherProjectEndsTheRun) {
    save();
    add_sweep();
    fake.allowed = 1;
    press("run");
    ASSERT_TRUE(QTest::qWaitFor([&] { return fake.rendered == 1; }, 60000));
    window.session().files().save();
    window.session().files().close();
    EXPECT_TRUE(finish()) << "nobody waits for beads";
    EXPECT_EQ(fake.rendered, 1);
}

/// The real thing, without a fake.
TEST(Sweeps, RunsOnAMachineOfItsOwn) {
    const projects::Json json = {
        {"schema", 6},
        {"name", "Small"},
        {"scenes", {{{"id", "box"}, {"parts", {{{"source", "builtin:cornell@1"}}}}}}},
        {"experiments", {{{"id", "a"}, {"scene", "box"}, {"method", "view-normals"}, {"size", {8, 6}}}}},
        {"sweeps", {{{"id", "s"}, {"experiment", "a"}, {"axes", {{{"key", "seed"}, {"values", {1, 2}}}}}}}}};
    QTemporaryDir folder;
    engine::SweepRequest request;
    request.job.project = projects::read_project(json.dump(), "test.json", engine::registry()).project;
    request.job.sweep = request.job.project.sweeps.front();
    request.job.out = folder.filePath("out").toStdString();
    SweepRuns runs({});
    int rows = 0;
    QString problem;
    QObject::connect(&runs, &SweepRuns::rows_arrived, &runs,
                     [&](const SweepRuns::Rows& arrived) { rows += int(arrived.size()); });
    QObject::connect(&runs, &SweepRuns::failed, &runs, [&](const QString& error, bool) { problem = error; });
    ASSERT_TRUE(runs.start(request));
    EXPECT_FALSE(runs.start(request));
    ASSERT_TRUE(QTest::qWaitFor([&] { return !runs.is_running(); }, 60000));
    EXPECT_EQ(problem, "");
    EXPECT_EQ(rows, 2);
    EXPECT_TRUE(fs::exists(request.job.out / "a-0002.exr"));
    EXPECT_TRUE(engine::read_tables(request.job.out).rows.at(1).is_done());
}

}  // namespace
}  // namespace ir::gui
