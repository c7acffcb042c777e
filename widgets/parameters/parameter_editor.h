#pragma once

#include <QWidget>

#include "renderers/core/parameter.h"

namespace ir::widgets {

/// Edits one parameter: made from its description, shows its value, reports what a person chose.
class ParameterEditor : public QWidget {
    Q_OBJECT
  public:
    explicit ParameterEditor(QWidget* parent) : QWidget(parent) {}
    /// Emits nothing.
    virtual void show_value(const Value& value) = 0;

  signals:
    void chosen(const ir::Value& value);
    /// The hand let go of a slider, or a single choice was made.
    void finished();
};

/// The editor for the parameter's type: toggle, combo box, number with or without slider.
ParameterEditor* make_editor(const ParameterDescription& parameter, QWidget* parent);

}  // namespace ir::widgets
