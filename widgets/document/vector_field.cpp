#include <QColorDialog>
#include <QHBoxLayout>
#include <QLineEdit>
#include <QPainter>
#include <QToolButton>
#include <algorithm>
#include <cmath>

#include "widgets/document/fields.h"

namespace ir::widgets {
namespace {

// IEC 61966-2-1, the transfer function of sRGB.
double encoded(double linear) {
    const double v = std::clamp(linear, 0.0, 1.0);
    return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
}
double decoded(double encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

/// What is brighter than 1 is scaled down, so that its hue stays.
QColor shown_colour(const std::vector<double>& linear) {
    const double peak = std::max({linear[0], linear[1], linear[2], 1.0});
    return QColor::fromRgbF(float(encoded(linear[0] / peak)), float(encoded(linear[1] / peak)),
                            float(encoded(linear[2] / peak)));
}

/// The chosen colour, as bright as the old one where that was brighter than 1.
std::vector<double> with_colour(const std::vector<double>& old, const QColor& colour) {
    const double peak = std::max({old[0], old[1], old[2], 1.0});
    std::vector<double> result = old;
    const double components[3] = {colour.redF(), colour.greenF(), colour.blueF()};
    for (std::size_t i = 0; i < 3; ++i)
        result[i] = std::stod(QString::number(decoded(components[i]) * peak, 'g', 4).toStdString());
    return result;
}

QIcon patch_icon(const QColor& colour) {
    QPixmap picture(32, 32);
    picture.fill(colour);
    QPainter painter(&picture);
    painter.setPen(QPen(QColor(128, 128, 128), 2));  // white is seen on white
    painter.drawRect(picture.rect().adjusted(1, 1, -1, -1));
    painter.end();
    return picture;
}

}  // namespace

VectorField::VectorField(const QString& name, const QStringList& parts, QWidget* parent) : QWidget(parent) {
    setObjectName(name);
    auto* layout = new QHBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(3);
    for (int i = 0; i < parts.size(); ++i) {
        auto* field = new NumberField(this);
        field->setObjectName(QStringLiteral("%1.%2").arg(name, parts[i]));
        field->setAccessibleName(field->objectName());
        field->setButtonSymbols(QAbstractSpinBox::NoButtons);
        field->setMinimumWidth(parts.size() > 3 ? 36 : 44);
        layout->addWidget(field, 1);
        connect(field, &NumberField::chosen, this, [this, i](double value) { emit chosen(i, value); });
        connect(field, &NumberField::editingFinished, this, &VectorField::finished);
        parts_.push_back(field);
    }
    setFocusProxy(parts_.front());
}

void VectorField::set_range(const projects::Range& range) {
    for (auto* field : parts_) ir::widgets::set_range(field, range);
}

void VectorField::show_values(const std::vector<double>& values) {
    for (std::size_t i = 0; i < parts_.size(); ++i) parts_[i]->show_value(values[i]);
}

ColourField::ColourField(const QString& name, bool with_alpha, const projects::Range& range, QWidget* parent)
    : QWidget(parent),
      numbers_(new VectorField(
          name, with_alpha ? QStringList{"r", "g", "b", "a"} : QStringList{"r", "g", "b"}, this)),
      patch_(new QToolButton(this)),
      values_(with_alpha ? 4 : 3, 0.0) {
    setObjectName(QStringLiteral("colour:") + name);
    auto* layout = new QHBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(3);
    patch_->setIconSize(QSize(16, 16));
    patch_->setAutoRaise(true);
    patch_->setToolTip(tr("Choose a colour; numbers are linear RGB"));
    patch_->setAccessibleName(patch_->toolTip());
    layout->addWidget(numbers_, 1);
    layout->addWidget(patch_);
    setFocusProxy(numbers_);
    numbers_->set_range(range);
    connect(patch_, &QToolButton::clicked, this, &ColourField::choose);
    connect(numbers_, &VectorField::chosen, this, [this](int index, double value) {
        std::vector<double> values = values_;
        values[std::size_t(index)] = value;
        emit chosen(values);
    });
    connect(numbers_, &VectorField::finished, this, &ColourField::finished);
}

void ColourField::show_values(const std::vector<double>& values) {
    values_ = values;
    numbers_->show_values(values);
    patch_->setIcon(patch_icon(shown_colour(values)));
}

void ColourField::choose() {
    auto* dialog = new QColorDialog(shown_colour(values_), this);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setOption(QColorDialog::DontUseNativeDialog);
    const std::vector<double> before = values_;
    connect(dialog, &QColorDialog::currentColorChanged, this,
            [this, before](const QColor& colour) { emit chosen(with_colour(before, colour)); });
    connect(dialog, &QDialog::rejected, this, [this, before] { emit chosen(before); });
    connect(dialog, &QDialog::finished, this, &ColourField::finished);
    dialog->open();
}

}  // namespace ir::widgets
