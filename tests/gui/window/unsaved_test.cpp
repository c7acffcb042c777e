#include <QFileInfo>
#include <QTemporaryDir>
#include <QTest>

#include "projects/unsaved.h"
#include "tests/gui/window/window_fixture.h"

namespace ir::gui {
namespace {

/// What a crash leaves of a project that was never saved.
std::filesystem::path leave_unsaved(const std::filesystem::path& place) {
    projects::OpenProject crashed(fake_registry());
    crashed.autosave_unsaved_in(place);
    crashed.edit(projects::edits::set_project_name(crashed.project(), "Lost"));
    crashed.edit(projects::edits::add(crashed.project(),
                                      projects::Scene{"room", "Room", {{"builtin:cornell@1", "", {}}}}));
    crashed.autosave();
    crashed.wait_for_autosave();
    return std::filesystem::directory_iterator(place)->path();
}

TEST_F(WindowTest, WhatACrashLeftOpensAsNeverSavedAndGoesWhenClosed) {
    const QTemporaryDir folder;
    const auto place = std::filesystem::path(folder.path().toStdString()) / "unsaved";
    window.session().files().set_unsaved_folder(place);
    const auto home = leave_unsaved(place);
    ASSERT_TRUE(window.open_path(QString::fromStdString(home.string())));
    ASSERT_TRUE(settle());
    EXPECT_EQ(window.session().document().name, "Lost");
    EXPECT_TRUE(window.session().open_project().folder().empty());
    EXPECT_TRUE(window.isWindowModified());
    window.session().files().close();
    EXPECT_FALSE(std::filesystem::exists(home));
}

TEST_F(WindowTest, AProjectThatWasNeverSavedIsAutosavedUntilItIsClosed) {
    const QTemporaryDir folder;
    const auto place = std::filesystem::path(folder.path().toStdString()) / "unsaved";
    window.session().files().set_unsaved_folder(place);
    open_scene();
    window.session().open_project().autosave();
    window.session().open_project().wait_for_autosave();
    EXPECT_FALSE(std::filesystem::is_empty(place));
    window.session().files().close();
    EXPECT_TRUE(std::filesystem::is_empty(place));
}

TEST(RecentProjects, BeginWithWhatWasNeverSaved) {
    const auto home = leave_unsaved(unsaved_projects_folder());
    RecentProjects recent(true);
    const auto listed = recent.all();
    ASSERT_FALSE(listed.empty());
    EXPECT_EQ(listed.front().path.toStdString(), home.string());
    EXPECT_EQ(listed.front().name, "Lost (not saved)");
    EXPECT_TRUE(listed.front().when.isValid());
    EXPECT_FALSE(listed.front().missing);
    EXPECT_EQ(recent.paths().front().toStdString(), home.string());
    recent.add("/somewhere/else.interreflect");
    EXPECT_EQ(recent.paths().size(), 2) << "the list on disk holds saved ones only";
    std::filesystem::remove_all(home);
    EXPECT_EQ(recent.paths(), QStringList{"/somewhere/else.interreflect"});
    EXPECT_TRUE(RecentProjects(false).all().empty());
    recent.remove("/somewhere/else.interreflect");
}

}  // namespace
}  // namespace ir::gui
