#pragma once

#include <QWidget>

namespace ir::widgets {

/// A slider with two handles. Dragging a handle moves one end, dragging between them moves both; Left and
/// Right (or the wheel) step the whole range, Shift its upper end, Ctrl its lower end; from everything, a
/// step goes to the first or last value alone; Home and End are the first and last value; a double click is
/// everything.
class RangeSlider : public QWidget {
    Q_OBJECT
  public:
    explicit RangeSlider(QWidget* parent = nullptr);

    /// Ends of the track. Whole: values are whole numbers and a step is 1; else a step is a hundredth.
    void set_limits(double min, double max, bool whole);
    /// Shows a range; emits nothing.
    void set_range(double low, double high);
    double low() const { return low_; }
    double high() const { return high_; }
    double min() const { return min_; }
    double max() const { return max_; }
    bool is_all() const { return low_ <= min_ && high_ >= max_; }
    /// Where a value stands, logical pixels from the left.
    double position_of(double value) const;

    QSize sizeHint() const override;

  public slots:
    /// Steps the whole range as the keys do.
    void step(int steps);
    void choose_all();

  signals:
    void range_chosen(double low, double high);

  protected:
    void paintEvent(QPaintEvent*) override;
    void mousePressEvent(QMouseEvent*) override;
    void mouseMoveEvent(QMouseEvent*) override;
    void mouseReleaseEvent(QMouseEvent*) override;
    void mouseDoubleClickEvent(QMouseEvent*) override;
    void wheelEvent(QWheelEvent*) override;
    void keyPressEvent(QKeyEvent*) override;

  private:
    enum class Part { none, low, high, both };
    Part part_at(double x) const;
    double value_at(double x) const;
    double step_size() const;
    void step_end(Part part, int steps);
    void choose(double low, double high);

    double min_ = 0, max_ = 1, low_ = 0, high_ = 1;
    bool whole_ = false;
    Part dragged_ = Part::none;
    double press_value_ = 0, press_low_ = 0, press_high_ = 0;
};

}  // namespace ir::widgets
