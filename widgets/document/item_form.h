#pragma once

#include <QWidget>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "projects/document_fields.h"
#include "widgets/document/edit_maker.h"
#include "widgets/document/item_ref.h"
#include "widgets/image/camera_motion.h"

class QGridLayout;
class QLabel;

namespace ir::widgets {

class TextField;

/// A material of a part's file, as the file has it; absent members are not known.
struct MaterialFacts {
    QString name;
    projects::MaterialOverride values = {};
};

/// What only the one who loaded a scene knows about it. Whatever is missing is offered as free text.
struct SceneFacts {
    QString scene;                                           ///< id of the scene that this is about
    QStringList cameras = {};                                ///< names of the file's cameras
    std::vector<std::vector<MaterialFacts>> materials = {};  ///< part by part
    std::map<QString, CameraPose> poses = {};                ///< of those cameras, as far as known
    std::vector<QStringList> variants = {};                  ///< of the materials, part by part
};

/// How the project is found from a terminal.
struct CommandLine {
    QString program = QStringLiteral("interreflect-cli");
    QString folder = {};    ///< of the project; empty: it was never saved
    bool is_saved = false;  ///< whether what is shown is what the folder holds
};

/// The project as the forms see it while they are shown one.
struct ShownProject {
    const projects::Project& project;
    const Registry& registry;
    const SceneFacts& facts;
    bool read_only = false;
    QString why_read_only = {};
    CommandLine command_line = {};
};

/// One item by its values. A field that is spun or dragged gives one undo step; another field, Enter or
/// leaving begins a new one.
class ItemForm : public QWidget {
    Q_OBJECT
  public:
    explicit ItemForm(QWidget* parent);
    /// Shows the item, which is in the project; emits nothing.
    virtual void show_item(const ShownProject& shown, const ItemRef& item) = 0;

  signals:
    void edit_wanted(const ir::widgets::EditMaker& make);
    void gesture_finished();
    /// A file is to be chosen for this item: a part's, an image's, a set of lights' environment map.
    void browse_wanted(const ir::widgets::ItemRef& item);

  protected:
    /// A row whose control edits the document. `tip` says what it means.
    QLabel* row(QGridLayout* grid, const QString& label, QWidget* control, const QString& tip);
    QLabel* row(QGridLayout* grid, const projects::FieldText& text, QWidget* control);
    /// Controls outside rows that edit the document.
    void add_control(QWidget* control);
    /// Ends the undo step when the field is done.
    void watch(QWidget* field);
    /// All controls; where `why_not` is not empty they are disabled and say why.
    void set_controls_usable(const QString& why_not);
    /// A name, for kinds whose items have one.
    TextField* name_row(QGridLayout* grid, ItemKind kind, const QString& tip);

    std::string id_;  ///< of the item that is shown

  private:
    std::vector<QWidget*> controls_;
};

}  // namespace ir::widgets
