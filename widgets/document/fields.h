#pragma once

#include <QComboBox>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QTimer>
#include <QWidget>
#include <vector>

#include "projects/fields.h"
#include "widgets/parameters/number_field.h"
#include "widgets/parameters/option.h"

class QGridLayout;
class QLabel;
class QToolButton;

/// What the forms are built from. Every field shows a value without emitting anything, emits `chosen` when a
/// person changed it and `finished` when that change is over.
namespace ir::widgets {

/// The tooltip that a control has as long as it can be used.
void set_tip(QWidget* control, const QString& tip);
/// Usable where `why_not` is empty; else disabled, with a tooltip that says why.
void set_usable(QWidget* control, const QString& why_not);

/// A row of the form: label and control, which share the tooltip.
QLabel* add_row(QGridLayout* grid, const QString& label, QWidget* control, const QString& tip);
/// A control over the form's whole width.
void add_wide(QGridLayout* grid, QWidget* control);
/// A section whose labels take no more room than they need.
QGridLayout* make_form_section(const QString& title, QWidget* parent);
QToolButton* make_button(const char* drawing, const QString& tip, QWidget* parent);
/// Is down as long as a click in a picture is waited for.
QToolButton* make_pick_button(const QString& tip, QWidget* parent);

void set_range(NumberField* field, const projects::Range& range);
/// One number with its unit and limits.
NumberField* make_number(const QString& name, const projects::FieldText& text, QWidget* parent);

/// Several numbers in a row: positions, directions, colours. They step by keys and wheel.
class VectorField : public QWidget {
    Q_OBJECT
  public:
    /// `parts` are what the numbers are called: {"x", "y", "z"}.
    VectorField(const QString& name, const QStringList& parts, QWidget* parent);
    void set_range(const projects::Range& range);
    void show_values(const std::vector<double>& values);
    NumberField* part(int index) const { return parts_[std::size_t(index)]; }

  signals:
    void chosen(int index, double value);
    void finished();

  private:
    std::vector<NumberField*> parts_;
};

/// Three or four linear components and a patch that shows the colour; a click on it opens a chooser.
class ColourField : public QWidget {
    Q_OBJECT
  public:
    ColourField(const QString& name, bool with_alpha, const projects::Range& range, QWidget* parent);
    void show_values(const std::vector<double>& values);
    VectorField* numbers() const { return numbers_; }
    const std::vector<double>& values() const { return values_; }

  signals:
    /// All components.
    void chosen(const std::vector<double>& values);
    void finished();

  private:
    void choose();
    VectorField* numbers_;
    QToolButton* patch_;
    std::vector<double> values_;
};

/// One line of text, taken on Enter or when left.
class TextField : public QLineEdit {
    Q_OBJECT
  public:
    TextField(const char* name, QWidget* parent);
    void show_text(const QString& text);
    void commit();  ///< takes over what is being typed
    /// What was typed cannot be taken over: it stays to be mended, and Escape drops it.
    void keep_refused(const QString& text);

  signals:
    void chosen(const QString& text);

  protected:
    bool event(QEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;

  private:
    QString shown_, refused_;
};

/// Notes of several lines, taken over as they are typed.
class NotesField : public QPlainTextEdit {
    Q_OBJECT
  public:
    NotesField(const char* name, QWidget* parent);
    void show_text(const QString& text);
    void commit();   ///< takes over what is being typed
    void discard();  ///< forgets it

  signals:
    void chosen(const QString& text);
    void finished();

  protected:
    bool event(QEvent* event) override;
    void focusOutEvent(QFocusEvent* event) override;

  private:
    QString shown_;
    QTimer pause_;
};

/// A list to choose from; the wheel belongs to the page unless it has the focus. A value that is not in the
/// list is shown as it is.
class ChoiceField : public QComboBox {
    Q_OBJECT
  public:
    ChoiceField(const char* name, QWidget* parent);
    void show_options(const std::vector<Option>& options, const QString& current);

  signals:
    void chosen(const QString& id);

  protected:
    void wheelEvent(QWheelEvent* event) override;

  private:
    std::vector<Option> options_;
};

}  // namespace ir::widgets
