#pragma once

#include <QDateTime>
#include <QImage>
#include <QString>
#include <QStringList>
#include <QWidget>
#include <vector>

class QVBoxLayout;

namespace ir::widgets {

/// A project that was open before.
struct RecentProject {
    QString path, name;  ///< without a name that of the folder
    QDateTime when;      ///< last opened or saved; invalid: not known
    QImage thumbnail;    ///< null: none
    bool missing = false;
};

/// A project that comes with the program.
struct SampleProject {
    QString path, name, description;
    QImage thumbnail;
};

/// What the window shows while no project is open.
class WelcomePage : public QWidget {
    Q_OBJECT
  public:
    explicit WelcomePage(QWidget* parent = nullptr);
    void set_samples(const std::vector<SampleProject>& samples);
    void set_recent(const std::vector<RecentProject>& projects);
    /// Paths alone; shown by name.
    void set_samples(const QStringList& paths);
    void set_recent(const QStringList& paths);

  signals:
    void new_chosen();
    void open_chosen();
    void scene_chosen();  ///< a .gltf or .glb file to start from
    void project_chosen(const QString& path);
    void recent_removed(const QString& path);

  private:
    QWidget* make_start();
    QVBoxLayout *samples_, *recent_;
};

}  // namespace ir::widgets
