#include "widgets/document/item_editor.h"

#include <QApplication>
#include <QLabel>
#include <QScrollArea>
#include <QStackedWidget>
#include <QVBoxLayout>

#include "widgets/document/analysis_editor.h"
#include "widgets/document/camera_editor.h"
#include "widgets/document/fields.h"
#include "widgets/document/light_set_editor.h"
#include "widgets/document/motion_editor.h"
#include "widgets/document/plain_editors.h"
#include "widgets/document/plot_editor.h"
#include "widgets/document/scene_editor.h"
#include "widgets/document/sweep_editor.h"
#include "widgets/style/section.h"

namespace ir::widgets {
namespace {

/// Whether the item is in the project.
bool is_there(const projects::Project& project, const ItemRef& item) {
    const std::string id = item.id.toStdString();
    const auto within = [&](const auto* owner, auto member) {
        return owner && item.index >= 0 && std::size_t(item.index) < (owner->*member).size();
    };
    switch (item.kind) {
        case ItemKind::project:
            return true;
        case ItemKind::scene:
            return find_item(project.scenes, id);
        case ItemKind::part:
            return within(find_item(project.scenes, id), &projects::Scene::parts);
        case ItemKind::camera:
            return find_item(project.cameras, id);
        case ItemKind::light_set:
            return find_item(project.lights, id);
        case ItemKind::light:
            return within(find_item(project.lights, id), &projects::LightSet::lights);
        case ItemKind::motion:
            return find_item(project.motion, id);
        case ItemKind::experiment:
            return find_item(project.experiments, id);
        case ItemKind::comparison:
            return find_item(project.comparisons, id);
        case ItemKind::image:
            return find_item(project.images, id);
        case ItemKind::sweep:
            return find_item(project.sweeps, id);
        case ItemKind::plot:
            return find_item(project.plots, id);
        case ItemKind::analysis:
            return find_item(project.analyses, id);
        default:
            return false;
    }
}

/// A page as wide as the dock, as long as it needs.
QScrollArea* scrolled(QWidget* page) {
    auto* area = new QScrollArea;
    area->setWidgetResizable(true);
    area->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    area->setFocusPolicy(Qt::NoFocus);
    area->setWidget(page);
    return area;
}

}  // namespace

ItemEditor::ItemEditor(QWidget* parent)
    : QWidget(parent), stack_(new QStackedWidget(this)), empty_(new QLabel(this)) {
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(stack_);
    empty_->setAlignment(Qt::AlignCenter);
    empty_->setWordWrap(true);
    empty_->setMargin(12);
    empty_->setForegroundRole(QPalette::PlaceholderText);
    stack_->addWidget(empty_);
    camera_ = new CameraEditor;
    comparison_ = new ComparisonEditor;
    scene_ = new SceneEditor;
    motion_ = new MotionEditor;
    lights_ = new LightSetEditor;
    connect(lights_, &LightSetEditor::light_chosen, this, &ItemEditor::update_light);
    connect(scene_, &SceneEditor::add_wanted, this, &ItemEditor::add_wanted);
    connect(scene_, &SceneEditor::pick_wanted, this, &ItemEditor::pick_wanted);
    add_form({ItemKind::project}, new ProjectEditor);
    add_form({ItemKind::scene, ItemKind::part}, scene_);
    add_form({ItemKind::camera}, camera_);
    add_form({ItemKind::light_set, ItemKind::light}, lights_);
    add_form({ItemKind::motion}, motion_);
    add_form({ItemKind::experiment}, new ExperimentEditor);
    add_form({ItemKind::comparison}, comparison_);
    add_form({ItemKind::image}, new ImageEditor);
    add_form({ItemKind::sweep}, new SweepEditor);
    add_form({ItemKind::plot}, new PlotEditor);
    add_form({ItemKind::analysis}, new AnalysisEditor);
    show_again();
}

ItemEditor::~ItemEditor() = default;

void ItemEditor::add_form(std::initializer_list<ItemKind> kinds, ItemForm* form) {
    static_cast<QBoxLayout*>(form->layout())->addStretch(1);  // forms stand at the top
    stack_->addWidget(scrolled(form));
    for (const ItemKind kind : kinds) forms_.emplace(kind, form);
    connect(form, &ItemForm::edit_wanted, this, [this](const EditMaker& make) {
        emit edit_wanted(make);
        show_again();  // what was refused goes back to what the document has
    });
    connect(form, &ItemForm::gesture_finished, this, &ItemEditor::gesture_finished);
    connect(form, &ItemForm::browse_wanted, this, [this](const ItemRef& item) {
        emit browse_wanted(item);
        show_again();
    });
}

void ItemEditor::set_project(const projects::Project& project, const Registry& registry, bool read_only,
                             const QString& why) {
    project_ = std::make_unique<projects::Project>(project);
    registry_ = &registry;
    read_only_ = read_only;
    why_read_only_ = why;
    show_again();
}

void ItemEditor::clear() {
    for (auto* notes : findChildren<NotesField*>()) notes->discard();
    project_.reset();
    item_ = {};
    show_again();
}

void ItemEditor::show_item(const ItemRef& item) {
    if (item == item_) return;
    commit();
    item_ = item;
    show_again();
}

void ItemEditor::set_scene_facts(const SceneFacts& facts) {
    facts_ = facts;
    show_again();
}

void ItemEditor::set_command_line(const CommandLine& command_line) {
    command_line_ = command_line;
    show_again();
}

void ItemEditor::set_view_pose(std::function<std::optional<CameraPose>()> pose) {
    camera_->set_view_pose(pose);
    motion_->set_view_pose(std::move(pose));
}

void ItemEditor::set_comparison_modes(const std::vector<Option>& modes) {
    comparison_->set_modes(modes);
    show_again();
}

void ItemEditor::commit() {
    if (!project_ || !is_there(*project_, item_)) return;
    auto* form = forms_.at(item_.kind);
    for (auto* field : form->findChildren<TextField*>()) field->commit();
    for (auto* field : form->findChildren<NotesField*>()) field->commit();
    auto* focus = QApplication::focusWidget();
    for (auto* field : form->findChildren<NumberField*>())
        if (focus && (field == focus || field->isAncestorOf(focus))) field->interpretText();
    emit gesture_finished();
}

void ItemEditor::show_surface(const ItemRef& part, const QString& material) {
    show_item(part);
    if (!project_ || !is_there(*project_, part)) return;
    auto* control = scene_->show_surface(part.index, material);
    unfold_section_of(*control);
    auto* page = static_cast<QScrollArea*>(scene_->parentWidget()->parentWidget());
    page->widget()->layout()->activate();
    page->ensureWidgetVisible(control, 0, page->viewport()->height() / 2);  // with the fields below it
    control->setFocus();
}

void ItemEditor::set_picking(bool on, const QString& why_not) {
    scene_->set_picking(on, why_not);
}

/// After every change of what is shown.
void ItemEditor::update_light() {
    const bool is_shown = project_ && is_there(*project_, item_) && forms_.at(item_.kind) == lights_;
    const auto light = is_shown ? lights_->chosen_light() : ItemRef();
    if (light == light_) return;
    light_ = light;
    emit light_chosen(light_);
}

void ItemEditor::show_again() {
    if (!project_ || !is_there(*project_, item_)) {
        empty_->setText(!project_ ? tr("No project is open.")
                                  : tr("Select an item of the project to edit it."));
        stack_->setCurrentWidget(empty_);
        return update_light();
    }
    auto* form = forms_.at(item_.kind);
    form->show_item({*project_, *registry_, facts_, read_only_, why_read_only_, command_line_}, item_);
    QWidget* page = form->parentWidget()->parentWidget();  // viewport, scroll area
    if (stack_->currentWidget() != page) stack_->setCurrentWidget(page);
    update_light();
}

}  // namespace ir::widgets
