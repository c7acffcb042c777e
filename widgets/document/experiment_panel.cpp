#include "widgets/document/experiment_panel.h"

#include <QComboBox>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QRandomGenerator>
#include <QRegularExpressionValidator>
#include <QToolButton>
#include <QVBoxLayout>

#include "projects/document_fields.h"
#include "widgets/document/fields.h"
#include "widgets/panels/controls.h"
#include "widgets/style/icons.h"
#include "widgets/style/section.h"

namespace ir::widgets {
namespace {

const projects::FieldText& text_of(const char* key) {
    return projects::field_of(projects::experiment_fields(), key).text;
}

QString label_of(const char* key) {
    return QString::fromStdString(text_of(key).label);
}

/// With the chosen one's description.
void show_described(QComboBox* list, const std::vector<Option>& options, const QString& current) {
    show_options(list, options, current);
    list->setToolTip(list->currentData(Qt::ToolTipRole).toString());
}

}  // namespace

ExperimentPanel::ExperimentPanel(QWidget* parent) : QWidget(parent) {
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(2);
    grid_ = make_section(tr("Experiment"), this);
    experiment_ = add_list(tr("Name"), "experiment", &ExperimentPanel::experiment_chosen);
    editable_.clear();  // choosing what to look at is no edit
    menu_ = new QToolButton(this);
    menu_->setIcon(icon("menu"));
    menu_->setAutoRaise(true);
    menu_->setPopupMode(QToolButton::InstantPopup);
    menu_->setToolTip(tr("Add, duplicate, rename or remove experiments"));
    menu_->setAccessibleName(menu_->toolTip());
    menu_->setStyleSheet(QStringLiteral("QToolButton::menu-indicator { image: none; }"));
    grid_->addWidget(menu_, grid_->rowCount() - 1, 2);
    method_ = add_list(tr("Method"), "method", &ExperimentPanel::method_chosen);
    scene_ = add_list(tr("Scene"), "scene", &ExperimentPanel::scene_chosen);
    camera_ = add_list(tr("Camera"), "camera", &ExperimentPanel::camera_chosen);
    lights_ = add_list(tr("Lights"), "lights", &ExperimentPanel::lights_chosen);
    preset_ = add_list(tr("Preset"), "preset", &ExperimentPanel::preset_chosen);

    auto* size = new QWidget(this);
    auto* size_row = new QHBoxLayout(size);
    size_row->setContentsMargins(0, 0, 0, 0);
    size_row->setSpacing(4);
    const auto add_side = [&](const char* name) {
        auto* field = new NumberField(size);
        field->set_whole(true);
        widgets::set_range(field, text_of("size").range);
        field->setMinimumWidth(60);
        field->setObjectName(QLatin1String(name));
        size_row->addWidget(field, 1);
        connect(field, &NumberField::chosen, this, [this](double) {
            emit size_chosen({int(width_->value()), int(height_->value())});
        });
        return field;
    };
    width_ = add_side("width");
    size_row->addWidget(new QLabel(QStringLiteral("×"), size));
    height_ = add_side("height");
    add_row(label_of("size"), size);

    frames_ = add_number("frames");
    frames_->set_whole(true);
    connect(frames_, &NumberField::chosen, this, [this](double value) { emit frames_chosen(int(value)); });
    time_ = add_number("time");
    connect(time_, &NumberField::chosen, this, &ExperimentPanel::time_chosen);
    seed_ = new QLineEdit(this);
    seed_->setObjectName(QStringLiteral("seed"));
    seed_->setValidator(
        new QRegularExpressionValidator(QRegularExpression(QStringLiteral("[0-9]{1,20}")), seed_));
    connect(seed_, &QLineEdit::editingFinished, this, &ExperimentPanel::choose_seed);
    dice_ = new QToolButton(this);
    dice_->setIcon(icon("dice"));
    dice_->setAutoRaise(true);
    dice_->setToolTip(tr("Another random seed"));
    dice_->setAccessibleName(dice_->toolTip());
    connect(dice_, &QToolButton::clicked, this,
            [this] { emit seed_chosen(QRandomGenerator::global()->generate()); });
    editable_.push_back(dice_);
    add_row(label_of("seed"), seed_, dice_);
}

void ExperimentPanel::add_row(const QString& text, QWidget* editor, QWidget* button) {
    const int row = grid_->rowCount();
    auto* label = new QLabel(text, this);
    label->setBuddy(editor);
    editor->setAccessibleName(text);
    grid_->addWidget(label, row, 0);
    grid_->addWidget(editor, row, 1);
    if (button) grid_->addWidget(button, row, 2);
    editable_.push_back(editor);
}

QComboBox* ExperimentPanel::add_list(const QString& label, const char* name, Signal chosen) {
    auto* box = new QComboBox(this);
    box->setObjectName(QLatin1String(name));
    box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    box->setMinimumContentsLength(10);
    connect(box, &QComboBox::activated, this,
            [this, box, chosen](int index) { emit(this->*chosen)(box->itemData(index).toString()); });
    add_row(label, box);
    return box;
}

NumberField* ExperimentPanel::add_number(const char* key) {
    auto* field = make_number(QLatin1String(key), text_of(key), this);
    add_row(label_of(key), field);
    return field;
}

void ExperimentPanel::choose_seed() {
    bool is_number = false;
    const std::uint64_t seed = seed_->text().toULongLong(&is_number);
    if (!is_number || !seed_->isModified()) return;
    seed_->setModified(false);
    emit seed_chosen(seed);
}

void ExperimentPanel::set_fields(const ExperimentFields& fields) {
    show_described(experiment_, fields.experiments, fields.experiment);
    show_described(method_, fields.methods, fields.method);
    show_described(scene_, fields.scenes, fields.scene);
    show_described(camera_, fields.cameras, fields.camera);
    show_described(lights_, fields.lights, fields.light);
    show_described(preset_, fields.presets, fields.preset);
    width_->show_value(fields.size.width());
    height_->show_value(fields.size.height());
    frames_->show_value(fields.frames);
    time_->show_value(fields.time);
    if (!seed_->isModified()) seed_->setText(QString::number(fields.seed));
}

void ExperimentPanel::set_read_only(bool read_only, const QString& why) {
    for (auto* widget : editable_) {
        widget->setEnabled(!read_only);
        if (read_only) widget->setToolTip(why);
    }
}

void ExperimentPanel::set_menu(QMenu* menu) {
    menu_->setMenu(menu);
}

}  // namespace ir::widgets
