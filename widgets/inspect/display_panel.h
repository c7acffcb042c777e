#pragma once

#include <QWidget>
#include <memory>

#include "widgets/image/display.h"

class QCheckBox;
class QComboBox;
class QGridLayout;
class QLabel;
class QSlider;
class QToolButton;

namespace ir::widgets {

class HistogramView;
class NumberField;

/// How the active view's buffer becomes colours, with the histogram of what is shown.
class DisplayPanel : public QWidget {
    Q_OBJECT
  public:
    explicit DisplayPanel(QWidget* parent = nullptr);
    /// The buffer of the active view; null: none. Emits nothing.
    void set_image(const QString& name, Semantic semantic, const QString& unit,
                   std::shared_ptr<const Image> image);
    /// `automatic`: nobody chose anything yet. Emits nothing.
    void set_display(const Display& display, bool automatic);
    const Display& display() const { return display_; }
    HistogramView& histogram() { return *histogram_; }

  signals:
    void display_chosen(const ir::widgets::Display& display);
    void automatic_chosen();

  private:
    void change(const Display& display);
    Display display_;
    HistogramView* histogram_;
};

}  // namespace ir::widgets
