#include "widgets/document/transform_form.h"

#include <QFontDatabase>
#include <QGridLayout>
#include <QLabel>
#include <QToolButton>

#include "renderers/core/error.h"
#include "widgets/document/fields.h"
#include "widgets/document/short_forms.h"

namespace ir::widgets {
namespace {

QString matrix_text(const Matrix& m) {
    QStringList lines;
    for (std::size_t row = 0; row < 4; ++row) {
        QStringList cells;
        for (std::size_t column = 0; column < 4; ++column)
            cells << QString::number(m[column * 4 + row], 'g', 4).rightJustified(8);
        lines << cells.join(QLatin1Char(' '));
    }
    return lines.join(QLatin1Char('\n'));
}

/// The identity is written as no transform at all.
TransformForm::Transform without_identity(const Matrix& matrix) {
    return matrix == matrix_of(Trs{}) ? std::nullopt : std::optional(matrix);
}

}  // namespace

TransformForm::TransformForm(QWidget* parent) : QWidget(parent) {
    auto* grid = new QGridLayout(this);
    grid->setContentsMargins(0, 0, 0, 0);
    grid->setHorizontalSpacing(8);
    grid->setVerticalSpacing(4);
    grid->setColumnStretch(1, 1);
    grid->setColumnMinimumWidth(0, 64);
    translation_ = vector_row(grid, "translation", tr("Move"), tr("Translation along x, y, z in metres"),
                              &Trs::translation);
    rotation_ = vector_row(grid, "rotation", tr("Turn"),
                           tr("Rotation in degrees about the fixed x, then y, then z axis (XYZ order)"),
                           &Trs::rotation_degrees);
    scale_ = vector_row(grid, "scale", tr("Scale"),
                        tr("Factors along the file's own x, y, z; applied before it is turned and moved"),
                        &Trs::scale);
    setFocusProxy(translation_);
    matrix_ = new QLabel(this);
    matrix_->setObjectName(QStringLiteral("matrix"));
    matrix_->setFont(QFontDatabase::systemFont(QFontDatabase::FixedFont));
    matrix_->setTextInteractionFlags(Qt::TextSelectableByMouse);
    matrix_->setToolTip(
        tr("This matrix is not made of move, turn and scale alone (it shears or projects). It is "
           "kept to the last digit until it is reset."));
    add_wide(grid, matrix_);
    reset_ = make_button("reset", tr("Back to where the file has it"), this);
    reset_->setObjectName(QStringLiteral("reset-transform"));
    reset_->setText(tr("Reset placement"));
    reset_->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    add_wide(grid, reset_);
    connect(reset_, &QToolButton::clicked, this, [this] {
        emit change_wanted(
            tr("placement"), [](const Transform&) { return Transform(); }, false);
    });
}

VectorField* TransformForm::vector_row(QGridLayout* grid, const char* name, const QString& label,
                                       const QString& tip, glm::dvec3 Trs::*member) {
    auto* field = new VectorField(QLatin1String(name), xyz, this);
    labels_.push_back(add_row(grid, label, field, tip));
    connect(field, &VectorField::chosen, this, [this, name, member](int index, double value) {
        Trs wanted = shown_;
        (wanted.*member)[index] = value;
        const bool moves = member == &Trs::translation;
        // Shown now, so that the document's answer finds the very numbers that were typed.
        shown_ = wanted;
        emit change_wanted(
            QLatin1String(name),
            [=](const Transform& present) {
                if (wanted.scale.x * wanted.scale.y * wanted.scale.z == 0)
                    throw UsageError("a scale of 0 would flatten the part; give another number");
                Matrix matrix = present.value_or(matrix_of(Trs{}));
                if (!moves) return without_identity(matrix_of(wanted));
                matrix[std::size_t(12 + index)] = value;  // the rest stays to the last digit
                return without_identity(matrix);
            },
            true);
    });
    connect(field, &VectorField::finished, this, &TransformForm::finished);
    return field;
}

void TransformForm::set_usable(const QString& why_not) {
    why_not_ = why_not;
    for (QWidget* field : std::initializer_list<QWidget*>{translation_, rotation_, scale_})
        ir::widgets::set_usable(field, why_not);
}

void TransformForm::show_transform(const Transform& transform) {
    const Matrix matrix = transform.value_or(matrix_of(Trs{}));
    std::optional<Trs> trs = shown_;
    if (!nearly_equal(matrix, matrix_of(shown_))) trs = trs_of(matrix);
    for (QWidget* widget : std::initializer_list<QWidget*>{translation_, rotation_, scale_})
        widget->setVisible(trs.has_value());
    for (QWidget* label : labels_) label->setVisible(trs.has_value());
    matrix_->setVisible(!trs.has_value());
    matrix_->setText(matrix_text(matrix));
    ir::widgets::set_usable(reset_, !why_not_.isEmpty() ? why_not_
                                    : transform         ? QString()
                                                        : tr("It stands where the file has it."));
    if (!trs) return;
    shown_ = *trs;
    translation_->show_values(numbers(trs->translation));
    rotation_->show_values(numbers(trs->rotation_degrees));
    scale_->show_values(numbers(trs->scale));
}

}  // namespace ir::widgets
