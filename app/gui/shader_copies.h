#pragma once

#include <QFileSystemWatcher>
#include <QObject>
#include <QTimer>
#include <filesystem>
#include <map>

#include "app/gui/session.h"

namespace ir::gui {

/// Copies of shader files that a person edits for an experiment, with an editor of their own. What is saved
/// in one becomes the experiment's change of that file, in steps that can be undone; what is undone leaves
/// the file again. They lie in the person's data.
class ShaderCopies : public QObject {
    Q_OBJECT
  public:
    /// `shaders`: the folder of what is copied.
    ShaderCopies(Session& session, std::filesystem::path shaders);

    /// The file of a copy, as the experiment has it. What was saved there while nobody watched is kept beside
    /// it as FILE.before. Throws Error.
    std::filesystem::path open(const std::string& experiment, const std::string& file);

  private:
    struct Copy {
        std::string experiment, file;
        std::string text;  ///< that file and experiment had last
    };
    std::filesystem::path folder() const;
    std::string text_of(const std::string& experiment, const std::string& file) const;
    void watch(const std::filesystem::path& path);
    void follow_files();
    void follow_document();

    Session& session_;
    std::filesystem::path shaders_;
    std::map<std::filesystem::path, Copy> copies_;
    QFileSystemWatcher watcher_;
    QTimer soon_;  ///< editors write in several steps
};

}  // namespace ir::gui
