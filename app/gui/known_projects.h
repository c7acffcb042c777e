#pragma once

#include <QStringList>
#include <vector>

#include "widgets/panels/welcome_page.h"

namespace ir::gui {

/// Projects that were open before, newest first, kept between runs.
class RecentProjects {
  public:
    /// Without `remember` there never are any.
    explicit RecentProjects(bool remember) : remember_(remember) {}
    QStringList paths() const;
    std::vector<widgets::RecentProject> all() const;
    void add(const QString& path);
    void remove(const QString& path);

  private:
    bool remember_;
};

/// The projects that come with the program, by path; name and description are the project's own.
std::vector<widgets::SampleProject> sample_projects();

/// Where a project keeps the picture that stands for it.
QString thumbnail_file(const QString& project);
inline constexpr int thumbnail_width = 256;

}  // namespace ir::gui
