#include "widgets/document/item_form.h"

#include <QVBoxLayout>

#include "widgets/document/fields.h"
#include "widgets/document/makers.h"

namespace ir::widgets {

ItemForm::ItemForm(QWidget* parent) : QWidget(parent) {
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(2);
}

QLabel* ItemForm::row(QGridLayout* grid, const QString& label, QWidget* control, const QString& tip) {
    auto* text = add_row(grid, label, control, tip);
    add_control(control);
    return text;
}

QLabel* ItemForm::row(QGridLayout* grid, const projects::FieldText& text, QWidget* control) {
    return row(grid, QString::fromStdString(text.label), control, QString::fromStdString(text.doc));
}

void ItemForm::add_control(QWidget* control) {
    controls_.push_back(control);
    watch(control);
}

void ItemForm::watch(QWidget* field) {
    if (auto* number = qobject_cast<NumberField*>(field))
        connect(number, &NumberField::editingFinished, this, &ItemForm::gesture_finished);
    if (auto* vector = qobject_cast<VectorField*>(field))
        connect(vector, &VectorField::finished, this, &ItemForm::gesture_finished);
    if (auto* colour = qobject_cast<ColourField*>(field))
        connect(colour, &ColourField::finished, this, &ItemForm::gesture_finished);
    if (auto* notes = qobject_cast<NotesField*>(field))
        connect(notes, &NotesField::finished, this, &ItemForm::gesture_finished);
}

void ItemForm::set_controls_usable(const QString& why_not) {
    for (auto* control : controls_) set_usable(control, why_not);
}

TextField* ItemForm::name_row(QGridLayout* grid, ItemKind kind, const QString& tip) {
    auto* field = new TextField("name", this);
    row(grid, tr("Name"), field, tip);
    connect(field, &TextField::chosen, this, [this, kind](const QString& name) {
        const ItemRef item{kind, QString::fromStdString(id_)};
        emit edit_wanted(makers::rename(item, name.toStdString()));
    });
    return field;
}

}  // namespace ir::widgets
