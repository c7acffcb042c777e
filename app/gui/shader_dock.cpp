#include "app/gui/shader_dock.h"

#include <QApplication>
#include <QClipboard>
#include <QHideEvent>
#include <QProcess>
#include <QVBoxLayout>
#include <algorithm>
#include <utility>

#include "app/gui/text_of.h"
#include "renderers/core/resources_path.h"

namespace ir::gui {

ShaderDock::ShaderDock(const Renderer& renderer, const engine::MachineFlags& flags)
    : folder_(flags.shaders.empty() ? shader_directory() : std::filesystem::absolute(flags.shaders)),
      panel_(new widgets::ShaderPanel(text_of(folder_.string()))) {
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(panel_);
    connect(&renderer, &Renderer::shader_faults_changed, this, &ShaderDock::update);
    connect(panel_, &widgets::ShaderPanel::place_chosen, this, &ShaderDock::go_to);
}

void ShaderDock::update(const std::vector<ShaderFault>& faults) {
    const bool had_none = panel_->faults().empty();
    panel_->set_faults(faults);
    if (had_none && !faults.empty()) {
        came_by_itself_ = parentWidget() && parentWidget()->isHidden();
        emit wanted();
    }
    if (faults.empty() && std::exchange(came_by_itself_, false)) emit emptied();
}

/// Whoever closes it and opens it again means to keep it.
void ShaderDock::hideEvent(QHideEvent* event) {
    QWidget::hideEvent(event);
    if (parentWidget() && parentWidget()->isHidden()) came_by_itself_ = false;
}

void ShaderDock::go_to(const ShaderFault& fault) {
    if (fault.is_changed) return emit copy_wanted(fault);
    open(text_of(fault.path), fault.line);
}

void ShaderDock::open(const QString& file, int number) {
    const auto line = QString::number(std::max(1, number));
    auto words = QProcess::splitCommand(qEnvironmentVariable(editor_variable));
    if (words.isEmpty()) {
        const auto place = file + QLatin1Char(':') + line;
        QApplication::clipboard()->setText(place);
        return emit said(tr("Copied %1. With %2='code -g {file}:{line}', for example, it is opened.")
                             .arg(place, QLatin1String(editor_variable)));
    }
    for (auto& word : words) word.replace("{file}", file).replace("{line}", line);
    const auto program = words.takeFirst();
    if (!QProcess::startDetached(program, words))
        emit failed(tr("cannot start %1; check %2").arg(program, QLatin1String(editor_variable)));
}

}  // namespace ir::gui
