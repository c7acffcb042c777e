#pragma once

#include "widgets/document/item_form.h"
#include "widgets/image/camera_motion.h"

class QToolButton;

namespace ir::widgets {

class ChoiceField;
class NumberField;
class VectorField;

/// A camera: one of the scene's file by name, or a pose of its own by numbers and as one line of text.
class CameraEditor : public ItemForm {
    Q_OBJECT
  public:
    explicit CameraEditor(QWidget* parent = nullptr);
    void show_item(const ShownProject& shown, const ItemRef& item) override;
    /// Where "take from the view" finds the pose; nullopt while there is no picture.
    void set_view_pose(std::function<std::optional<CameraPose>()> pose);

  private:
    void make_pose_rows(QGridLayout* grid);
    void make_text_rows(QGridLayout* grid);
    void show_sources(const ShownProject& shown, const projects::Camera& camera);
    void show_pose(bool is_known);
    void choose_source(const QString& name);
    void take_text(const QString& text);
    struct NumberRow {
        QLabel* label;
        NumberField* control;
        const projects::Field<projects::Camera>* field;
    };
    VectorField* vector_row(QGridLayout* grid, const std::string& key);
    NumberRow number_row(QGridLayout* grid, const std::string& key);

    TextField *name_, *text_;
    ChoiceField *source_, *projection_;
    VectorField *eye_, *target_, *up_;
    std::vector<NumberRow> numbers_;  ///< one counts in each projection
    QLabel* hint_;
    QToolButton *copy_, *paste_, *from_view_;
    std::function<std::optional<CameraPose>()> view_pose_;
    CameraPose pose_;      ///< that is shown
    QString source_name_;  ///< of the file's camera; empty: its own pose
    std::map<QString, CameraPose> file_poses_;
    std::vector<QWidget*> pose_rows_;  ///< labels and controls
};

}  // namespace ir::widgets
