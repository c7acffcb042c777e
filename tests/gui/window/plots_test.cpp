#include <QAction>
#include <QComboBox>
#include <QDockWidget>
#include <QListWidget>
#include <QPushButton>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QToolButton>
#include <atomic>
#include <chrono>
#include <fstream>
#include <sstream>
#include <thread>

#include "app/gui/export_plot.h"
#include "renderers/core/error.h"
#include "tests/gui/events.h"
#include "tests/gui/window/window_fixture.h"
#include "tests/unit/scarce_disk.h"

namespace ir::gui {
namespace {

namespace edits = projects::edits;
using engine::ErrorPoint;
using engine::ErrorStudy;

/// Measures as many points as are let through: the larger the value the longer it takes, the smaller its
/// error.
struct FakeStudies {
    std::atomic<int> allowed{1000}, runs{0};

    ErrorStudy run(const engine::StudyRequest& request, const engine::StudyCallbacks& callbacks) {
        ++runs;
        ErrorStudy study;
        study.plot = request.plot.id;
        study.metrics = {"mae", "rmse"};
        study.device = "fake";
        study.reference_noise = 0.01;
        study.notes = {"a note of the study"};
        for (const auto& experiment : request.plot.experiments)
            for (const auto& value : request.plot.values) {
                while (int(study.points.size()) >= allowed) {
                    if (callbacks.progress) callbacks.progress("waiting", 0.5);
                    callbacks.cancel->check();
                    std::this_thread::sleep_for(std::chrono::milliseconds(5));
                }
                study.points.push_back(measure(experiment, value));
                callbacks.point(study.points.back());
            }
        return study;
    }
    static ErrorPoint measure(const std::string& experiment, const projects::Json& value) {
        ErrorPoint point;
        point.experiment = experiment;
        point.value = value;
        const double number = value.get<double>();
        if (number > 10) {
            point.problem = "level must be at most 10";
            return point;
        }
        point.ms = 10 * number;
        point.errors = {{"rmse", 0.1 / number}, {"mae", 0.01 * number}};
        point.pixels = 100;
        point.memory_bytes = 2048;
        return point;
    }
};

class PlotsWindowTest : public WindowTest {
  protected:
    void SetUp() override {
        on_study = [this](const auto& request, const auto& told) { return studies.run(request, told); };
        WindowTest::SetUp();
        open_scene();
        add_second_experiment(0.5);
        first = window.session().document().experiments[0].id;
        second = window.session().document().experiments[1].id;
        window.session().edit(
            [&](const projects::Project& p) { return edits::set_reference(p, first, second); });
        auto* dock = window.findChild<QDockWidget*>("plots");
        dock->show();
        dock->raise();
        window.resizeDocks({dock}, {360}, Qt::Vertical);
        test::handle_events();
    }
    PlotsDock& plots() { return window.plots(); }
    widgets::PlotPanel& panel() { return plots().panel(); }
    template <class Widget>
    Widget* find(const char* name) {
        return panel().findChild<Widget*>(QLatin1String(name));
    }
    const projects::ErrorPlot& plot() { return window.session().document().plots.front(); }
    void press(const char* name) { QTest::mouseClick(find<QToolButton>(name), Qt::LeftButton); }
    /// Of the first experiment against the second, over its level.
    void add_plot() {
        plots().add_plot();
        window.session().edit([&](const projects::Project& p) {
            auto changed = p.plots.front();
            changed.over = "level";
            changed.values = {0.5, 1.0, 2.0, 11.0};
            return edits::change(p, changed);
        });
    }
    bool wait_for_points(std::size_t count) {
        return QTest::qWaitFor([&] { return panel().data().count() == count; }, 60000);
    }
    bool finish() {
        return QTest::qWaitFor([&] { return plots().is_settled(); }, 60000);
    }
    void run_to_end() {
        press("plot-run");
        ASSERT_TRUE(finish());
        ASSERT_EQ(panel().data().count(), 3u);
    }
    QString id_of(double value) {
        return QString::fromStdString(engine::point_id(FakeStudies::measure(first, value)));
    }
    double level_of_first() {
        return std::get<double>(window.session().experiment(first)->values.at("level"));
    }
    std::string project_file() { return folder.path().toStdString() + "/kept.interreflect"; }

    QTemporaryDir folder;
    FakeStudies studies;
    std::string first, second;
};

TEST_F(PlotsWindowTest, AnEmptyDockOffersAPlotOfTheExperimentsAndTheirReference) {
    auto* button = find<QPushButton>("empty-button");
    ASSERT_TRUE(button->isVisible());
    button->click();
    ASSERT_EQ(window.session().document().plots.size(), 1u);
    EXPECT_EQ(plot().reference, second);
    EXPECT_EQ(plot().experiments, std::vector<std::string>{first});
    EXPECT_FALSE(panel().is_empty());
    EXPECT_TRUE(find<QToolButton>("plot-run")->isEnabled());
    EXPECT_FALSE(find<QToolButton>("plot-export")->isEnabled());
    trigger("undo");
    EXPECT_TRUE(panel().is_empty());
    EXPECT_EQ(studies.runs, 0);
}

TEST_F(PlotsWindowTest, PointsAppearAsTheyAreMeasured) {
    add_plot();
    QSignalSpy said(&plots(), &PlotsDock::said);
    studies.allowed = 2;
    press("plot-run");
    ASSERT_TRUE(wait_for_points(2));
    EXPECT_FALSE(window.is_settled());
    EXPECT_EQ(find<QToolButton>("plot-run")->text(), "Cancel");
    studies.allowed = 1000;
    ASSERT_TRUE(finish());
    EXPECT_EQ(panel().data().count(), 3u);
    EXPECT_EQ(find<QToolButton>("plot-run")->text(), "Run");
    ASSERT_EQ(panel().data().problems.size(), 1u);
    EXPECT_TRUE(panel().data().problems[0].find("level must be at most 10") != std::string::npos);
    EXPECT_TRUE(panel().data().level);
    EXPECT_TRUE(panel().data().find(id_of(1.0).toStdString())->ring)
        << "error falls with time: all are on the front";
    EXPECT_EQ(find<QListWidget>("lines")->count(), 2);
    ASSERT_FALSE(said.empty());
    EXPECT_TRUE(said.last()[0].toString().contains("3 point")) << "the refused one was not measured";
}

TEST_F(PlotsWindowTest, AClickLoadsTheSettingInOneStepOfUndo) {
    add_plot();
    run_to_end();
    const double before = level_of_first();
    auto& view = panel().view();
    QTest::mouseClick(&view, Qt::LeftButton, {}, view.position_of(id_of(2.0)).toPoint());
    EXPECT_DOUBLE_EQ(level_of_first(), 2.0);
    EXPECT_EQ(window.session().experiment()->id, first);
    EXPECT_EQ(window.session().open_project().undo_stack().undo_label(), "Load level = 2.0 from plot");
    ASSERT_TRUE(settle());
    EXPECT_FLOAT_EQ(pixel(), 2.0f) << "it is rendered with that value";
    view.setFocus();
    QTest::keyClick(&view, Qt::Key_Left);
    EXPECT_DOUBLE_EQ(level_of_first(), 2.0) << "walking loads nothing";
    QTest::keyClick(&view, Qt::Key_Return);
    EXPECT_DOUBLE_EQ(level_of_first(), 1.0);
    trigger("undo");
    EXPECT_DOUBLE_EQ(level_of_first(), 2.0);
    trigger("undo");
    EXPECT_DOUBLE_EQ(level_of_first(), before);
}

TEST_F(PlotsWindowTest, PointsOverFramesLoadFrames) {
    plots().add_plot();
    window.session().edit([&](const projects::Project& p) {
        auto changed = p.plots.front();
        changed.values = {1, 2, 4};
        return edits::change(p, changed);
    });
    run_to_end();
    plots().load_point(QString::fromStdString(engine::point_id(FakeStudies::measure(first, 4))));
    EXPECT_EQ(window.session().experiment(first)->frames, 4);
}

TEST_F(PlotsWindowTest, NumbersAreKeptShownAtOnceAndMarkedWhenStale) {
    add_plot();
    window.session().files().save_as(project_file());
    run_to_end();
    auto* stale = find<QLabel>("stale");
    EXPECT_FALSE(stale->isVisible());
    ASSERT_TRUE(std::filesystem::exists(engine::study_file(project_file(), plot().id)));
    window.session().edit([&](const projects::Project& p) {
        auto changed = p.plots.front();
        changed.values.pop_back();
        return edits::change(p, changed);
    });
    EXPECT_TRUE(stale->isVisible());
    EXPECT_TRUE(stale->toolTip().contains("values")) << stale->toolTip().toStdString();
    EXPECT_EQ(panel().data().count(), 3u) << "old numbers are better than none";
    trigger("undo");
    EXPECT_FALSE(stale->isVisible());
    window.session().files().save();
    window.session().files().close();
    EXPECT_TRUE(panel().is_empty());
    ASSERT_TRUE(window.open_path(QString::fromStdString(project_file())));
    EXPECT_TRUE(wait_for_points(3));
    EXPECT_FALSE(stale->isVisible());
    plots().run_if_needed();
    ASSERT_TRUE(finish());
    EXPECT_EQ(studies.runs, 1);
}

TEST_F(PlotsWindowTest, AnotherMetricOrAxisIsDrawnWithoutRunning) {
    add_plot();
    run_to_end();
    auto* metric = find<QComboBox>("metric");
    choose(metric, "MAE");
    EXPECT_EQ(plot().metric, "mae");
    EXPECT_TRUE(panel().data().y.title.starts_with("MAE"));
    EXPECT_FALSE(panel().data().find(id_of(2.0).toStdString())->ring) << "by this metric the first is best";
    EXPECT_FALSE(panel().data().level) << "the noise is an RMSE";
    choose(find<QComboBox>("axis"), "against values");
    EXPECT_EQ(panel().data().x.title, "Level");
    EXPECT_DOUBLE_EQ(panel().data().find(id_of(2.0).toStdString())->x, 2.0);
    const auto headings = panel().data().headings;
    ASSERT_EQ(headings.size(), 6u);
    EXPECT_EQ(headings[0], "Level") << "one experiment needs no name in each row";
    EXPECT_TRUE(headings[1].starts_with("MAE")) << "what is judged by stands beside the value";
    EXPECT_TRUE(headings[3].starts_with("RMSE"));
    press("log-x");
    EXPECT_FALSE(panel().data().x.log);
    EXPECT_EQ(studies.runs, 1);
}

TEST_F(PlotsWindowTest, CancellingKeepsWhatWasMeasuredUntilThen) {
    add_plot();
    studies.allowed = 1;
    press("plot-run");
    ASSERT_TRUE(wait_for_points(1));
    press("plot-run");
    ASSERT_TRUE(finish());
    EXPECT_EQ(panel().data().count(), 1u);
    ASSERT_FALSE(panel().data().problems.empty());
    EXPECT_TRUE(panel().data().problems[0].find("Cancelled") != std::string::npos)
        << panel().data().problems[0];
    studies.allowed = 1000;
    run_to_end();
}

TEST_F(PlotsWindowTest, AFailureIsShown) {
    add_plot();
    on_study = [](const auto&, const auto&) -> ErrorStudy { throw UsageError("nothing to measure"); };
    press("plot-run");
    ASSERT_TRUE(finish());
    EXPECT_TRUE(window.banners().text("plots").contains("nothing to measure"));
    EXPECT_TRUE(find<QToolButton>("plot-run")->isEnabled());
}

TEST_F(PlotsWindowTest, ClosingTheProjectForgetsAStudyThatRuns) {
    add_plot();
    studies.allowed = 1;
    press("plot-run");
    ASSERT_TRUE(wait_for_points(1));
    window.session().files().close();
    EXPECT_TRUE(panel().is_empty());
    studies.allowed = 1000;
    ASSERT_TRUE(finish());
}

TEST_F(PlotsWindowTest, ExportsAreTheStudysNumbersAndAPicture) {
    add_plot();
    run_to_end();
    const auto csv = folder.filePath("plot.csv"), png = folder.filePath("plot.png");
    plots().write_numbers(csv);
    ErrorStudy expected;
    expected.plot = plot().id;
    expected.metrics = {"mae", "rmse"};
    for (const auto& value : plot().values) expected.points.push_back(FakeStudies::measure(first, value));
    engine::mark_front(expected.points, "rmse");
    std::ostringstream text;
    text << std::ifstream(csv.toStdString(), std::ios::binary).rdbuf();
    EXPECT_EQ(text.str(), engine::study_csv(expected));
    plots().write_picture(png, {640, 400}, 2, true);
    const QImage picture(png);
    EXPECT_EQ(picture.size(), QSize(1280, 800));
    EXPECT_EQ(picture.pixelColor(2, 2), QColor(Qt::white));
    EXPECT_GT(picture.convertToFormat(QImage::Format_Indexed8).colorCount(), 8);
    EXPECT_THROW(plots().write_picture("/nowhere/at/all.png", {64, 64}, 1, true), Error);
    EXPECT_THROW(plots().write_numbers("/nowhere/at/all.csv"), std::exception);
    EXPECT_EQ(is_refused_without_room(csv.toStdString(), [&] { plots().write_numbers(csv); }), "");
    EXPECT_EQ(is_refused_without_room(png.toStdString(),
                                      [&] {
                                          plots().write_picture(png, {64, 64}, 1, true);
                                      }),
              "");
}

TEST_F(PlotsWindowTest, APlotInTheTreeBringsTheDockForward) {
    add_plot();
    window.findChild<QDockWidget*>("plots")->hide();
    ASSERT_TRUE(QTest::qWaitFor([&] { return panel().visibleRegion().isEmpty(); }));
    emit window.document().tree().item_activated(
        {widgets::ItemKind::plot, QString::fromStdString(plot().id)});
    EXPECT_TRUE(QTest::qWaitFor([&] { return !panel().visibleRegion().isEmpty(); }));
    press("plot-edit");
    EXPECT_EQ(window.document().tree().selected().id.toStdString(), plot().id);
}

TEST(PlotExport, FilesWithOtherNamesAreRefused) {
    EXPECT_NO_THROW(check_plot_file("a.png"));
    EXPECT_NO_THROW(check_plot_file("a.CSV"));
    EXPECT_THROW(check_plot_file("a.svg"), UsageError);
}

}  // namespace
}  // namespace ir::gui
