#pragma once

#include <QStringList>
#include <filesystem>
#include <vector>

#include "widgets/panels/welcome_page.h"

namespace ir::gui {

/// Projects that were open before, newest first, kept between runs. Before them those that were never saved
/// when the program that edited them ended early.
class RecentProjects {
  public:
    /// Without `remember` there never are any.
    explicit RecentProjects(bool remember) : remember_(remember) {}
    QStringList paths() const;
    std::vector<widgets::RecentProject> all() const;
    void add(const QString& path);
    /// What was never saved goes to the desktop's bin.
    void remove(const QString& path);

  private:
    bool remember_;
};

/// In the user's data: where projects that were never saved are autosaved. Empty where there is no such
/// place.
std::filesystem::path unsaved_projects_folder();

/// The projects that come with the program, by path; name and description are the project's own.
std::vector<widgets::SampleProject> sample_projects();

/// Where a project keeps the picture that stands for it.
QString thumbnail_file(const QString& project);
inline constexpr int thumbnail_width = 256;

}  // namespace ir::gui
