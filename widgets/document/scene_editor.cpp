#include "widgets/document/scene_editor.h"

#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QToolButton>
#include <algorithm>

#include "renderers/core/error.h"
#include "widgets/document/edit_maker.h"
#include "widgets/document/fields.h"
#include "widgets/document/makers.h"
#include "widgets/document/material_form.h"
#include "widgets/document/ordered_list.h"
#include "widgets/document/project_nodes.h"
#include "widgets/document/transform_form.h"

namespace ir::widgets {
namespace {

using projects::Scene;
using projects::ScenePart;

/// Changes one part; throws where it is gone.
template <class Change>
auto part_change(int index, Change change) {
    return [index, change](Scene& scene) {
        if (index < 0 || std::size_t(index) >= scene.parts.size())
            throw UsageError("there is no such part any more");
        change(scene.parts[std::size_t(index)]);
    };
}

/// What changes nothing any more is not written; keys that are not known are kept.
void drop_if_empty(ScenePart& part, const std::string& material) {
    if (part.materials[material] == projects::MaterialOverride{}) part.materials.erase(material);
}

}  // namespace

SceneEditor::SceneEditor(QWidget* parent) : ItemForm(parent) {
    auto* grid = make_form_section(tr("Scene"), this);
    name_ = name_row(grid, ItemKind::scene, tr("What the scene is called"));
    make_list(grid);
    make_part();
}

ItemRef SceneEditor::part(int index) const {
    return {ItemKind::part, QString::fromStdString(id_), index};
}

void SceneEditor::make_list(QGridLayout* grid) {
    list_ = new OrderedList("parts", tr("file"), 1, this);
    add_wide(grid, list_);
    connect(list_, &OrderedList::current_changed, this, [this](int index) {
        chosen_ = index;
        if (index >= 0) show_part();
    });
    connect(list_, &OrderedList::add_wanted, this, [this] {
        chosen_ = int(parts_.size());
        emit add_wanted(ItemKind::part, {ItemKind::scene, QString::fromStdString(id_)});
    });
    connect(list_, &OrderedList::duplicate_wanted, this, [this](int index) {
        chosen_ = index + 1;
        emit edit_wanted(makers::duplicate(part(index)));
    });
    connect(list_, &OrderedList::remove_wanted, this,
            [this](int index) { emit edit_wanted(makers::remove(part(index))); });
    connect(list_, &OrderedList::move_wanted, this, [this](int from, int to) {
        chosen_ = to;
        emit edit_wanted(makers::move(part(from), to));
    });
    auto* box = new QWidget(this);
    auto* layout = new QHBoxLayout(box);
    layout->setContentsMargins(0, 0, 0, 0);
    source_ = new TextField("source", box);
    browse_ = make_button("open", tr("Choose another file …"), box);
    browse_->setObjectName(QStringLiteral("browse"));
    layout->addWidget(source_, 1);
    layout->addWidget(browse_);
    box->setFocusProxy(source_);
    row(grid, tr("File"), box, tr("glTF file relative to the project's folder, or builtin:NAME@VERSION"));
    connect(source_, &TextField::chosen, this, [this](const QString& source) {
        emit edit_wanted(makers::set_part_source(id_, chosen_, source.toStdString()));
    });
    connect(browse_, &QToolButton::clicked, this, [this] { emit browse_wanted(part(chosen_)); });
    make_variant(grid);
}

/// Shown only where the file has variants, or the part names one.
void SceneEditor::make_variant(QGridLayout* grid) {
    const auto& text = projects::field_of(projects::part_fields(), "variant").text;
    variant_ = new ChoiceField("variant", this);
    variant_label_ = row(grid, text, variant_);
    connect(variant_, &ChoiceField::chosen, this, [this](const QString& name) {
        const auto put = [name](ScenePart& part) { part.variant = name.toStdString(); };
        emit edit_wanted(field_edit<Scene>(id_, tr("variant of part %1").arg(chosen_ + 1).toStdString(),
                                           part_change(chosen_, put), false));
    });
}

void SceneEditor::make_part() {
    transform_ = new TransformForm(this);
    auto* placement = make_form_section(tr("Placement of the file"), this);
    pick_ = make_pick_button(tr("The next click in a picture chooses the file"), this);
    pick_->setObjectName(QStringLiteral("pick-part"));
    placement->addWidget(pick_, 0, 0, 1, 3);
    add_wide(placement, transform_);
    connect(transform_, &TransformForm::finished, this, &SceneEditor::gesture_finished);
    connect(transform_, &TransformForm::change_wanted, this,
            [this](const QString& field, const TransformForm::Change& change, bool merges) {
                const auto name = tr("part %1 %2").arg(chosen_ + 1).arg(field).toStdString();
                const auto put = [change](ScenePart& part) { part.transform = change(part.transform); };
                emit edit_wanted(field_edit<Scene>(id_, name, part_change(chosen_, put), merges));
            });
    materials_ = new MaterialForm(this);
    for (auto* button : {pick_, materials_->pick()})
        connect(button, &QToolButton::clicked, this, &SceneEditor::pick_wanted);
    add_wide(make_form_section(tr("Changed materials"), this), materials_);
    connect(materials_, &MaterialForm::finished, this, &SceneEditor::gesture_finished);
    connect(materials_, &MaterialForm::change_wanted, this,
            [this](const QString& material, const QString& field, const MaterialForm::Change& change,
                   bool merges) {
                const std::string key = material.toStdString();
                const auto name = tr("%1 of material '%2'").arg(field, material).toStdString();
                const auto put = [change, key](ScenePart& part) {
                    change(part.materials[key]);
                    drop_if_empty(part, key);
                };
                emit edit_wanted(field_edit<Scene>(id_, name, part_change(chosen_, put), merges));
            });
}

void SceneEditor::show_variant(const QStringList& known, const QString& chosen) {
    std::vector<Option> options{{QString(), tr("default materials"), QString()}};
    for (const auto& name : known) options.push_back({name, name, QString()});
    variant_->show_options(options, chosen);
    const bool has_choice = options.size() > 1 || !chosen.isEmpty();
    variant_->setVisible(has_choice);
    variant_label_->setVisible(has_choice);
}

void SceneEditor::show_part() {
    const ScenePart& shown = parts_[std::size_t(chosen_)];
    source_->show_text(QString::fromStdString(shown.source));
    source_->setCursorPosition(0);
    transform_->show_transform(shown.transform);
    const auto of_part = [this]<class Fact>(const std::vector<Fact>& facts) {
        const bool is_known = facts_.scene.toStdString() == id_ && facts.size() > std::size_t(chosen_);
        return is_known ? facts[std::size_t(chosen_)] : Fact();
    };
    show_variant(of_part(facts_.variants), QString::fromStdString(shown.variant));
    materials_->show_materials(shown.materials, of_part(facts_.materials));
}

void SceneEditor::show_item(const ShownProject& shown, const ItemRef& item) {
    if (item != shown_item_) chosen_ = std::max(item.index, 0);
    shown_item_ = item;
    id_ = item.id.toStdString();
    const Scene& scene = *projects::find_item(shown.project.scenes, id_);
    parts_ = scene.parts;
    facts_ = shown.facts;
    const QString why_not = shown.read_only ? shown.why_read_only : QString();
    set_controls_usable(why_not);
    list_->set_usable(why_not);
    transform_->set_usable(why_not);
    materials_->set_usable(why_not);
    name_->show_text(QString::fromStdString(scene.name));
    show_parts();
}

void SceneEditor::show_parts() {
    std::vector<OrderedList::Line> lines;
    for (const auto& part : parts_)
        lines.push_back({source_name(part.source), QString::fromStdString(part.source)});
    chosen_ = std::clamp(chosen_, 0, std::max(0, int(lines.size()) - 1));
    list_->show_lines(lines, chosen_);
    if (!parts_.empty()) show_part();
}

QWidget* SceneEditor::show_surface(int part, const QString& material) {
    chosen_ = part;
    show_parts();
    if (material.isEmpty()) return transform_;
    materials_->show_material(material);
    return materials_->names();
}

void SceneEditor::set_picking(bool on, const QString& why_not) {
    for (auto* button : {pick_, materials_->pick()}) {
        button->setChecked(on);
        ir::widgets::set_usable(button, why_not);
    }
}

}  // namespace ir::widgets
