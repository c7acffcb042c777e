#pragma once

#include <QListWidget>
#include <string>
#include <vector>

#include "projects/document.h"

namespace ir::widgets {

/// The experiments of the project, each with a tick where it takes part.
class ExperimentChecks : public QListWidget {
    Q_OBJECT
  public:
    explicit ExperimentChecks(const QString& name, QWidget* parent = nullptr);
    /// Those that take part and are not in the project are shown, too. Emits nothing.
    void show_experiments(const projects::Project& project, const std::vector<std::string>& chosen);

  signals:
    void ticked(const QString& experiment, bool is_in);

  private:
    bool showing_ = false;
};

}  // namespace ir::widgets
