#pragma once

#include <QWidget>
#include <functional>
#include <memory>

#include "widgets/image/display.h"
#include "widgets/image/picture.h"

class QBoxLayout;
class QCheckBox;
class QComboBox;
class QGridLayout;
class QLabel;
class QPushButton;
class QSlider;
class QToolButton;

namespace ir::widgets {

class ColourMapBox;
class HistogramView;
class NumberField;

/// How the active view's buffer becomes colours, with the histogram of what is shown.
class DisplayPanel : public QWidget {
    Q_OBJECT
  public:
    explicit DisplayPanel(QWidget* parent = nullptr);
    /// The picture of the active view; null or without an image: none. Emits nothing.
    void set_picture(std::shared_ptr<const Picture> picture);
    /// The same of an image alone. What it points to must not change.
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
    void make_histogram(QBoxLayout* page);
    void make_colours(QGridLayout* grid);
    void make_range(QGridLayout* grid);
    void make_marks(QGridLayout* grid);
    QComboBox* add_choice(QGridLayout* grid, const char* name, const QString& label, const QString& tip,
                          std::function<void(Display&, int)> take);
    QCheckBox* add_switch(QGridLayout* grid, const char* name, const QString& label, const QString& tip,
                          bool Display::*member);
    NumberField* add_number(const char* name, const QString& tip, double Display::*member);
    /// A person changed something: shows and tells it.
    void choose(const Display& display);
    void fit(double low, double high);
    void fit_exposure();
    void update_channels();
    void update_controls();
    void update_counts();

    Display display_;
    bool automatic_ = true;
    std::shared_ptr<const Picture> picture_;  ///< one that has an image, or null
    QLabel *title_ = nullptr, *counts_ = nullptr;
    HistogramView* histogram_ = nullptr;
    QToolButton* logarithmic_ = nullptr;
    QComboBox *mode_ = nullptr, *channel_ = nullptr, *tone_map_ = nullptr;
    QSlider* exposure_slider_ = nullptr;
    NumberField *exposure_ = nullptr, *low_ = nullptr, *high_ = nullptr;
    ColourMapBox* map_ = nullptr;
    QPushButton *fit_exposure_ = nullptr, *fit_all_ = nullptr, *fit_most_ = nullptr, *symmetric_ = nullptr;
    QCheckBox *marks_ = nullptr, *negative_ = nullptr, *zebra_ = nullptr, *hide_invalid_ = nullptr;
    QPushButton* reset_ = nullptr;
    QWidget* controls_ = nullptr;
    /// Rows of the form that only some modes have: the widgets of each.
    QList<QWidget*> colour_rows_, range_rows_, map_rows_;
};

}  // namespace ir::widgets
