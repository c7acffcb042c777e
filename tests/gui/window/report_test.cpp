#include <QAction>
#include <QProgressDialog>
#include <QPushButton>
#include <QTemporaryDir>
#include <atomic>
#include <chrono>
#include <fstream>
#include <iterator>
#include <thread>

#include "tests/gui/window/opened_files.h"
#include "tests/gui/window/window_fixture.h"

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
    std::ifstream stream(path("r.html").toStdString());
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    EXPECT_NE(text.find("has no kept result"), std::string::npos);
    EXPECT_TRUE(window.action("report")->isEnabled());
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
