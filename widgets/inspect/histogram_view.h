#pragma once

#include <QWidget>
#include <atomic>
#include <memory>
#include <optional>

#include "widgets/image/picture.h"
#include "widgets/inspect/histogram.h"
#include "widgets/models/worker.h"

namespace ir::widgets {

/// Draws a histogram with two handles for the range that is shown. Big images are counted on another thread;
/// what is drawn belongs to the image and channel set last, or is greyed until that has been counted. The
/// wheel zooms the axis; a double click shows all of it again.
class HistogramView : public QWidget {
    Q_OBJECT
  public:
    /// Images of up to so many values are counted at once.
    static constexpr std::size_t at_once = 1u << 18;

    explicit HistogramView(QWidget* parent = nullptr);
    ~HistogramView() override;
    /// Null: nothing to show. What it points to must not change.
    void set_image(std::shared_ptr<const Image> image, Semantic semantic, int channel);
    /// The same of a picture: of its levels and layers without the gaps between them, and of the pixels that
    /// its mask includes. Null: nothing to show.
    void set_picture(std::shared_ptr<const Picture> picture, int channel);
    /// Shows the handles; emits nothing.
    void set_range(double low, double high);
    void set_range_shown(bool shown);
    void set_logarithmic(bool on);
    bool logarithmic() const { return logarithmic_; }
    /// Of the image set last; null while it is being counted and where there is none.
    const Histogram* current() const { return counted_ && picture_ ? &histogram_ : nullptr; }
    /// "65536 values, 2 NaN, 1 Inf, 14 negative, valid pixels: 6273 of 9216"
    QString summary() const;
    /// Where a value lies, in pixels of the widget.
    double x_of(double value) const;
    double value_at(double x) const;

    QSize sizeHint() const override { return {300, 140}; }
    QSize minimumSizeHint() const override { return {160, 90}; }

  signals:
    void counted();                               ///< current() is there
    void range_dragged(double low, double high);  ///< crossed handles turn the colours round

  protected:
    void paintEvent(QPaintEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void mouseDoubleClickEvent(QMouseEvent* event) override;
    void wheelEvent(QWheelEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    bool event(QEvent* event) override;

  private:
    enum class Handle { none, low, high };
    /// Counts the picture set last; called on any thread.
    static Histogram count_picture(const Picture& picture, int channel, const std::optional<Axis>& axis,
                                   const std::atomic<bool>* cancelled);
    void count();
    void start();
    void take(std::uint64_t serial, std::uint64_t generation, Histogram histogram);
    QRectF plot() const;
    Handle handle_at(QPointF position) const;
    void move_handle(Handle handle, double value);
    double handle_x(double value) const;
    void paint_bars(QPainter& painter) const;
    void paint_handles(QPainter& painter) const;
    void paint_labels(QPainter& painter) const;
    QString bin_text(double x) const;

    Worker worker_;
    std::atomic<bool> cancelled_ = false;
    std::uint64_t serial_ = 0;                ///< of the last change of anything
    std::uint64_t generation_ = 0;            ///< of the last change of more than pixel values
    std::shared_ptr<const Picture> picture_;  ///< one that has an image, or null
    int channel_ = -1;
    std::optional<Axis> zoom_;
    Histogram histogram_;
    bool counted_ = false, running_ = false, logarithmic_ = true, range_shown_ = true;
    double low_ = 0, high_ = 1;
    Handle dragged_ = Handle::none, active_ = Handle::low;
};

}  // namespace ir::widgets
