#include <QAction>
#include <QLabel>
#include <QMenu>
#include <QProgressDialog>
#include <QPushButton>
#include <QTemporaryDir>
#include <atomic>
#include <chrono>
#include <thread>

#include "tests/gui/window/opened_files.h"
#include "tests/gui/window/window_fixture.h"
#include "tests/gui/window/written_report.h"

namespace ir::gui {
namespace {

class ReportTest : public WindowTest {
  protected:
    void SetUp() override {
        WindowTest::SetUp();
        open_scene();
    }
    void save() {
        window.session().files().save_as(path("p.interreflect").toStdString());
        ASSERT_TRUE(settle());
    }
    QString path(const char* name) const { return folder.filePath(QLatin1String(name)); }
    ReportController& reports() { return window.reports(); }
    bool wait() {
        return QTest::qWaitFor([this] { return !reports().is_writing(); }, 60000);
    }

    QTemporaryDir folder;
    OpenedFiles opened;
};

TEST_F(ReportTest, WaitsForAFolder) {
    EXPECT_FALSE(window.action("report")->isEnabled());
    EXPECT_TRUE(window.action("report")->toolTip().contains("Save the project first"));
    save();
    EXPECT_TRUE(window.action("report")->isEnabled());
}

TEST_F(ReportTest, IsWrittenAndOpened) {
    save();
    reports().write_to(path("r.html"));
    EXPECT_TRUE(window.findChild<QProgressDialog*>("report-progress"));
    EXPECT_FALSE(window.action("report")->isEnabled());
    ASSERT_TRUE(wait());
    EXPECT_EQ(opened.file(), path("r.html"));
    EXPECT_FALSE(WrittenReport(path("r.html")).text().isEmpty());
    EXPECT_TRUE(window.action("report")->isEnabled());
}

TEST_F(ReportTest, TakesWhatIsShownWhereNothingIsKept) {
    save();
    type_level("0.75");
    trigger("match");
    trigger("experiment-duplicate");  // which no view shows
    reports().write_to(path("r.html"));
    ASSERT_TRUE(wait());
    const WrittenReport report(path("r.html"));
    ASSERT_EQ(report.pictures().size(), 2u);
    EXPECT_EQ(report.pictures()[0].value, 0.75f);
    EXPECT_EQ(report.pictures()[1].value, 0.25f) << "of the truth";
    EXPECT_TRUE(report.text().contains(" has no kept result."));
    EXPECT_TRUE(report.text().contains("As the window showed it, not kept in the project: "));
    EXPECT_FALSE(QFile::exists(path("p.interreflect/results"))) << "nothing is kept for a report";
    for (const auto& each : renderer.exports) EXPECT_FALSE(QFile::exists(QString::fromStdString(each.file)));
}

TEST_F(ReportTest, OfAComparisonHasItsTwoPicturesAlone) {
    save();
    type_level("0.75");
    trigger("match");
    trigger("comparison-add");
    const auto comparison = window.session().document().comparisons.at(0);
    add_second_experiment(0.5);
    window.views().show_owner(window.session().document().experiments.back().id);
    ASSERT_TRUE(settle());
    ASSERT_EQ(window.live().state(comparison.a), LivePictures::State::absent);
    reports().write_comparison_to(path("r.html"), comparison.id);
    ASSERT_TRUE(wait());
    const WrittenReport report(path("r.html"));
    ASSERT_EQ(report.pictures().size(), 2u) << "what was not shown is rendered first";
    EXPECT_EQ(report.pictures()[0].value, 0.75f);
    EXPECT_EQ(report.pictures()[1].value, 0.25f);
    EXPECT_TRUE(report.text().contains("<h1>" + QString::fromStdString(comparison.name) + "</h1>"));
    EXPECT_FALSE(report.text().contains("Missing or stale"));
}

TEST_F(ReportTest, IsInTheMenuOfAComparison) {
    trigger("match");
    trigger("comparison-add");
    const auto item = window.document().tree().selected();
    ASSERT_EQ(item.kind, widgets::ItemKind::comparison);
    QMenu menu;
    emit window.document().tree().menu_opening(item, &menu);
    auto* entry = menu.findChild<QAction*>("comparison-report");
    ASSERT_TRUE(entry);
    EXPECT_FALSE(entry->isEnabled());
    EXPECT_TRUE(entry->toolTip().contains("Save the project first"));
    save();
    QMenu again;
    emit window.document().tree().menu_opening(item, &again);
    EXPECT_TRUE(again.findChild<QAction*>("comparison-report")->isEnabled());
}

TEST_F(ReportTest, WaitsForWhatIsBeingRendered) {
    save();
    renderer.hold = true;
    window.session().edit([&](const projects::Project& project) {
        return projects::edits::set_values(project, fake_registry(), window.session().experiment()->id,
                                           {{"level", 0.5}});
    });
    ASSERT_EQ(state(), LivePictures::State::rendering);
    reports().write_to(path("r.html"));
    auto* dialog = window.findChild<QProgressDialog*>("report-progress");
    ASSERT_TRUE(QTest::qWaitFor([&] { return dialog->labelText().contains("Waiting"); }, 60000));
    emit renderer.progressed(window.session().experiment()->id, "counting beads", 0.5);
    ASSERT_TRUE(QTest::qWaitFor([&] { return dialog->labelText().contains("counting beads"); }, 60000));
    EXPECT_TRUE(reports().is_writing());
    renderer.hold = false;
    renderer.answer(renderer.requests.back(), renderer.requests.size());
    ASSERT_TRUE(wait());
    const WrittenReport report(path("r.html"));
    ASSERT_EQ(report.pictures().size(), 1u);
    EXPECT_EQ(report.pictures()[0].value, 0.5f);
}

TEST_F(ReportTest, WaitingIsCancelled) {
    save();
    renderer.hold = true;
    window.live().render_again();
    ASSERT_EQ(state(), LivePictures::State::rendering);
    reports().write_to(path("r.html"));
    window.findChild<QProgressDialog*>("report-progress")->findChild<QPushButton*>()->click();
    ASSERT_TRUE(wait());
    EXPECT_FALSE(QFile::exists(path("r.html")));
    EXPECT_EQ(state(), LivePictures::State::rendering) << "the picture is still wanted";
    renderer.hold = false;
    renderer.answer(renderer.requests.back(), renderer.requests.size());
    ASSERT_TRUE(settle());
    EXPECT_TRUE(renderer.exports.empty());
}

TEST_F(ReportTest, HasNoPictureOfACameraThatTheProjectDoesNotHave) {
    save();
    ASSERT_TRUE(QTest::qWaitFor([this] { return window.session().camera().pose().has_value(); }, 60000));
    auto pose = *window.session().camera().pose();
    pose.eye += glm::dvec3(0, 1, 0);
    window.session().camera().move(window.session().experiment()->id, pose);
    ASSERT_TRUE(settle());
    reports().write_to(path("r.html"));
    ASSERT_TRUE(wait());
    const WrittenReport report(path("r.html"));
    EXPECT_TRUE(report.pictures().empty());
    EXPECT_TRUE(report.text().contains("none is shown: its camera was moved"));
}

TEST_F(ReportTest, SaysWhyAPictureIsNotThere) {
    save();
    renderer.export_error = "out of beads";
    reports().write_to(path("r.html"));
    ASSERT_TRUE(wait());
    const auto text = WrittenReport(path("r.html")).text();
    EXPECT_TRUE(text.contains(" has no kept result, and none is shown: out of beads."));
    renderer.failure = "no beads at all";
    window.live().render_again();
    ASSERT_TRUE(settle());
    reports().write_to(path("r.html"));
    ASSERT_TRUE(wait());
    EXPECT_TRUE(WrittenReport(path("r.html")).text().contains("none is shown: no beads at all."));
}

TEST_F(ReportTest, CancelledItLeavesNoFile) {
    save();
    std::atomic<bool> has_ended = false;
    reports().write_to(path("r.html"), [&](const std::string&, const report::Work& work) {
        try {
            for (;;) {
                work.tell("waiting", 0.5);
                std::this_thread::sleep_for(std::chrono::milliseconds(2));
            }
        } catch (const Cancelled&) {
            has_ended = true;
            throw;
        }
    });
    window.findChild<QProgressDialog*>("report-progress")->findChild<QPushButton*>()->click();
    ASSERT_TRUE(wait());
    EXPECT_TRUE(has_ended);
    EXPECT_TRUE(window.action("report")->isEnabled());
    EXPECT_FALSE(QFile::exists(path("r.html")));
    EXPECT_TRUE(opened.file().isEmpty());
}

TEST_F(ReportTest, WhatGoesWrongIsSaid) {
    save();
    reports().write_to(path("nothing/r.html"));
    ASSERT_TRUE(wait());
    EXPECT_TRUE(opened.file().isEmpty());
    EXPECT_TRUE(window.banners().text("file").contains("r.html"))
        << window.banners().text("file").toStdString();
}

}  // namespace
}  // namespace ir::gui
