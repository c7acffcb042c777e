#include "widgets/metrics/rectangle_fields.h"

#include <QFocusEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QSignalBlocker>
#include <QSpinBox>
#include <QToolButton>
#include <algorithm>
#include <utility>

#include "widgets/parameters/number_field.h"
#include "widgets/style/icons.h"

namespace ir::widgets {
namespace {

/// Selects its number when the click that brings the focus ends, so that typing replaces it. At the press the
/// text's own cursor would undo it.
class ClickedField : public QSpinBox {
  public:
    explicit ClickedField(QWidget* parent) : QSpinBox(parent) { lineEdit()->installEventFilter(this); }

  protected:
    void focusInEvent(QFocusEvent* event) override {
        QSpinBox::focusInEvent(event);
        is_fresh_ = event->reason() == Qt::MouseFocusReason;
    }
    bool eventFilter(QObject* watched, QEvent* event) override {
        if (event->type() == QEvent::MouseButtonRelease && std::exchange(is_fresh_, false) &&
            !lineEdit()->hasSelectedText())
            QMetaObject::invokeMethod(this, &QSpinBox::selectAll, Qt::QueuedConnection);
        return QSpinBox::eventFilter(watched, event);
    }

  private:
    bool is_fresh_ = false;  ///< the focus came with the button that is down
};

QToolButton* button(QWidget* parent, const char* name, const char* icon_name, const QString& tip) {
    auto* result = new QToolButton(parent);
    result->setObjectName(QLatin1String(name));
    result->setIcon(icon(icon_name));
    result->setToolTip(tip);
    result->setAccessibleName(tip);
    result->setAutoRaise(true);
    return result;
}

}  // namespace

RectangleFields::RectangleFields(QWidget* parent) : QWidget(parent) {
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(3);
    const char* const names[] = {"rectangle-x", "rectangle-y", "rectangle-width", "rectangle-height"};
    const QString words[] = {tr("x"), tr("y"), tr("size"), QStringLiteral("×")};
    const QString tips[] = {tr("Left edge of the rectangle, pixels"), tr("Upper edge, pixels from the top"),
                            tr("Width, pixels"), tr("Height, pixels")};
    for (std::size_t i = 0; i < fields_.size(); ++i) {
        row->addWidget(new QLabel(words[i], this));
        auto* field = fields_[i] = new ClickedField(this);
        field->setObjectName(QLatin1String(names[i]));
        field->setToolTip(tips[i]);
        field->setAccessibleName(tips[i]);
        field->setKeyboardTracking(false);
        field->setButtonSymbols(QAbstractSpinBox::NoButtons);  // arrow keys and the wheel do it, too
        field->setAlignment(Qt::AlignRight);
        field->setMinimumWidth(38);
        leave_letters_to_shortcuts(field);
        connect(field, &QSpinBox::valueChanged, this, &RectangleFields::take);
        row->addWidget(field, 1);
    }
    draw_ = button(this, "draw", "rectangle", tr("Draw a rectangle in the picture (B)"));
    draw_->setCheckable(true);
    connect(draw_, &QToolButton::toggled, this, &RectangleFields::drawing_toggled);
    clear_ = button(this, "clear-rectangle", "cancel", tr("Measure the whole picture alone"));
    connect(clear_, &QToolButton::clicked, this, [this] { emit chosen({}); });
    row->addWidget(draw_);
    row->addWidget(clear_);
    show_numbers();
    show({}, {}, false);
}

void RectangleFields::show(QSize picture, const QRect& rectangle, bool drawing) {
    const bool other = picture != picture_ || rectangle != rectangle_;
    picture_ = picture;
    rectangle_ = rectangle;
    if (other) show_numbers();
    const QSignalBlocker quiet(draw_);
    draw_->setChecked(drawing);
    draw_->setEnabled(!picture.isEmpty());
    clear_->setEnabled(!rectangle.isEmpty());
}

void RectangleFields::show_numbers() {
    const QSize& picture = picture_;
    const QRect shown = rectangle_.isEmpty() ? QRect(QPoint(0, 0), picture) : rectangle_;
    const int values[] = {shown.x(), shown.y(), shown.width(), shown.height()};
    // A rectangle is moved as it is; where there is none, its corner is typed first.
    const QSize corner = rectangle_.isEmpty() ? QSize(1, 1) : rectangle_.size();
    const int limits[] = {picture.width() - corner.width(), picture.height() - corner.height(),
                          picture.width(), picture.height()};
    for (std::size_t i = 0; i < fields_.size(); ++i) {
        const QSignalBlocker quiet(fields_[i]);
        fields_[i]->setRange(i < 2 ? 0 : 1, std::max(i < 2 ? 0 : 1, limits[i]));
        fields_[i]->setValue(values[i]);
        fields_[i]->setEnabled(!picture.isEmpty());
    }
}

void RectangleFields::take() {
    const QRect typed(fields_[0]->value(), fields_[1]->value(), fields_[2]->value(), fields_[3]->value());
    emit chosen(typed & QRect(QPoint(0, 0), picture_));
    show_numbers();  // what was clipped, or was not taken
}

}  // namespace ir::widgets
