#pragma once

#include <QStringList>
#include <QTemporaryDir>
#include <filesystem>
#include <optional>
#include <vector>

#include "projects/sample_copy.h"
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
    /// Remembered as an absolute path: the next run may begin in another folder.
    void add(const QString& path);
    /// What was never saved goes to the desktop's bin.
    void remove(const QString& path);

  private:
    bool remember_;
};

/// In the user's data: where projects that were never saved are autosaved. Empty where there is no such
/// place.
std::filesystem::path unsaved_projects_folder();
/// Of shaders that are edited for experiments; empty where there is no such place.
std::filesystem::path shader_copies_folder();

/// The projects that come with the program. They are worked on in copies in the user's data, so that nothing
/// is written where the program is installed.
class Samples {
  public:
    /// Without `remember` copies go with the program, and none of the user's is looked at.
    explicit Samples(bool remember);
    /// In the order of the samples' index; name and description are the project's own.
    std::vector<widgets::SampleProject> all(bool with_pictures = true) const;
    static bool contains(const std::filesystem::path& path);
    projects::SampleCopy copy(const std::filesystem::path& sample) const;  ///< throws Error

  private:
    std::filesystem::path place() const;
    std::optional<QTemporaryDir> temporary_;
};

/// Where a project keeps the picture that stands for it.
QString thumbnail_file(const QString& project);
/// That picture; else the one that a sample came with. Null where there is neither, and for what leads out of
/// the project, is no regular file, or is larger than such pictures are.
QImage thumbnail_of(const QString& project);
inline constexpr QSize largest_thumbnail{256, 512};

}  // namespace ir::gui
