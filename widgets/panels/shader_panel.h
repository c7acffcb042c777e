#pragma once

#include <QWidget>
#include <vector>

#include "renderers/core/shader_fault.h"

class QLabel;
class QTextBrowser;

namespace ir::widgets {

/// What is wrong in shaders: file, line, the compiler's words and the line itself.
class ShaderPanel : public QWidget {
    Q_OBJECT
  public:
    /// `folder`: that is watched.
    explicit ShaderPanel(const QString& folder, QWidget* parent = nullptr);
    void set_faults(std::vector<ShaderFault> faults);
    const std::vector<ShaderFault>& faults() const { return faults_; }
    QTextBrowser& list() { return *list_; }
    QString title() const;

  signals:
    void place_chosen(const ir::ShaderFault& fault);

  private:
    void show_faults();
    std::vector<ShaderFault> faults_;
    QLabel* title_;
    QTextBrowser* list_;
};

}  // namespace ir::widgets
