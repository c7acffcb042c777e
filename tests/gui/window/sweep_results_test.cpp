// What a sweep has rendered, in the window: sheet, table, plots, reports; results of other times and folders.
#include <QAction>
#include <QComboBox>
#include <QHeaderView>
#include <QLabel>
#include <QMenu>
#include <QTabBar>
#include <QTimer>
#include <fstream>
#include <iterator>

#include "app/engine/sweep_job.h"
#include "app/gui/sweep_rows.h"
#include "tests/gui/window/sweeps_fixture.h"

namespace ir::gui {
namespace {

namespace edits = projects::edits;
namespace fs = std::filesystem;

TEST_F(SweepsWindowTest, TheOrderIsOneInSheetAndTable) {
    save();
    add_sweep({2, 4, 1});
    run_to_end();
    panel().set_tab(widgets::SweepPanel::table_tab);
    auto& header = *panel().table().header();
    const int rmse = column("RMSE");
    QTest::mouseClick(header.viewport(), Qt::LeftButton, {},
                      {header.sectionViewportPosition(rmse) + 10, header.height() / 2});
    panel().set_tab(widgets::SweepPanel::sheet_tab);
    EXPECT_EQ(find<QComboBox>("sorting")->currentText(), "RMSE");
    EXPECT_EQ(cell(0, column("level")), "4");
    press("descending");
    EXPECT_EQ(cell(0, column("level")), "1");
    click_cell(0);
    EXPECT_EQ(level_now(), 1);
    auto* sorting = find<QComboBox>("sorting");
    choose(sorting, "Sweep's order");
    press("descending");
    EXPECT_EQ(cell(0, column("level")), "2");
}

TEST_F(SweepsWindowTest, ColumnsAreChosenAndRemembered) {
    save();
    add_sweep();
    run_to_end();
    panel().set_tab(widgets::SweepPanel::table_tab);
    auto& table = panel().table();
    EXPECT_FALSE(table.isColumnHidden(column("seed")));
    auto* button = find<QToolButton>("columns");
    QTimer::singleShot(0, button, [button] {
        for (auto* action : button->menu()->actions())
            if (action->text() == "seed") action->trigger();
        button->menu()->close();
    });
    QTest::mouseClick(button, Qt::LeftButton);
    EXPECT_TRUE(QTest::qWaitFor([&] { return table.isColumnHidden(column("seed")); }, 60000));
    EXPECT_FALSE(table.isColumnHidden(column("level")));
    projects::Json memory;
    dock().save(memory);
    panel().hide_columns({});
    EXPECT_FALSE(table.isColumnHidden(column("seed")));
    dock().load(memory);
    ASSERT_TRUE(QTest::qWaitFor([&] { return table.isColumnHidden(column("seed")); }, 60000));
    dock().load(projects::Json::parse(R"({"sweeps": {"hidden": [3, {"a": 1}]}})"));
    EXPECT_TRUE(QTest::qWaitFor([&] { return !table.isColumnHidden(column("seed")); }, 60000));
}

TEST_F(SweepsWindowTest, PlotsAreDrawnAndTheirPointsLoad) {
    save();
    add_sweep();
    run_to_end();
    QTest::mouseClick(find<QTabBar>("tabs"), Qt::LeftButton, {},
                      find<QTabBar>("tabs")->tabRect(widgets::SweepPanel::plot_tab).center());
    EXPECT_EQ(panel().plot().data().count(), 6u);
    choose(find<QComboBox>("plot"), QStringLiteral("level × seed"));
    const auto& data = panel().plot().data();
    ASSERT_TRUE(data.heat);
    ASSERT_EQ(data.count(), 6u);
    const auto id = data.series[1].points[1].id;  // seed 2, level 2
    panel().plot().repaint();
    const auto place = panel().plot().position_of(QString::fromStdString(id));
    // A tile is clicked anywhere in it.
    QTest::mouseClick(&panel().plot(), Qt::LeftButton, {}, (place + QPointF(14, 9)).toPoint());
    ASSERT_TRUE(settle());
    EXPECT_EQ(level_now(), 2);
    EXPECT_EQ(window.session().experiment()->seed, 2u);
}

TEST_F(SweepsWindowTest, ResultsAreThereAgainAndThoseOfOtherFoldersOpen) {
    save();
    add_sweep({4, 2, 9});
    run_to_end();
    EXPECT_EQ(count_done(), 4);
    EXPECT_TRUE(find<QLabel>("foot")->text().contains("2 failed"));
    EXPECT_TRUE(panel().model().line(5).problem.contains("out of beads"));
    panel().sort_by(QStringLiteral("RMSE"), true);
    panel().set_tab(widgets::SweepPanel::table_tab);
    window.session().files().save();
    window.session().files().close();
    ASSERT_TRUE(settle());
    ASSERT_TRUE(window.open_path(QString::fromStdString(project_file())));
    ASSERT_TRUE(QTest::qWaitFor([&] { return panel().model().rowCount() == 6 && count_done() == 4; }, 60000));
    ASSERT_TRUE(settle());
    EXPECT_EQ(panel().tab(), widgets::SweepPanel::table_tab);
    EXPECT_EQ(panel().sorted_by(), "RMSE");
    EXPECT_EQ(cell(0, column("level")), "2");
    // What depends on more than the axes is another picture now.
    window.session().edit([&](const projects::Project& p) {
        return edits::set_size(p, sweep().experiment, {32, 24});
    });
    ASSERT_TRUE(settle());
    EXPECT_TRUE(find<QLabel>("foot")->text().contains("4 stale")) << label("foot");

    // As the command line leaves them anywhere.
    const fs::path other = folder.path().toStdString() + "/elsewhere";
    engine::SweepTable table{sweep().id, sweep().experiment, "plan"};
    engine::SweepJob job;
    job.project = window.session().document();
    job.folder = project_file();
    job.sweep = sweep();
    job.out = other;
    fs::create_directories(other);
    for (const auto& point : projects::sweep_points(job.project, job.sweep, fake_registry())) {
        table.rows.push_back(FakeSweeps::planned(job, point));
        FakeSweeps::render(job, table.rows.back());
    }
    write_file(job.list(), engine::table_json(table));
    dock().open_folder(other);
    ASSERT_TRUE(settle());
    EXPECT_EQ(count_done(), 4);
    EXPECT_TRUE(find<QLabel>("foot")->text().contains("elsewhere"));
    EXPECT_FALSE(find<QToolButton>("run")->isEnabled()) << "a run writes into the project";
    EXPECT_TRUE(find<QToolButton>("run")->toolTip().contains("in another folder"));
    dock().run();
    EXPECT_EQ(fake.runs, 1);
    // A list that anybody wrote shows no other files.
    EXPECT_EQ(panel().model().line(0).picture,
              QString::fromStdString((other / table.rows[0].image).string()));
    table.rows[0].image = "/elsewhere/private.exr";
    write_file(job.list(), engine::table_json(table));
    dock().look();
    ASSERT_TRUE(settle());
    EXPECT_EQ(panel().model().line(0).picture, "");
    table.sweep = "another";
    write_file(job.list(), engine::table_json(table));
    dock().look();
    ASSERT_TRUE(settle());
    EXPECT_EQ(panel().model().rowCount(), 6) << "it is shown as it is";
    EXPECT_FALSE(find<QToolButton>("run")->isEnabled());
    EXPECT_TRUE(find<QLabel>("foot")->text().contains("of the sweep another"));
    panel().findChild<QAction*>("own-folder")->trigger();
    ASSERT_TRUE(settle());
    EXPECT_TRUE(find<QToolButton>("run")->isEnabled());
    EXPECT_FALSE(find<QLabel>("foot")->text().contains("elsewhere"));

    dock().write_csv(folder.filePath("t.csv"));
    std::ifstream csv(folder.filePath("t.csv").toStdString());
    std::string line;
    std::getline(csv, line);
    EXPECT_TRUE(line.starts_with("id,level,seed,")) << line;
    for (const char* odd : {R"({"sweeps": 3})", R"({"sweeps": {"chosen": 1, "tab": 99, "folders": [1]}})"})
        dock().load(projects::Json::parse(odd));
    ASSERT_TRUE(settle());
}

TEST_F(SweepsWindowTest, AnotherWindowOpensAtTheSamePlot) {
    save();
    add_sweep();
    run_to_end();
    panel().set_tab(widgets::SweepPanel::plot_tab);
    window.session().files().save();
    window.session().files().close();
    FakeRenderer other_renderer;
    MainWindow other{other_renderer, fake_registry(), {.remember = false, .surface = painted}};
    other.show();
    other.docks().apply("sweeps");
    ASSERT_TRUE(other.open_path(QString::fromStdString(project_file())));
    auto& plot = other.findChild<SweepsDock*>()->panel().plot();
    EXPECT_TRUE(QTest::qWaitFor([&] { return plot.data().count() == 6; }, 60000));
    EXPECT_EQ(other.findChild<SweepsDock*>()->panel().tab(), widgets::SweepPanel::plot_tab);
    other.session().files().close();
}

TEST_F(SweepsWindowTest, AReportIsWrittenOfWhatIsShown) {
    save();
    add_sweep();
    EXPECT_FALSE(panel().findChild<QAction*>("report")->isEnabled());
    run_to_end();
    EXPECT_TRUE(panel().findChild<QAction*>("report")->isEnabled());
    const auto file = folder.filePath("r.html").toStdString();
    const auto out = fs::path(project_file()) / "results" / projects::sweep_path(sweep().id);
    ReportController::of_sweep(out)(file, {nullptr, [](const std::string&, double) {}});
    std::ifstream stream(file);
    const std::string page(std::istreambuf_iterator<char>(stream), {});
    EXPECT_NE(page.find("level = 4, seed = 2"), std::string::npos);
    EXPECT_NE(page.find("over level and seed"), std::string::npos) << "the heat map";
}

TEST(SweepRows, APictureElsewhereIsNotShownAndSaidSo) {
    engine::SweepSheet sheet;
    engine::SweepRow row;
    row.problem.clear();
    row.image = "/etc/picture.exr";
    sheet.table.rows = {row};
    const auto line = sweep_line(sheet, {}, 0, fs::temp_directory_path(), false);
    EXPECT_TRUE(line.picture.isEmpty());
    EXPECT_TRUE(line.problem.contains("elsewhere")) << line.problem.toStdString();
    EXPECT_EQ(line.state, widgets::SweepLine::State::done);
    sheet.table.rows[0].image.clear();
    EXPECT_TRUE(sweep_line(sheet, {}, 0, fs::temp_directory_path(), false).problem.isEmpty())
        << "none was kept";
}

}  // namespace
}  // namespace ir::gui
