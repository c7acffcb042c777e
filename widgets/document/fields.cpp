#include "widgets/document/fields.h"

#include <QGridLayout>
#include <QLabel>
#include <QToolButton>
#include <QWheelEvent>

#include "widgets/style/icons.h"
#include "widgets/style/section.h"

namespace ir::widgets {
namespace {

constexpr const char* tip_property = "tip";

void update_tip(QWidget* control, const QString& why_not) {
    const QString tip = control->property(tip_property).toString();
    control->setToolTip(why_not.isEmpty()
                            ? tip
                            : QStringLiteral("<p><i>%1</i></p><p>%2</p>").arg(why_not.toHtmlEscaped(), tip));
}

}  // namespace

void set_tip(QWidget* control, const QString& tip) {
    control->setProperty(tip_property, tip);
    control->setToolTip(tip);
}

void set_usable(QWidget* control, const QString& why_not) {
    control->setEnabled(why_not.isEmpty());
    update_tip(control, why_not);
}

QLabel* add_row(QGridLayout* grid, const QString& text, QWidget* control, const QString& tip) {
    const int row = grid->rowCount();
    auto* label = new QLabel(text, control->parentWidget());
    label->setBuddy(control);
    label->setToolTip(tip);
    set_tip(control, tip);
    if (control->accessibleName().isEmpty()) control->setAccessibleName(text);
    const bool is_tall = qobject_cast<NotesField*>(control) != nullptr;
    grid->addWidget(label, row, 0, is_tall ? Qt::AlignTop : Qt::Alignment());
    grid->addWidget(control, row, 1, 1, 2);
    return label;
}

void add_wide(QGridLayout* grid, QWidget* control) {
    grid->addWidget(control, grid->rowCount(), 0, 1, 3);
}

QGridLayout* make_form_section(const QString& title, QWidget* parent) {
    QGridLayout* grid = make_section(title, parent);
    grid->setColumnStretch(0, 0);
    grid->setColumnStretch(1, 1);
    grid->setColumnMinimumWidth(0, 64);
    return grid;
}

QToolButton* make_button(const char* drawing, const QString& tip, QWidget* parent) {
    auto* button = new QToolButton(parent);
    button->setIcon(icon(drawing));
    button->setAutoRaise(true);
    button->setAccessibleName(tip);
    set_tip(button, tip);
    return button;
}

QToolButton* make_pick_button(const QString& tip, QWidget* parent) {
    auto* button = make_button("inspect", tip, parent);
    button->setText(QObject::tr("Pick in view"));
    button->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    button->setCheckable(true);
    return button;
}

void set_range(NumberField* field, const projects::Range& range) {
    field->setRange(std::max(range.min, -field->max_value), std::min(range.max, field->max_value));
}

NumberField* make_number(const QString& name, const projects::FieldText& text, QWidget* parent) {
    auto* field = new NumberField(parent);
    field->setObjectName(name);
    set_range(field, text.range);
    if (!text.unit.empty()) field->setSuffix(QLatin1Char(' ') + QString::fromStdString(text.unit));
    return field;
}

ChoiceField::ChoiceField(const char* name, QWidget* parent) : QComboBox(parent) {
    setObjectName(QLatin1String(name));
    setFocusPolicy(Qt::StrongFocus);
    setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    setMinimumContentsLength(8);
    connect(this, &QComboBox::activated, this, [this](int index) {
        // Shown again when the document has it: a refused choice must not stay.
        emit chosen(itemData(index).toString());
    });
}

void ChoiceField::show_options(const std::vector<Option>& options, const QString& current) {
    std::vector<Option> wanted = options;
    const auto same = [&](const Option& option) { return option.id == current; };
    if (std::none_of(wanted.begin(), wanted.end(), same))
        wanted.push_back({current, current.isEmpty() ? tr("(none)") : tr("%1 (not found)").arg(current), {}});
    if (wanted != options_) {
        options_ = wanted;
        clear();
        for (const auto& option : wanted) {
            addItem(option.label, option.id);
            setItemData(count() - 1, option.tooltip, Qt::ToolTipRole);
        }
    }
    setCurrentIndex(findData(current));
}

void ChoiceField::wheelEvent(QWheelEvent* event) {
    hasFocus() ? QComboBox::wheelEvent(event) : event->ignore();
}

}  // namespace ir::widgets
