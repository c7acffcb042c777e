#pragma once

#include <QWidget>
#include <functional>
#include <optional>
#include <vector>

#include "widgets/document/trs.h"

class QGridLayout;
class QLabel;
class QToolButton;

namespace ir::widgets {

class VectorField;

/// Where a part stands: translation, rotation and scale; or, for a matrix that is none of these, the matrix
/// as it is, which is kept until somebody resets it.
class TransformForm : public QWidget {
    Q_OBJECT
  public:
    using Transform = std::optional<Matrix>;  ///< absent: identity
    using Change = std::function<Transform(const Transform&)>;

    explicit TransformForm(QWidget* parent);
    void show_transform(const Transform& transform);
    void set_usable(const QString& why_not);

  signals:
    void change_wanted(const QString& field, const ir::widgets::TransformForm::Change& change, bool merges);
    void finished();

  private:
    VectorField* vector_row(QGridLayout* grid, const char* name, const QString& label, const QString& tip,
                            glm::dvec3 Trs::*member);
    QLabel* matrix_;
    VectorField *translation_, *rotation_, *scale_;
    std::vector<QWidget*> labels_;
    QToolButton* reset_;
    QString why_not_;
    Trs shown_;  ///< the numbers in the fields; several may give one matrix, so they stay while it does
};

}  // namespace ir::widgets
