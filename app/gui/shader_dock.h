#pragma once

#include <QWidget>
#include <filesystem>

#include "app/engine/machine_settings.h"
#include "app/gui/renderer.h"
#include "widgets/panels/shader_panel.h"

namespace ir::gui {

/// Shows what is wrong in shaders as long as it is, and what an experiment changes in them, and leads there.
class ShaderDock : public QWidget {
    Q_OBJECT
  public:
    /// The command of a person's editor, in which {file} and {line} are replaced.
    static constexpr const char* editor_variable = "INTERREFLECT_EDITOR";

    ShaderDock(const Renderer& renderer, const engine::MachineFlags& flags);
    widgets::ShaderPanel& panel() { return *panel_; }
    /// Of the shaders.
    const std::filesystem::path& folder() const { return folder_; }
    /// A file in the person's editor, else its place in the clipboard.
    void open(const QString& file, int line);

  signals:
    void wanted();   ///< there are errors now
    void emptied();  ///< there are none any more, and the panel had come by itself
    void copy_wanted(const ir::ShaderFault& fault);  ///< of which the place is in a copy
    void said(const QString& text);
    void failed(const QString& error);

  protected:
    void hideEvent(QHideEvent*) override;

  private:
    void update(const std::vector<ShaderFault>& faults);
    void go_to(const ShaderFault& fault);

    std::filesystem::path folder_;
    widgets::ShaderPanel* panel_;
    bool came_by_itself_ = false;
};

}  // namespace ir::gui
