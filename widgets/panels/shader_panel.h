#pragma once

#include <QWidget>
#include <vector>

#include "renderers/core/shader_fault.h"

class QLabel;
class QTextBrowser;

namespace ir::widgets {

/// What is wrong in shaders: file, line, the compiler's words and the line itself; and what an experiment
/// changes in them.
class ShaderPanel : public QWidget {
    Q_OBJECT
  public:
    /// `folder`: that is watched.
    explicit ShaderPanel(const QString& folder, QWidget* parent = nullptr);
    void set_faults(std::vector<ShaderFault> faults);
    const std::vector<ShaderFault>& faults() const { return faults_; }
    struct Changes {
        struct File {
            QString name, lines, hunks;  ///< lines: "+3 −1"
            QString path = {};           ///< of the copy that is edited; empty: none is open
            bool operator==(const File&) const = default;
        };
        QString experiment;  ///< its name
        QString on_host;     ///< passes that use no shaders, between commas
        std::vector<File> files;
        bool operator==(const Changes&) const = default;
    };
    void set_changes(Changes changes);
    QTextBrowser& list() { return *list_; }
    QString title() const;

  signals:
    void place_chosen(const ir::ShaderFault& fault);
    void copy_wanted();  ///< of a shader that is still to be chosen
    void edit_wanted(const QString& file);
    void path_wanted(const QString& file);     ///< of its copy, to paste it elsewhere
    void removal_wanted(const QString& file);  ///< of its change
    void opengl_wanted();                      ///< in place of the host

  private:
    void show_all();
    void follow_link(const QString& link);
    std::vector<ShaderFault> faults_;
    Changes changes_;
    QLabel* title_;
    QTextBrowser* list_;
};

}  // namespace ir::widgets
