#include <QAction>
#include <QComboBox>
#include <QDockWidget>
#include <QHeaderView>
#include <QLabel>
#include <QSignalSpy>
#include <QSpinBox>
#include <QTemporaryDir>
#include <QToolButton>
#include <atomic>
#include <chrono>
#include <fstream>
#include <thread>

#include "renderers/core/error.h"
#include "tests/gui/events.h"
#include "tests/gui/window/window_fixture.h"
#include "tests/unit/scarce_disk.h"
#include "widgets/panels/empty_tree_view.h"

namespace ir::gui {
namespace {

/// Measures as many variants as are let through, without rendering.
struct FakeBenchmarks {
    std::atomic<int> allowed{1000}, runs{0};
    engine::BenchmarkRequest request;

    engine::BenchmarkReport run(const engine::BenchmarkRequest& requested,
                                const engine::BenchmarkCallbacks& callbacks) {
        ++runs;
        request = requested;
        const auto& benchmark = engine::find_benchmark(requested.name).benchmark;
        engine::BenchmarkReport report;
        report.name = requested.name;
        report.device = "abacus";
        report.repeats = requested.repeats;
        report.columns = engine::columns_of(benchmark);
        for (const auto& label : requested.variants) {
            engine::BenchmarkProgress progress;
            progress.label = label;
            progress.row = report.rows.size();
            progress.rows = requested.variants.size();
            progress.repeats = 1;
            callbacks.progress(progress);
            while (int(report.rows.size()) >= allowed) {
                callbacks.cancel->check();
                std::this_thread::sleep_for(std::chrono::milliseconds(5));
            }
            engine::BenchmarkRow row;
            row.label = label;
            row.cells.assign(report.columns.size(), 10.0 * double(report.rows.size() + 1));
            if (report.rows.size() == 2) {
                row.cells.assign(report.columns.size(), std::nullopt);
                row.problem = "out of beads";
            }
            report.rows.push_back(row);
            callbacks.report(report);
        }
        return report;
    }
};

class BenchmarksWindowTest : public testing::Test {
  protected:
    void SetUp() override {
        window.show();
        ASSERT_TRUE(QTest::qWaitForWindowExposed(&window));
        ASSERT_TRUE(window.open_path("builtin:cornell"));
        window.docks().apply("benchmarks");
        window.benchmarks().choose("photon-mapping");
        test::handle_events();
    }
    void TearDown() override {
        fake.allowed = 1000;
        if (window.session().has_project()) window.session().files().close();
    }
    BenchmarkDock& dock() { return window.benchmarks(); }
    widgets::BenchmarkPanel& panel() { return dock().panel(); }
    QTreeView& view() { return panel().view(); }
    template <class Widget>
    Widget* find(const char* name) {
        return panel().findChild<Widget*>(QLatin1String(name));
    }
    QString cell(int row, int column) { return view().model()->index(row, column).data().toString(); }
    void press(const char* name) { QTest::mouseClick(find<QToolButton>(name), Qt::LeftButton); }
    bool finish() {
        return QTest::qWaitFor([&] { return dock().is_settled(); }, 60000);
    }

    FakeRenderer renderer;
    FakeBenchmarks fake;
    MainWindow window{renderer,
                      fake_registry(),
                      {.remember = false,
                       .surface = painted,
                       .benchmark_runner = [this](const auto& request, const auto& told) {
                           return fake.run(request, told);
                       }}};
};

TEST_F(BenchmarksWindowTest, EveryBenchmarkIsOffered) {
    EXPECT_EQ(find<QComboBox>("benchmark")->count(), int(engine::benchmarks().size()));
    EXPECT_EQ(view().model()->rowCount(), 9) << "its variants, before they are measured";
    EXPECT_TRUE(find<QLabel>("foot")->text().contains("Not measured yet"));
    EXPECT_TRUE(find<QComboBox>("benchmark")->toolTip().contains("480x270"));
    EXPECT_EQ(fake.runs, 0);
}

TEST_F(BenchmarksWindowTest, RowsAppearAsTheyAreMeasured) {
    fake.allowed = 1;
    press("run");
    ASSERT_TRUE(QTest::qWaitFor([&] { return !cell(0, 1).isEmpty(); }, 60000));
    EXPECT_FALSE(window.is_settled());
    EXPECT_TRUE(cell(1, 1).isEmpty());
    EXPECT_TRUE(QTest::qWaitFor([&] { return find<QLabel>("doing")->text().startsWith("2 of 9"); }, 60000))
        << find<QLabel>("doing")->text().toStdString();
    fake.allowed = 1000;
    ASSERT_TRUE(finish());
    EXPECT_EQ(cell(8, 1), "90");
    EXPECT_TRUE(cell(2, 0).contains("out of beads"));
    EXPECT_TRUE(view().isFirstColumnSpanned(2, {}));
    EXPECT_TRUE(find<QLabel>("foot")->text().contains("abacus"));
    EXPECT_TRUE(find<QLabel>("foot")->toolTip().contains("longer"));
}

TEST_F(BenchmarksWindowTest, CancelKeepsWhatThereIs) {
    fake.allowed = 2;
    press("run");
    ASSERT_TRUE(QTest::qWaitFor([&] { return !cell(1, 1).isEmpty(); }, 60000));
    view().setFocus();
    QTest::keyClick(&view(), Qt::Key_Escape);
    ASSERT_TRUE(finish());
    EXPECT_EQ(cell(0, 1), "10");
    EXPECT_TRUE(find<QLabel>("foot")->text().startsWith("Cancelled"));
    EXPECT_TRUE(find<QToolButton>("export")->isEnabled());
    EXPECT_EQ(find<QToolButton>("run")->text(), "Run");
    fake.allowed = 1000;
    press("run");
    ASSERT_TRUE(finish());
    EXPECT_EQ(fake.runs, 2);
    EXPECT_EQ(cell(8, 1), "90");
}

TEST_F(BenchmarksWindowTest, ClosingTheWindowCancels) {
    fake.allowed = 0;
    press("run");
    ASSERT_TRUE(QTest::qWaitFor([&] { return fake.runs == 1; }, 60000));
    window.session().files().close();
    window.close();
    EXPECT_TRUE(finish());
}

TEST_F(BenchmarksWindowTest, RunsCheckedVariantsAtTheExperimentsPlaceAndRemembers) {
    auto* places = find<QComboBox>("place");
    ASSERT_EQ(places->count(), 2);
    places->setCurrentIndex(1);
    emit places->activated(1);
    panel().findChild<QAction*>("check-none")->trigger();
    EXPECT_FALSE(find<QToolButton>("run")->isEnabled());
    auto* model = view().model();
    model->setData(model->index(1, 0), Qt::Checked, Qt::CheckStateRole);
    press("run");
    ASSERT_TRUE(finish());
    ASSERT_TRUE(fake.request.place);
    EXPECT_EQ(fake.request.place->experiment, window.session().experiment()->id);
    EXPECT_EQ(fake.request.variants, std::vector<std::string>{"25 k photons"});
    auto memory = projects::Json::object();
    dock().save(memory);
    dock().load(projects::Json::object());
    EXPECT_EQ(panel().chosen_variants().size(), 9);
    dock().load(memory);
    EXPECT_EQ(panel().chosen_variants(), QStringList{"25 k photons"});
    EXPECT_EQ(places->currentIndex(), 1);
    for (const char* odd :
         {R"({"benchmarks": 3})", R"({"benchmarks": {"chosen": "gone", "repeats": -9e99, "skipped": [1]}})",
          R"({"benchmarks": {"chosen": 1, "skipped": {"photon-mapping": {"a": 1}}}})"})
        dock().load(projects::Json::parse(odd));
    EXPECT_EQ(find<QComboBox>("benchmark")->currentText(), "photon-mapping");
}

TEST_F(BenchmarksWindowTest, WritesTheNumbers) {
    press("run");
    ASSERT_TRUE(finish());
    const QTemporaryDir folder;
    dock().write_csv(folder.filePath("t.csv"));
    dock().write_json(folder.filePath("t.json"));
    std::ifstream csv(folder.filePath("t.csv").toStdString()), json(folder.filePath("t.json").toStdString());
    std::string line;
    std::getline(csv, line);
    EXPECT_TRUE(line.starts_with("variant,Total [ms]")) << line;
    EXPECT_EQ(projects::Json::parse(json)["table"].size(), 9u);
    EXPECT_THROW(dock().write_csv("/nowhere/t.csv"), Error);
    const auto full = folder.filePath("full");
    EXPECT_EQ(is_refused_without_room(full.toStdString(), [&] { dock().write_csv(full); }), "");
    EXPECT_EQ(is_refused_without_room(full.toStdString(), [&] { dock().write_json(full); }), "");
}

/// The real thing, without a fake.
TEST(Benchmarks, ATinyOneRunsOnAMachineOfItsOwn) {
    FakeRenderer renderer;
    MainWindow window{renderer, fake_registry(), {.remember = false, .surface = painted}};
    window.show();
    ASSERT_TRUE(window.open_path("builtin:cornell"));
    window.docks().apply("benchmarks");
    auto& dock = window.benchmarks();
    dock.choose("view-normals-defaults");
    dock.panel().findChild<QSpinBox*>("repeats")->setValue(1);
    dock.run();
    ASSERT_TRUE(QTest::qWaitFor([&] { return dock.is_settled(); }, 60000));
    ASSERT_TRUE(dock.report()) << dock.panel().fields().foot.toStdString();
    EXPECT_TRUE(dock.report()->rows.at(0).problem.empty()) << dock.report()->rows[0].problem;
    EXPECT_GT(dock.report()->rows[0].warm_ms, 0);
    EXPECT_EQ(dock.report()->repeats, 1);
    dock.run();
    dock.cancel();
    ASSERT_TRUE(QTest::qWaitFor([&] { return dock.is_settled(); }, 60000));
    EXPECT_TRUE(dock.panel().fields().foot.startsWith("Cancelled"));
    window.session().files().close();
}

}  // namespace
}  // namespace ir::gui
