// Sweeps in the window: run, pause, resume, cancel; pictures beside each other; a click loads a setting.
#include <QAction>
#include <QCheckBox>
#include <QComboBox>
#include <QDockWidget>
#include <QLabel>
#include <QMenu>
#include <QPushButton>
#include <QSignalSpy>
#include <QTabBar>
#include <QTemporaryDir>
#include <QTimer>
#include <QToolButton>
#include <atomic>
#include <chrono>
#include <fstream>
#include <iterator>
#include <thread>

#include "projects/document_json.h"
#include "projects/results.h"
#include "projects/scene_files.h"
#include "renderers/core/error.h"
#include "renderers/core/write_file.h"
#include "tests/gui/window/window_fixture.h"
#include "widgets/panels/empty_tree_view.h"

namespace ir::gui {
namespace {

namespace edits = projects::edits;
namespace fs = std::filesystem;
using engine::SweepRow;

/// Renders as many variations as are let through: pictures of their level, whose error is the smaller the
/// higher it is. Like the real one it goes on with what is there.
struct FakeSweeps {
    std::atomic<int> allowed{1000}, runs{0}, rendered{0};

    void run(const engine::SweepRequest& request, const engine::SweepCallbacks& told) {
        ++runs;
        const auto& job = request.job;
        fs::create_directories(job.out / engine::references_folder);
        const auto points = projects::sweep_points(job.project, job.sweep, fake_registry());
        engine::SweepTable table{job.sweep.id, job.sweep.experiment, "plan"};
        for (const auto& point : points) table.rows.push_back(planned(job, point));
        const auto resumed = engine::resume_rows(table, job.out, job.repeats > 0, true);
        told.planned(table, resumed);
        const auto write = [&] { write_file(job.list(), engine::table_json(table)); };
        try {
            for (std::size_t i = 0; i < points.size(); ++i) {
                if (table.rows[i].is_done()) continue;
                told.begun(i, points[i]);
                while (rendered >= allowed) {
                    told.frame.progress("counting beads", 0.5);
                    told.frame.cancel->check();
                    std::this_thread::sleep_for(std::chrono::milliseconds(5));
                }
                render(job, table.rows[i]);
                told.ended(i, table.rows[i], false);
                ++rendered;
            }
        } catch (const Cancelled&) {
            write();
            throw;
        }
        write();
    }

    static SweepRow planned(const engine::SweepJob& job, const projects::SweepPoint& point) {
        SweepRow row;
        row.id = point.experiment.id;
        row.coordinates = point.coordinates;
        const auto now =
            projects::with_contents(job.project, projects::read_contents(job.project, job.folder));
        row.key = projects::result_key(now, point.experiment, fake_registry());
        if (job.is_judged) row.reference = "truth";
        return row;
    }
    static void render(const engine::SweepJob& job, SweepRow& row) {
        const double level = row.coordinates.value("level", 1.0);
        if (level > 8) {
            row.problem = "out of beads";
            return;
        }
        row.problem.clear();
        row.cold_ms = 10 * level;
        row.memory_bytes = 1 << 20;
        row.device = "abacus";
        row.build = "fake";
        row.image = row.id + ".exr";
        write(job.out / row.image, float(level));
        if (!job.is_judged) return;
        row.warm_ms = 5 * level;
        row.errors["rmse"] = 1 / level;
        row.pixels = 48;
        write(job.out / engine::references_folder / "truth.exr", 1);
    }
    static void write(const fs::path& file, float value) {
        Image image(8, 6, 3);
        for (auto& each : image.pixels) each = value;
        write_exr(file, {{"", standard_channels(3), image}}, {});
    }
};

class SweepsWindowTest : public WindowTest {
  protected:
    void SetUp() override {
        on_sweep = [this](const auto& request, const auto& told) { fake.run(request, told); };
        WindowTest::SetUp();
        open_scene();
        window.docks().apply("sweeps");
        ASSERT_TRUE(settle());
    }
    void TearDown() override {
        fake.allowed = 1 << 20;
        WindowTest::TearDown();
    }
    SweepsDock& dock() { return *window.findChild<SweepsDock*>(); }
    widgets::SweepPanel& panel() { return dock().panel(); }
    widgets::ContactSheet& sheet() { return panel().sheet(); }
    template <class Widget>
    Widget* find(const char* name) {
        return panel().findChild<Widget*>(QLatin1String(name));
    }
    void press(const char* name) { QTest::mouseClick(find<QToolButton>(name), Qt::LeftButton); }
    const projects::Sweep& sweep() { return window.session().document().sweeps.front(); }
    /// Of the chosen experiment over its level and seed.
    void add_sweep(std::vector<projects::Json> levels = {4, 2, 1},
                   std::vector<projects::Json> seeds = {1, 2}) {
        dock().add_sweep();
        window.session().edit([&](const projects::Project& p) {
            auto changed = p.sweeps.front();
            changed.axes = {{"level", levels}, {"seed", seeds}};
            return edits::change(p, changed);
        });
        ASSERT_TRUE(settle());
        window.docks().raise("sweeps");
    }
    void save() {
        window.session().files().save_as(project_file());
        ASSERT_TRUE(settle());
    }
    std::string project_file() { return folder.path().toStdString() + "/swept.interreflect"; }
    bool finish() {
        return QTest::qWaitFor([&] { return dock().is_settled(); }, 8000);
    }
    void run_to_end() {
        press("run");
        ASSERT_TRUE(finish());
    }
    QString cell(int row, int column) {
        return panel().table().model()->index(row, column).data().toString();
    }
    int column(const QString& heading) { return 1 + int(panel().model().rows().headings.indexOf(heading)); }
    /// Clicks a variation in the sheet, in the order shown.
    void click_cell(int row, Qt::KeyboardModifiers modifiers = {}) {
        const auto index = sheet().model()->index(row, 0);
        sheet().scrollTo(index);
        QApplication::processEvents();
        QTest::mouseClick(sheet().viewport(), Qt::LeftButton, modifiers, sheet().boxes(index).first.center());
        ASSERT_TRUE(settle());
    }
    double level_now() { return std::get<double>(window.session().experiment()->values.at("level")); }
    int count_done() {
        int done = 0;
        for (const auto& line : panel().model().rows().lines)
            done += line.state == widgets::SweepLine::State::done ? 1 : 0;
        return done;
    }

    QTemporaryDir folder;
    FakeSweeps fake;
};

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
        5000));
}

TEST_F(SweepsWindowTest, TheGridIsThereBeforeItRunsAndRowsAppearAsTheyEnd) {
    save();
    add_sweep();
    ASSERT_EQ(panel().model().rowCount(), 6);
    EXPECT_EQ(cell(2, 1), "2");
    EXPECT_EQ(count_done(), 0);
    fake.allowed = 2;
    press("run");
    ASSERT_TRUE(QTest::qWaitFor([&] { return count_done() == 2; }, 5000));
    EXPECT_TRUE(QTest::qWaitFor([&] { return find<QLabel>("doing")->text().startsWith("3 of 6"); }, 5000))
        << find<QLabel>("doing")->text().toStdString();
    EXPECT_EQ(panel().model().line(2).state, widgets::SweepLine::State::running);
    EXPECT_FALSE(window.is_settled());
    fake.allowed = 1000;
    ASSERT_TRUE(finish());
    EXPECT_EQ(count_done(), 6);
    EXPECT_EQ(cell(0, column("RMSE")), "0.25");
    EXPECT_TRUE(find<QLabel>("foot")->text().contains("6 of 6"));
    ASSERT_TRUE(QTest::qWaitFor([&] { return sheet().pictures().read_count() >= 1 && finish(); }, 5000));
}

TEST_F(SweepsWindowTest, PausesBetweenVariationsGoesOnAndCancels) {
    save();
    add_sweep();
    fake.allowed = 1;
    press("run");
    ASSERT_TRUE(QTest::qWaitFor(
        [&] { return panel().model().line(1).state == widgets::SweepLine::State::running; }, 5000));
    press("pause");
    EXPECT_EQ(find<QToolButton>("pause")->text(), "Resume");
    EXPECT_TRUE(find<QLabel>("doing")->text().startsWith("Pauses after"));
    fake.allowed = 1000;
    ASSERT_TRUE(QTest::qWaitFor([&] { return find<QLabel>("doing")->text() == "Paused"; }, 5000));
    EXPECT_EQ(fake.rendered, 2) << "the one that was under way is whole";
    fake.allowed = 3;
    press("pause");
    ASSERT_TRUE(QTest::qWaitFor([&] { return count_done() == 3; }, 5000));
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
    ASSERT_TRUE(QTest::qWaitFor([&] { return fake.runs == 3; }, 5000));
    press("pause");
    fake.allowed = 1000;
    ASSERT_TRUE(QTest::qWaitFor([&] { return find<QLabel>("doing")->text() == "Paused"; }, 5000));
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
    ASSERT_TRUE(QTest::qWaitFor([&] { return count_done() == 1; }, 5000));
    dock().show_sweep(second);
    ASSERT_TRUE(QTest::qWaitFor([&] { return panel().model().rowCount() == 2; }, 5000));
    fake.allowed = 2;
    EXPECT_TRUE(QTest::qWaitFor([&] { return find<QLabel>("doing")->text().startsWith("3 of 3"); }, 5000))
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
    EXPECT_EQ(said.last().at(0).toString(), "The sweep is through; 1 variation(s) failed");
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
    EXPECT_TRUE(QTest::qWaitFor([&] { return table.isColumnHidden(column("seed")); }, 5000));
    EXPECT_FALSE(table.isColumnHidden(column("level")));
    projects::Json memory;
    dock().save(memory);
    panel().hide_columns({});
    EXPECT_FALSE(table.isColumnHidden(column("seed")));
    dock().load(memory);
    ASSERT_TRUE(QTest::qWaitFor([&] { return table.isColumnHidden(column("seed")); }, 5000));
    dock().load(projects::Json::parse(R"({"sweeps": {"hidden": [3, {"a": 1}]}})"));
    EXPECT_TRUE(QTest::qWaitFor([&] { return !table.isColumnHidden(column("seed")); }, 5000));
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
    ASSERT_TRUE(QTest::qWaitFor([&] { return panel().model().rowCount() == 6 && count_done() == 4; }, 5000));
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
    EXPECT_TRUE(QTest::qWaitFor([&] { return plot.data().count() == 6; }, 5000));
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

TEST_F(SweepsWindowTest, AnotherProjectEndsTheRun) {
    save();
    add_sweep();
    fake.allowed = 1;
    press("run");
    ASSERT_TRUE(QTest::qWaitFor([&] { return fake.rendered == 1; }, 5000));
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
