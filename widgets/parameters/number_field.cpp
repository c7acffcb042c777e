#include "widgets/parameters/number_field.h"

#include <QKeyEvent>
#include <QSignalBlocker>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>

#include "widgets/style/number_text.h"

namespace ir::widgets {
namespace {

bool may_become_number(QChar c) {
    return c.isDigit() || QStringLiteral("+-.eE").contains(c);
}

class LetterFilter : public QObject {
  public:
    using QObject::QObject;

  protected:
    bool eventFilter(QObject*, QEvent* event) override {
        if (event->type() != QEvent::ShortcutOverride) return false;
        const auto* key = static_cast<QKeyEvent*>(event);
        const QString text = key->text();
        if (key->modifiers() & ~(Qt::ShiftModifier | Qt::KeypadModifier) || text.isEmpty() ||
            !text[0].isPrint() || may_become_number(text[0]))
            return false;
        event->ignore();
        return true;
    }
};

}  // namespace

void leave_letters_to_shortcuts(QAbstractSpinBox* field) {
    field->installEventFilter(new LetterFilter(field));
}

NumberField::NumberField(QWidget* parent) : QDoubleSpinBox(parent) {
    setDecimals(12);  // digits are cut by textFromValue, not by rounding the value
    setRange(-max_value, max_value);
    setKeyboardTracking(false);
    setFocusPolicy(Qt::StrongFocus);
    setLocale(QLocale::c());
    setMinimumWidth(84);
    leave_letters_to_shortcuts(this);
    connect(this, &QDoubleSpinBox::valueChanged, this, [this](double value) {
        if (!showing_) emit chosen(value);
    });
}

void NumberField::set_whole(bool whole) {
    whole_ = whole;
    setDecimals(whole ? 0 : 12);
}

void NumberField::show_value(double value) {
    showing_ = true;
    setValue(value);
    showing_ = false;
}

QString NumberField::textFromValue(double value) const {
    return whole_ ? QString::number(value, 'f', 0) : number_text(value);
}

QString NumberField::bare(QString text) const {
    constexpr int told = 3;  // letters: "texel" and "texels" are one unit
    const auto unit = suffix().trimmed().left(told);
    if (const auto at = unit.isEmpty() ? -1 : text.indexOf(unit); at > 0) text.truncate(at);
    return text.trimmed();
}

double NumberField::valueFromText(const QString& text) const {
    const QString typed = bare(text);
    if (is_special(typed)) return minimum();
    if (typed == textFromValue(value())) return value();  // untouched: keep the digits that are not shown
    return typed.toDouble();
}

QValidator::State NumberField::validate(QString& text, int&) const {
    const QString typed = bare(text);
    if (is_special(typed)) return QValidator::Acceptable;
    bool is_number = false;
    const double number = typed.toDouble(&is_number);
    if (is_number && std::isfinite(number)) {
        if (whole_ && number != std::floor(number)) return QValidator::Invalid;
        return number >= minimum() && number <= maximum() ? QValidator::Acceptable : QValidator::Intermediate;
    }
    return std::all_of(typed.begin(), typed.end(), may_become_number) ? QValidator::Intermediate
                                                                      : QValidator::Invalid;
}

void NumberField::fixup(QString& text) const {
    bool is_number = false;
    const double number = bare(text).toDouble(&is_number);
    if (is_number && std::isfinite(number))
        text = textFromValue(std::clamp(number, minimum(), maximum())) + suffix();
}

bool NumberField::event(QEvent* event) {
    if (event->type() == QEvent::ShortcutOverride) {
        const auto* key = static_cast<QKeyEvent*>(event);
        if (key->matches(QKeySequence::Undo) || key->matches(QKeySequence::Redo)) {
            event->ignore();
            return true;
        }
    }
    return QDoubleSpinBox::event(event);
}

void NumberField::stepBy(int steps) {
    // One step changes the second digit, so that 0.003 and 4000 both move sensibly.
    const double magnitude = std::abs(value());
    double step = magnitude == 0 ? 0.01 : std::pow(10, std::floor(std::log10(magnitude)) - 1);
    if (whole_) step = std::max(1.0, step);
    const double target = std::clamp(value() + steps * step, minimum(), maximum());
    setValue(whole_ ? std::round(target) : std::round(target / step) * step);
    selectAll();
}

void NumberField::wheelEvent(QWheelEvent* event) {
    hasFocus() ? QDoubleSpinBox::wheelEvent(event) : event->ignore();
}

}  // namespace ir::widgets
