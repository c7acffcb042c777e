#pragma once

#include <QDoubleSpinBox>
#include <limits>

namespace ir::widgets {

/// Letters that no number has are shortcuts, as anywhere else in the window; a spin box would swallow them.
void leave_letters_to_shortcuts(QAbstractSpinBox* field);

/// A spin box that shows numbers in their shortest form, takes typed ones on Enter or when left, steps in
/// proportion to the value, and leaves the wheel to the page unless it has the focus. Undo and redo belong to
/// the document, not to the text that is being typed. Digits that are not shown are kept: showing a value
/// changes nothing.
class NumberField : public QDoubleSpinBox {
    Q_OBJECT
  public:
    /// What a renderer's numbers hold; sums of what is typed stay finite.
    static constexpr double max_value = std::numeric_limits<float>::max();

    explicit NumberField(QWidget* parent = nullptr);
    /// Whole numbers only.
    void set_whole(bool whole);
    /// Shows a value that the document has; emits nothing.
    void show_value(double value);

    QString textFromValue(double value) const override;
    double valueFromText(const QString& text) const override;
    QValidator::State validate(QString& text, int& position) const override;
    /// A number beyond a hard limit becomes the limit.
    void fixup(QString& text) const override;
    void stepBy(int steps) override;

  signals:
    /// A person chose this value.
    void chosen(double value);

  protected:
    bool event(QEvent* event) override;
    void wheelEvent(QWheelEvent*) override;

  private:
    QString bare(QString text) const;
    /// Whether it is the word that stands for the least value.
    bool is_special(const QString& text) const { return !text.isEmpty() && text == specialValueText(); }
    bool whole_ = false, showing_ = false;
};

}  // namespace ir::widgets
