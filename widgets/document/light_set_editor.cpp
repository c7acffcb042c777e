#include "widgets/document/light_set_editor.h"

#include <QCheckBox>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QMenu>
#include <QToolButton>
#include <algorithm>

#include "renderers/core/error.h"
#include "widgets/document/edit_maker.h"
#include "widgets/document/fields.h"
#include "widgets/document/light_form.h"
#include "widgets/document/makers.h"
#include "widgets/document/ordered_list.h"
#include "widgets/document/project_nodes.h"
#include "widgets/style/icons.h"

namespace ir::widgets {
namespace {

using projects::Environment;
using projects::LightSet;
using Type = projects::LightSpec::Type;

constexpr const char* scene_kind = "scene";
constexpr const char* constant_kind = "constant";
constexpr const char* map_kind = "map";

}  // namespace

LightSetEditor::LightSetEditor(QWidget* parent) : ItemForm(parent) {
    auto* grid = make_form_section(tr("Lights"), this);
    name_ = name_row(grid, ItemKind::light_set, tr("What the set is called"));
    make_list(grid);
    make_environment(make_form_section(tr("Environment"), this));
}

ItemRef LightSetEditor::light(int index) const {
    return {ItemKind::light, QString::fromStdString(id_), index};
}

QMenu* LightSetEditor::make_add_menu() {
    auto* menu = new QMenu(this);
    for (const auto type : projects::LightSpec::types) {
        auto* action = menu->addAction(icon("light"), light_name(type));
        action->setObjectName(QStringLiteral("add-light:") + QString::fromStdString(to_string(type)));
        connect(action, &QAction::triggered, this, [this, type] {
            chosen_ = int(lights_.size());
            emit edit_wanted(makers::add_light(id_, type));
        });
    }
    return menu;
}

void LightSetEditor::make_list(QGridLayout* grid) {
    scene_lights_ = new QCheckBox(tr("Use the scene's own lights"), this);
    scene_lights_->setObjectName(QStringLiteral("use-scene-lights"));
    set_tip(scene_lights_, tr("The lights of the scene's file shine beside those below"));
    add_wide(grid, scene_lights_);
    add_control(scene_lights_);
    connect(scene_lights_, &QCheckBox::clicked, this, [this](bool on) {
        emit edit_wanted(field_edit<LightSet>(
            id_, "lights", [on](LightSet& set) { set.use_scene_lights = on; }, false));
    });
    list_ = new OrderedList("lights", tr("light"), 0, this);
    list_->set_add_menu(make_add_menu());
    add_wide(grid, list_);
    connect(list_, &OrderedList::current_changed, this, [this](int index) {
        chosen_ = index;
        if (index >= 0) form_->show_light(lights_[std::size_t(index)]);
        emit light_chosen();
    });
    connect(list_, &OrderedList::duplicate_wanted, this, [this](int index) {
        chosen_ = index + 1;
        emit edit_wanted(makers::duplicate(light(index)));
    });
    connect(list_, &OrderedList::remove_wanted, this,
            [this](int index) { emit edit_wanted(makers::remove(light(index))); });
    connect(list_, &OrderedList::move_wanted, this, [this](int from, int to) {
        chosen_ = to;
        emit edit_wanted(makers::move(light(from), to));
    });
    hint_ = new QLabel(this);
    hint_->setWordWrap(true);
    hint_->setForegroundRole(QPalette::PlaceholderText);
    add_wide(grid, hint_);
    form_ = new LightForm(this);
    add_wide(grid, form_);
    connect(form_, &LightForm::finished, this, &LightSetEditor::gesture_finished);
    connect(form_, &LightForm::change_wanted, this,
            [this](const QString& field, const LightForm::Change& change, bool merges) {
                const int index = chosen_;
                const auto name = tr("light %1 %2").arg(index + 1).arg(field).toStdString();
                emit edit_wanted(field_edit<LightSet>(
                    id_, name,
                    [index, change](LightSet& set) {
                        if (index < 0 || std::size_t(index) >= set.lights.size())
                            throw UsageError("there is no such light any more");
                        change(set.lights[std::size_t(index)]);
                    },
                    merges));
            });
}

void LightSetEditor::make_environment(QGridLayout* grid) {
    environment_ = new ChoiceField("environment", this);
    row(grid, tr("Light"), environment_, tr("What shines from infinity, where rays leave the scene"));
    connect(environment_, &ChoiceField::chosen, this, &LightSetEditor::choose_environment);
    const auto& constant = projects::constant_environment_text();
    constant_ = new ColourField(QStringLiteral("environment-constant"), false, constant.range, this);
    constant_label_ = row(grid, constant, constant_);
    connect(constant_, &ColourField::chosen, this, [this](const std::vector<double>& c) {
        emit edit_wanted(field_edit<LightSet>(id_, "environment radiance", [c](LightSet& set) {
            set.environment.constant = {c[0], c[1], c[2]};
        }));
    });
    map_box_ = new QWidget(this);
    auto* layout = new QHBoxLayout(map_box_);
    layout->setContentsMargins(0, 0, 0, 0);
    map_ = new TextField("environment-map", map_box_);
    browse_ = make_button("open", tr("Choose a map …"), map_box_);
    browse_->setObjectName(QStringLiteral("browse"));
    layout->addWidget(map_, 1);
    layout->addWidget(browse_);
    map_box_->setFocusProxy(map_);
    map_label_ = row(grid, tr("Map"), map_box_,
                     tr("Equirectangular EXR or HDR picture in W/(m² sr), relative to the project's folder"));
    connect(map_, &TextField::chosen, this, [this](const QString& source) {
        emit edit_wanted(makers::set_environment_map(id_, source.toStdString()));
    });
    connect(browse_, &QToolButton::clicked, this, [this] {
        emit browse_wanted({ItemKind::light_set, QString::fromStdString(id_)});
    });
}

void LightSetEditor::choose_environment(const QString& kind) {
    // A map needs a file before it can be one.
    if (kind == QLatin1String(map_kind) && map_->text().isEmpty())
        return emit browse_wanted({ItemKind::light_set, QString::fromStdString(id_)});
    emit edit_wanted(field_edit<LightSet>(
        id_, "environment",
        [kind](LightSet& set) {
            set.environment.kind = kind == QLatin1String(map_kind)        ? Environment::Kind::map
                                   : kind == QLatin1String(constant_kind) ? Environment::Kind::constant
                                                                          : Environment::Kind::scene;
        },
        false));
}

void LightSetEditor::show_lights(const LightSet& set) {
    lights_ = set.lights;
    std::vector<OrderedList::Line> lines;
    for (std::size_t i = 0; i < set.lights.size(); ++i) {
        const auto& light = set.lights[i];
        lines.push_back(
            {QStringLiteral("%1  %2 · %3").arg(i + 1).arg(light_name(light.type), light_text(light)),
             QString::fromStdString(to_string(light))});
    }
    chosen_ = std::clamp(chosen_, 0, std::max(0, int(lines.size()) - 1));
    list_->show_lines(lines, chosen_);
    form_->setVisible(!lines.empty());
    hint_->setVisible(lines.empty());
    hint_->setText(set.use_scene_lights ? tr("No lights of its own: the scene's shine.")
                                        : tr("No lights: only emitters and the environment shine."));
    if (!lines.empty()) form_->show_light(set.lights[std::size_t(chosen_)]);
}

void LightSetEditor::show_environment(const Environment& environment) {
    const auto kind = environment.kind;
    environment_->show_options({{QLatin1String(scene_kind), tr("The scene's own"), {}},
                                {QLatin1String(constant_kind), tr("The same from everywhere"), {}},
                                {QLatin1String(map_kind), tr("A map"), {}}},
                               QLatin1String(kind == Environment::Kind::map        ? map_kind
                                             : kind == Environment::Kind::constant ? constant_kind
                                                                                   : scene_kind));
    constant_->show_values({environment.constant.x, environment.constant.y, environment.constant.z});
    map_->show_text(QString::fromStdString(environment.source));
    constant_->setVisible(kind == Environment::Kind::constant);
    constant_label_->setVisible(kind == Environment::Kind::constant);
    map_box_->setVisible(kind == Environment::Kind::map);
    map_label_->setVisible(kind == Environment::Kind::map);
}

void LightSetEditor::show_item(const ShownProject& shown, const ItemRef& item) {
    if (item != shown_item_) chosen_ = std::max(item.index, 0);
    shown_item_ = item;
    id_ = item.id.toStdString();
    const LightSet& set = *projects::find_item(shown.project.lights, id_);
    const QString why_not = shown.read_only ? shown.why_read_only : QString();
    set_controls_usable(why_not);
    list_->set_usable(why_not);
    form_->set_usable(why_not);
    name_->show_text(QString::fromStdString(set.name));
    scene_lights_->setChecked(set.use_scene_lights);
    show_lights(set);
    show_environment(set.environment);
}

}  // namespace ir::widgets
