#pragma once

#include <QWidget>

#include "widgets/image/display.h"

class QComboBox;
class QLabel;
class QToolButton;

namespace ir::widgets {

class NumberField;

/// How the shown buffer becomes colours: channel, exposure, or range and colour map, whichever counts.
class DisplayBar : public QWidget {
    Q_OBJECT
  public:
    explicit DisplayBar(QWidget* parent = nullptr);
    /// Shows the controls for an image; emits nothing.
    void set_image(const QString& name, Semantic semantic, int channels);
    void set_display(const Display& display, bool automatic);

  signals:
    void display_chosen(const ir::widgets::Display& display);
    void automatic_chosen();

  private:
    void update_controls();
    QLabel *name_, *exposure_label_, *range_label_;
    QComboBox *channel_, *map_;
    NumberField *exposure_, *low_, *high_;
    QToolButton* automatic_;
    Display display_;
};

}  // namespace ir::widgets
