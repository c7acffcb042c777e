#pragma once

#include <QFileSystemWatcher>
#include <QObject>
#include <QTimer>
#include <filesystem>
#include <map>
#include <vector>

#include "app/gui/session.h"

namespace ir::gui {

/// Whether changes that others have made in shaders wait for a person to allow them; and what is said then.
bool do_shaders_wait(const projects::Project& project);
QString first_allow();

/// Copies of shader files that a person edits for an experiment, with an editor of their own. What is saved
/// in one becomes the experiment's change of that file, in steps that can be undone; what is undone leaves
/// the file again. They lie in the person's data. What no change can be made of stays in the file; where
/// another text takes its place, it is kept beside it as FILE.before, and a message says so. Where the
/// program's shader has changed since, what is saved is a change of the new one.
class ShaderCopies : public QObject {
    Q_OBJECT
  public:
    /// `shaders`: the folder of what is copied.
    ShaderCopies(Session& session, std::filesystem::path shaders);
    ~ShaderCopies() override;

    /// The file of a copy, as the experiment has it. Throws Error.
    std::filesystem::path open(const std::string& experiment, const std::string& file);
    /// Copies of an experiment that were opened since the project was, by the file that they are of.
    std::map<std::string, std::filesystem::path> opened(const std::string& experiment) const;

  private:
    struct Copy {
        std::string experiment, file;
        std::vector<std::string> bases = {};  ///< the program's shader, as texts of the file were made of it
        std::string text = {};                ///< that file and experiment had last
        std::string refused = {};             ///< that the file had, and that can be no change
    };
    std::filesystem::path folder() const;
    std::string text_of(const std::string& experiment, const std::string& file) const;
    bool is_taken(const Copy& copy) const;        ///< by the experiment
    std::string base_of(const Copy& copy) const;  ///< the program's shader as it is
    void watch(const std::filesystem::path& path);
    void write(const std::filesystem::path& path, Copy& copy, std::string text);
    void take_up(const std::filesystem::path& path, Copy& copy, std::string text);
    void forget();
    void follow_files();
    void follow_document();

    Session& session_;
    std::filesystem::path shaders_;
    std::map<std::filesystem::path, Copy> copies_;
    QFileSystemWatcher watcher_;
    QTimer soon_;  ///< editors write in several steps
};

}  // namespace ir::gui
