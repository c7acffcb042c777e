#pragma once

#include <QWidget>
#include <functional>
#include <map>
#include <memory>
#include <optional>

#include "widgets/document/item_form.h"
#include "widgets/image/camera_motion.h"
#include "widgets/parameters/option.h"

class QLabel;
class QStackedWidget;

namespace ir::widgets {

class CameraEditor;
class ComparisonEditor;
class LightSetEditor;
class MotionEditor;
class SceneEditor;

/// Edits the item that is selected, whatever it is, by its values.
class ItemEditor : public QWidget {
    Q_OBJECT
  public:
    explicit ItemEditor(QWidget* parent = nullptr);
    ~ItemEditor() override;
    /// To be called after every change of the document. An item that is gone is no longer shown.
    void set_project(const projects::Project& project, const Registry& registry, bool read_only,
                     const QString& why);
    /// No project; what was being typed is dropped.
    void clear();
    void show_item(const ItemRef& item);
    const ItemRef& item() const { return item_; }

    /// Cameras and materials of the scene that is loaded.
    void set_scene_facts(const SceneFacts& facts);
    /// Where "take from the view" finds the pose; nullopt while there is no picture.
    void set_view_pose(std::function<std::optional<CameraPose>()> pose);
    void set_command_line(const CommandLine& command_line);
    /// Modes that comparisons may have, as the views call them.
    void set_comparison_modes(const std::vector<Option>& modes);
    /// Takes over what is being typed: before saving.
    void commit();
    /// Shows a part of a scene, which is in the project, and one of its materials, empty: none; the control
    /// that edits it gets the keyboard.
    void show_surface(const ItemRef& part, const QString& material);
    /// As SceneEditor has it.
    void set_picking(bool on, const QString& why_not);

  signals:
    void pick_wanted(bool on);  ///< as SceneEditor has it
    void edit_wanted(const ir::widgets::EditMaker& make);
    void gesture_finished();
    /// Another light's values are shown, alone or in its set; none: an item of another kind.
    void light_chosen(const ir::widgets::ItemRef& light);
    /// A file is to be chosen for a part, a foreign image or a set of lights' environment map; then
    /// makers::set_part_source and its like put it in.
    void browse_wanted(const ir::widgets::ItemRef& item);
    /// Another file is to be added to a scene, as ProjectPanel::add_wanted.
    void add_wanted(ir::widgets::ItemKind kind, const ir::widgets::ItemRef& owner);

  private:
    void add_form(std::initializer_list<ItemKind> kinds, ItemForm* form);
    void show_again();
    void update_light();

    std::unique_ptr<projects::Project> project_;  ///< a copy: what is shown, never changed here
    const Registry* registry_ = nullptr;
    bool read_only_ = false;
    QString why_read_only_;
    SceneFacts facts_;
    CommandLine command_line_;
    ItemRef item_, light_;
    std::map<ItemKind, ItemForm*> forms_;
    QStackedWidget* stack_;
    QLabel* empty_;
    CameraEditor* camera_;
    LightSetEditor* lights_;
    ComparisonEditor* comparison_;
    SceneEditor* scene_;
    MotionEditor* motion_;
};

}  // namespace ir::widgets
