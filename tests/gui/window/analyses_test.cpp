// Analyses in the window: ask, run, cancel, look at the answer, find it again.
#include <QApplication>
#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QMenu>
#include <QPushButton>
#include <QSlider>
#include <QTemporaryDir>
#include <QToolButton>
#include <algorithm>
#include <atomic>
#include <functional>
#include <thread>

#include "app/engine/analysis/kept_analysis.h"
#include "projects/document_json.h"
#include "renderers/core/error.h"
#include "tests/gui/window/window_fixture.h"
#include "widgets/panels/empty_tree_view.h"

namespace ir::gui {
namespace {

/// Two rows of bars and two pictures: what matters, and who is nearest.
engine::AnalysisResult made_up() {
    engine::AnalysisResult result;
    auto& data = result.data;
    data.title = "Made up";
    data.x.title = "Change";
    data.are_bars = true;
    data.y.names = {"Grain", "Level"};
    data.headings = {"Parameter", "Change"};
    data.series = {{"a step down", {}}, {"a step up", {}}};
    const auto add = [&](std::size_t series, const char* id, double row, double change) {
        PlotPoint point;
        point.id = point.label = id;
        point.x = change;
        point.y = row;
        point.cells = {{id}, {std::to_string(change), change}};
        data.series[series].points.push_back(point);
    };
    add(0, "level:down", 1, -2);
    add(1, "level:up", 1, 3);
    add(1, "grain:up", 0, 1);
    data.problems = {"depth: has no effect"};
    Image level(8, 6, 1, 0.5f), grain(8, 6, 1, 1);
    for (int y = 0; y < 6; ++y) grain.at(0, y) = 2;
    result.pictures.push_back({"level", "Level", "Where it matters.", true, {}, level});
    result.pictures.push_back({"grain",
                               "Grain",
                               "Who is nearest.",
                               false,
                               {{1, "here", tints::orange}, {2, "there", tints::sky}},
                               grain});
    result.device = "abacus";
    return result;
}

class AnalysesWindowTest : public WindowTest {
  protected:
    void SetUp() override {
        on_analysis = [this](const engine::AnalysisRequest& request, const engine::AnalysisCallbacks& told) {
            ++runs;
            while (holds) {
                told.progress("counting beads", 0.5);
                told.cancel->check();
                std::this_thread::sleep_for(std::chrono::milliseconds(5));
            }
            if (fails) throw Error("out of beads");
            const auto result = answers ? answers(request.analysis) : made_up();
            if (request.keeps)
                engine::keep_analysis(request.project, request.analysis, request.folder, result);
            return result;
        };
        WindowTest::SetUp();
        open_scene();
        window.docks().apply("analyses");
        ASSERT_TRUE(settle());
    }
    void TearDown() override {
        holds = false;
        WindowTest::TearDown();
    }
    AnalysesDock& dock() { return *window.findChild<AnalysesDock*>(); }
    widgets::AnalysisPanel& panel() { return dock().panel(); }
    template <class Widget>
    Widget* find(const char* name) {
        return panel().findChild<Widget*>(QLatin1String(name));
    }
    void press(const char* name) { QTest::mouseClick(find<QToolButton>(name), Qt::LeftButton); }
    const projects::Analysis& analysis() { return window.session().document().analyses.at(0); }
    /// As a person asks: the button's menu, then a kind.
    void ask(const char* kind) {
        auto* entry = find<QToolButton>("new")->menu()->findChild<QAction*>(QStringLiteral("new:") +
                                                                            QLatin1String(kind));
        ASSERT_TRUE(entry) << kind;
        entry->trigger();
        ASSERT_TRUE(settle());
    }
    void save() {
        window.session().files().save_as(project_file());
        ASSERT_TRUE(settle());
    }
    std::string project_file() { return folder.path().toStdString() + "/asked.interreflect"; }
    /// In the place of an answer; the chart has such a page, too.
    bool offers_one() {
        const auto buttons = panel().findChildren<QPushButton*>(QStringLiteral("empty-button"));
        return std::any_of(buttons.begin(), buttons.end(),
                           [](const QPushButton* button) { return button->isVisible(); });
    }
    /// In place of an answer.
    QString page_text() {
        for (const auto* text : panel().findChildren<QLabel*>(QStringLiteral("empty")))
            if (text->isVisible()) return text->text();
        return {};
    }
    QString offer() {
        for (const auto* button : panel().findChildren<QPushButton*>(QStringLiteral("empty-button")))
            if (button->isVisible()) return button->text();
        return {};
    }
    const widgets::ItemRef& item() { return window.document().editor().item(); }
    std::size_t bars() { return panel().chart().data().count(); }
    void click_bar(const char* id) {
        auto& view = panel().chart().view();
        QTest::mouseClick(&view, Qt::LeftButton, {}, view.position_of(QLatin1String(id)).toPoint());
    }

    QTemporaryDir folder;
    /// In the place of made_up(); set while nothing runs.
    std::function<engine::AnalysisResult(const projects::Analysis&)> answers;
    std::atomic<int> runs = 0;
    std::atomic<bool> holds = false, fails = false;
};

TEST_F(AnalysesWindowTest, AsksRunsAndShowsTheAnswer) {
    EXPECT_TRUE(offers_one());
    EXPECT_EQ(find<QToolButton>("new")->menu()->actions().size(), 6);
    ask("sensitivity");
    ASSERT_EQ(window.session().document().analyses.size(), 1u);
    EXPECT_EQ(analysis().experiments.front(), window.session().experiment()->id);
    EXPECT_EQ(bars(), 0u);
    EXPECT_EQ(page_text(), "Run the analysis to get its answer.");
    EXPECT_EQ(offer(), "Run");
    press("run");
    ASSERT_TRUE(settle());
    EXPECT_EQ(bars(), 3u);
    EXPECT_EQ(page_text(), "");
    EXPECT_EQ(panel().shown(), "level");
    EXPECT_EQ(panel().chart().selected(), "level:down") << "the bar of the picture";
    EXPECT_TRUE(panel().chart().table().currentIndex().isValid());
    EXPECT_EQ(panel().view().display().colour_map, "coolwarm");
    EXPECT_TRUE(find<QLabel>("foot")->text().contains("not kept: save the project first"));
    // A bar shows its picture, whose numbers are names here.
    click_bar("grain:up");
    EXPECT_EQ(panel().shown(), "grain");
    EXPECT_EQ(panel().view().picture()->categories.size(), 2u);
    click_bar("level:down");
    EXPECT_EQ(panel().shown(), "level");
    // By keys: rows downwards, series sideways.
    panel().chart().view().setFocus();
    QTest::keyClick(&panel().chart().view(), Qt::Key_Right);
    EXPECT_EQ(panel().chart().selected(), "level:up");
    QTest::keyClick(&panel().chart().view(), Qt::Key_Down);
    EXPECT_EQ(panel().shown(), "grain");
    // What the cursor is over is told by name.
    const auto& view = panel().view();
    emit panel().view().cursor_moved({0, 0});
    EXPECT_TRUE(find<QLabel>("value")->text().endsWith("there"))
        << find<QLabel>("value")->text().toStdString();
    emit panel().view().cursor_moved({3, 3});
    EXPECT_TRUE(find<QLabel>("value")->text().endsWith("here"));
    EXPECT_EQ(view.image().width, 8);
    trigger("undo");
    EXPECT_TRUE(window.session().document().analyses.empty());
    EXPECT_TRUE(offers_one());
}

TEST_F(AnalysesWindowTest, CancelsAndFailsInALine) {
    ask("sensitivity");
    holds = true;
    press("run");
    ASSERT_TRUE(QTest::qWaitFor([&] { return find<QLabel>("doing")->text() == "counting beads"; }, 60000));
    EXPECT_EQ(find<QToolButton>("run")->text(), "Cancel");
    EXPECT_FALSE(window.is_settled());
    press("run");
    ASSERT_TRUE(settle());
    EXPECT_EQ(bars(), 0u);
    EXPECT_EQ(find<QToolButton>("run")->text(), "Run");
    holds = false;
    fails = true;
    press("run");
    ASSERT_TRUE(settle());
    EXPECT_TRUE(find<QLabel>("foot")->text().startsWith("out of beads"));
    EXPECT_TRUE(window.banners().text("analyses").contains("out of beads"));
    fails = false;
    press("run");
    ASSERT_TRUE(settle());
    EXPECT_EQ(bars(), 3u);
    EXPECT_FALSE(find<QLabel>("foot")->text().contains("out of beads"));
}

TEST_F(AnalysesWindowTest, AnswersAreThereAgainAndGoStale) {
    save();
    ask("sensitivity");
    press("run");
    ASSERT_TRUE(settle());
    EXPECT_FALSE(find<QLabel>("foot")->text().contains("stale"));
    EXPECT_FALSE(find<QLabel>("foot")->text().contains("not kept"));
    type_level("7");
    EXPECT_TRUE(find<QLabel>("foot")->text().startsWith("stale"))
        << find<QLabel>("foot")->text().toStdString();
    trigger("undo");
    EXPECT_FALSE(find<QLabel>("foot")->text().contains("stale"));
    click_bar("grain:up");
    window.session().files().save();
    window.session().files().close();
    ASSERT_TRUE(window.open_path(QString::fromStdString(project_file())));
    ASSERT_TRUE(settle());
    window.docks().raise("analyses");
    ASSERT_TRUE(QTest::qWaitFor([&] { return bars() == 3; }, 60000)) << "read from the project's folder";
    EXPECT_EQ(panel().view().image().width, 8);
    EXPECT_EQ(panel().shown(), "grain") << "as it was left";
    EXPECT_EQ(runs, 1);
    EXPECT_TRUE(find<QLabel>("foot")->text().contains("abacus"));
}

TEST_F(AnalysesWindowTest, WhatCannotBeAskedIsEditedInTheProject) {
    ask("attribution");  // about two experiments, and there is one
    EXPECT_FALSE(find<QToolButton>("run")->isEnabled());
    EXPECT_TRUE(find<QToolButton>("run")->toolTip().contains("choose two of one method"));
    EXPECT_EQ(page_text(), "It is about one experiment; choose two of one method (Edit).");
    EXPECT_EQ(offer(), "Edit");
    auto& editor = window.document().editor();
    EXPECT_TRUE(editor.findChild<QLabel*>("analysis-problem")->text().contains("choose two of one method"));
    auto* parameters = editor.findChild<QWidget*>("parameters");
    ASSERT_TRUE(parameters);
    add_second_experiment(5);
    auto* checks = editor.findChild<QListWidget*>("experiments");
    ASSERT_TRUE(checks);
    const auto second = window.session().document().experiments[1].id;
    window.session().edit([&](const projects::Project& project) {
        auto changed = project.analyses[0];
        changed.experiments.push_back(second);
        return projects::edits::change(project, changed);
    });
    ASSERT_TRUE(settle());
    EXPECT_TRUE(find<QToolButton>("run")->isEnabled()) << find<QToolButton>("run")->toolTip().toStdString();
}

TEST_F(AnalysesWindowTest, TheProjectsFormAndTheBannerFollowTheOneThatIsShown) {
    ask("sensitivity");
    ask("divergence");
    const auto& analyses = window.session().document().analyses;
    const auto first = QString::fromStdString(analyses[0].id),
               second = QString::fromStdString(analyses[1].id);
    window.document().select({widgets::ItemKind::analysis, second});
    auto* list = find<QComboBox>("analysis");
    const auto choose = [&](const QString& id) {
        list->setCurrentIndex(list->findData(id));
        emit list->activated(list->currentIndex());
        ASSERT_TRUE(settle());
    };
    choose(first);
    EXPECT_EQ(item().id, first);
    ask("sensitivity");
    EXPECT_EQ(item().id.toStdString(), analyses.back().id) << "a new one, too";
    fails = true;
    press("run");
    ASSERT_TRUE(settle());
    EXPECT_NE(window.banners().text("analyses"), "");
    choose(second);
    EXPECT_EQ(window.banners().text("analyses"), "");
    // Forms of other items stay.
    const auto experiment = QString::fromStdString(window.session().experiment()->id);
    window.document().select({widgets::ItemKind::experiment, experiment});
    choose(first);
    EXPECT_EQ(item().id, experiment);
}

TEST_F(AnalysesWindowTest, WhatIsSaidEnds) {
    ask("sensitivity");
    press("run");
    ASSERT_TRUE(settle());
    const std::string said = "The analysis has an answer";
    EXPECT_EQ(label("state"), said);
    fails = true;
    press("run");
    ASSERT_TRUE(settle());
    window.banners().show_banner("processor", widgets::BannerStack::Kind::note, "Passes run on OpenGL now");
    save();
    window.session().files().close();
    EXPECT_NE(label("state"), said) << "of a project that is gone";
    EXPECT_FALSE(window.banners().names().contains("analyses"));
    EXPECT_FALSE(window.banners().names().contains("processor"));
    window.findChild<StatusLine*>()->say("for a moment");
    EXPECT_EQ(label("state"), "for a moment");
    EXPECT_TRUE(QTest::qWaitFor([&] { return label("state") != "for a moment"; }, 60000));
}

TEST_F(AnalysesWindowTest, ADivergenceNamesMachinesAndNoReference) {
    ask("divergence");
    EXPECT_TRUE(find<QToolButton>("run")->isEnabled()) << "device and host, unless others are named";
    auto& editor = window.document().editor();
    window.document().select({widgets::ItemKind::analysis, QString::fromStdString(analysis().id)});
    auto* machines = editor.findChild<QLineEdit*>("parameters");
    ASSERT_TRUE(machines && machines->isEnabled());
    EXPECT_EQ(machines->placeholderText(), "gl, host");
    for (const auto* reference : editor.findChildren<QWidget*>("reference")) {
        if (reference->isVisible()) {
            EXPECT_FALSE(reference->isEnabled());
        }
    }
    machines->setFocus();
    QTest::keyClicks(machines, "osmesa+host, cuda");
    QTest::keyClick(machines, Qt::Key_Return);
    ASSERT_TRUE(settle());
    EXPECT_FALSE(find<QToolButton>("run")->isEnabled());
    EXPECT_TRUE(find<QToolButton>("run")->toolTip().contains("'cuda' is no machine"));
    EXPECT_EQ(
        editor.findChild<QLabel*>("analysis-problem")->text().toStdString(),
        "It cannot be carried out: 'cuda' is no machine; give gl or host, egl or osmesa, or both with a "
        "plus.");
    trigger("undo");
    press("run");
    ASSERT_TRUE(settle());
    EXPECT_EQ(bars(), 3u);
}

TEST_F(AnalysesWindowTest, TheTimeMachineGoesThroughItsFrames) {
    save();
    ask("frames");
    auto& editor = window.document().editor();
    window.document().select({widgets::ItemKind::analysis, QString::fromStdString(analysis().id)});
    auto* frames = editor.findChild<widgets::NumberField*>("frames");
    for (auto* each : editor.findChildren<widgets::NumberField*>("frames"))
        if (each->isVisible()) frames = each;
    ASSERT_TRUE(frames && frames->isEnabled());
    frames->setFocus();
    frames->selectAll();
    QTest::keyClicks(frames, "3");
    QTest::keyClick(frames, Qt::Key_Return);
    ASSERT_TRUE(settle());
    EXPECT_EQ(analysis().frames, 3);
    auto* slider = find<QSlider>("frame");
    EXPECT_FALSE(slider->isVisible());
    answers = [](const projects::Analysis& asked) {
        engine::AnalysisResult result;
        result.data.title = "Frames";
        result.data.are_bars = true;
        result.data.headings = {"Frame"};
        result.data.series = {{"", {}}};
        for (int i = asked.frames; i-- > 0;) result.data.y.names.push_back(std::to_string(i));
        for (int i = 0; i < asked.frames; ++i) {
            PlotPoint point;
            point.id = "frame" + std::to_string(i);
            point.x = 1 + i;
            point.y = asked.frames - 1 - i;
            point.cells = {{std::to_string(i), double(i)}};
            result.data.series[0].points.push_back(point);
            result.pictures.push_back({point.id,
                                       point.id,
                                       "",
                                       false,
                                       {},
                                       Image(8, 6, 3, float(1 << i)),
                                       engine::PicturedBuffer{Semantic::velocity}});
        }
        return result;
    };
    press("run");
    ASSERT_TRUE(settle());
    ASSERT_EQ(bars(), 3u);
    ASSERT_TRUE(slider->isVisible());
    const auto& view = panel().view();
    EXPECT_EQ(view.image().channels, 3);
    EXPECT_EQ(view.display().high, 4) << "one range for all";
    slider->setFocus();
    QTest::keyClick(slider, Qt::Key_Right);
    EXPECT_EQ(panel().shown(), "frame1");
    EXPECT_EQ(panel().chart().selected(), "frame1");
    EXPECT_EQ(view.image().at(0, 0), 2);
    QTest::keyClick(slider, Qt::Key_End);
    EXPECT_EQ(panel().shown(), "frame2");
    EXPECT_EQ(view.display().high, 4);
    // By the table: a row shows its picture.
    auto& table = panel().chart().table();
    table.setFocus();
    QTest::keyClick(&table, Qt::Key_Up);
    EXPECT_EQ(panel().shown(), "frame1");
    EXPECT_EQ(slider->value(), 1);
    emit panel().view().cursor_moved({0, 0});
    EXPECT_TRUE(find<QLabel>("value")->text().endsWith("2 2 2"))
        << find<QLabel>("value")->text().toStdString();
    // Kept, and there again.
    window.session().files().save();
    window.session().files().close();
    ASSERT_TRUE(window.open_path(QString::fromStdString(project_file())));
    ASSERT_TRUE(settle());
    window.docks().raise("analyses");
    ASSERT_TRUE(QTest::qWaitFor([&] { return bars() == 3; }, 60000));
    EXPECT_EQ(panel().shown(), "frame1") << "as it was left";
    EXPECT_EQ(view.image().channels, 3);
    EXPECT_TRUE(slider->isVisible());
    EXPECT_EQ(analysis().frames, 3);
}

TEST_F(AnalysesWindowTest, KeepAsksForTheFramesOfTheView) {
    auto* dock = window.findChild<FramesDock*>();
    type_level("7");
    window.views().show_output("depth");
    type_level("8");
    window.docks().raise("frames");
    ASSERT_TRUE(settle());
    auto* keep = dock->panel().findChild<QToolButton*>("frame-keep");
    ASSERT_TRUE(keep->isEnabled()) << keep->toolTip().toStdString();
    const auto before = steps();
    QTest::mouseClick(keep, Qt::LeftButton);
    ASSERT_TRUE(settle());
    ASSERT_EQ(window.session().document().analyses.size(), 1u);
    EXPECT_EQ(steps(), before + 1);
    EXPECT_EQ(analysis().kind, "frames");
    EXPECT_EQ(analysis().output, "depth");
    EXPECT_EQ(analysis().frames, 2);
    EXPECT_EQ(analysis().experiments.front(), window.session().experiment()->id);
    EXPECT_TRUE(window.docks().is_seen("analyses"));
    EXPECT_TRUE(find<QToolButton>("run")->isEnabled());
    trigger("undo");
    EXPECT_TRUE(window.session().document().analyses.empty());
    // By a key; and where nothing is kept it says so.
    QTest::keyClick(&window, Qt::Key_K, Qt::AltModifier);
    ASSERT_TRUE(settle());
    EXPECT_EQ(window.session().document().analyses.size(), 1u);
    window.live().past().clear();
    EXPECT_FALSE(keep->isEnabled());
    EXPECT_TRUE(keep->toolTip().contains("No kept frame"));
    EXPECT_FALSE(window.action("past-keep")->isEnabled());
}

/// The real thing, without a fake.
TEST(Analyses, RunOnAMachineOfTheirOwn) {
    const projects::Json json = {
        {"schema", 6},
        {"name", "Small"},
        {"scenes", {{{"id", "box"}, {"parts", {{{"source", "builtin:cornell@1"}}}}}}},
        {"experiments", {{{"id", "a"}, {"scene", "box"}, {"method", "hbao"}, {"size", {8, 6}}}}}};
    engine::AnalysisRequest request;
    request.project = projects::read_project(json.dump(), "test.json", engine::registry()).project;
    request.analysis = projects::analysis_of(request.project, "sensitivity", "a", engine::registry());
    request.analysis.parameters = {"directions", "steps", "angle_bias"};
    AnalysisRuns asked({});
    std::shared_ptr<const engine::AnalysisResult> result;
    QString problem;
    QObject::connect(&asked, &AnalysisRuns::finished, &asked, [&](const auto& found) { result = found; });
    QObject::connect(&asked, &AnalysisRuns::failed, &asked,
                     [&](const QString& error, bool) { problem = error; });
    ASSERT_TRUE(asked.start(request));
    EXPECT_FALSE(asked.start(request));
    ASSERT_TRUE(QTest::qWaitFor([&] { return !asked.is_running(); }, 60000));
    EXPECT_EQ(problem, "");
    ASSERT_TRUE(result);
    EXPECT_GT(result->data.count(), 0u);
}

}  // namespace
}  // namespace ir::gui
