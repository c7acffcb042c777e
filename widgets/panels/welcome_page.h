#pragma once

#include <QStringList>
#include <QWidget>

class QVBoxLayout;

namespace ir::widgets {

/// What the window shows while no project is open.
class WelcomePage : public QWidget {
    Q_OBJECT
  public:
    explicit WelcomePage(QWidget* parent = nullptr);
    /// Paths; shown by name, with the path as tooltip.
    void set_samples(const QStringList& paths);
    void set_recent(const QStringList& paths);

  signals:
    void new_chosen();
    void open_chosen();
    void project_chosen(const QString& path);

  private:
    void fill(QVBoxLayout* list, const QStringList& paths, const QString& empty);
    QVBoxLayout *samples_, *recent_;
};

}  // namespace ir::widgets
