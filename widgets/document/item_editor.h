#pragma once

#include <QWidget>
#include <map>

#include "widgets/document/item_form.h"
#include "widgets/parameters/experiment_panel.h"

class QLabel;
class QScrollArea;
class QStackedWidget;

namespace ir::widgets {

/// Edits the item that is selected, whatever it is, by its values.
class ItemEditor : public QWidget {
    Q_OBJECT
  public:
    explicit ItemEditor(QWidget* parent = nullptr);
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
    /// Modes that comparisons may have, as the views call them.
    void set_comparison_modes(const std::vector<Option>& modes);
    /// Takes over what is being typed: before saving.
    void commit();

  signals:
    void edit_wanted(const ir::widgets::EditMaker& make);
    void gesture_finished();
    void browse_wanted(const ir::widgets::ItemRef& item);

  private:
    void add_form(std::initializer_list<ItemKind> kinds, ItemForm* form);
    void show_again();

    std::unique_ptr<projects::Project> project_;  ///< a copy: what is shown, never changed here
    const Registry* registry_ = nullptr;
    bool read_only_ = false;
    QString why_read_only_;
    SceneFacts facts_;
    ItemRef item_;
    std::map<ItemKind, ItemForm*> forms_;
    QStackedWidget* stack_;
    QLabel *title_, *empty_;
    class CameraEditor* camera_;
    class ComparisonEditor* comparison_;
};

}  // namespace ir::widgets
