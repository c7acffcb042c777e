#pragma once

#include <QObject>
#include <QTimer>
#include <filesystem>
#include <memory>
#include <string>

#include "projects/open_project.h"
#include "projects/sample_copy.h"
#include "projects/store.h"
#include "renderers/core/report.h"

namespace ir::gui {

class Session;

/// The open project on disk: opened, saved, saved by itself, recovered and closed, with session.json, which
/// remembers how it was looked at.
class ProjectFiles : public QObject {
    Q_OBJECT
  public:
    explicit ProjectFiles(Session& session);
    /// Where projects that were never saved are autosaved, from the next one on; at first
    /// unsaved_projects_folder().
    void set_unsaved_folder(const std::filesystem::path& folder) { unsaved_folder_ = folder; }

    // These throw Error with one line; the project that was open stays open then.
    /// A project's folder, also one that a crash left before the project was ever saved. The one that is open
    /// is closed and read again, if it can be read.
    void open(const std::filesystem::path& path);
    /// projects::put_aside(), also of the copy that is open, which stays open under its other name.
    std::filesystem::path put_aside(const projects::SampleCopy& copy);
    /// Not saved yet, with nothing to undo.
    void create_from_scene(const std::string& scene);
    void save(bool overwrite = false);
    void save_as(const std::filesystem::path& path);

    void add_scene(const std::string& scene);  ///< an edit
    /// An edit: a picture of another renderer. Returns whether it was added.
    bool add_image(const std::string& file);
    void take_recovery();  ///< can be undone
    void discard_recovery();
    void break_lock();
    /// Looks again whether scenes and images on disk are those of the project; files_changed() follows.
    void look_at_files();
    /// Writes unsaved changes beside the project, and session.json where it changed. A timer calls it, too.
    void autosave();
    void close();
    /// The program is told to end and asks nobody: what is not saved is written down, and offered when the
    /// project is opened again. Nothing should be changed afterwards.
    void leave();
    /// The program ends in order: what was never saved is dropped, unless it was left().
    void drop_unsaved();

    /// session.json: neither undone nor dirty.
    projects::Json& memory() { return memory_; }

  signals:
    /// What is known of the scenes and images on disk.
    void files_changed();
    /// memory() is about to be written: put into it what is to be remembered.
    void memory_wanted();
    void message(const ir::Message& message);

  private:
    bool is_open(const std::filesystem::path& folder) const;
    void adopt(std::unique_ptr<projects::OpenProject> project);
    void poll_files();
    void save_memory();
    void write_memory();

    Session& session_;
    projects::Json memory_ = projects::Json::object();
    projects::Json saved_memory_;  ///< as it is on disk
    std::filesystem::path unsaved_folder_;
    bool is_left_ = false;
    QTimer autosave_timer_;
};

}  // namespace ir::gui
