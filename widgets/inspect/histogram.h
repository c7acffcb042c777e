#pragma once

#include <QThreadPool>
#include <QWidget>
#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include "renderers/core/output.h"
#include "renderers/image/image.h"

namespace ir::widgets {

/// How often values occur. Bins are equally wide from `low` to `high`, which are the least and the greatest
/// finite value of the channels looked at; a constant image has one full bin.
struct Histogram {
    static constexpr int bins = 256;
    double low = 0, high = 0;
    double percentile_1 = 0, percentile_99 = 0;  ///< of the finite values, to within a bin
    std::size_t finite = 0, nan = 0, infinite = 0, negative = 0;
    std::vector<int> channels;                            ///< numbers of the channels in `counts`
    std::vector<std::array<std::uint64_t, bins>> counts;  ///< one by channel
    bool operator==(const Histogram&) const = default;
};

/// Of one channel, or with -1 of the first three. Stops early, with what it has, once `cancelled`.
Histogram histogram(const Image& image, int channel = -1, const std::atomic<bool>* cancelled = nullptr);

/// Draws a histogram with two handles for the range that is shown. Big images are counted on another thread;
/// what is drawn always belongs to the image and channel set last, or says that it is being counted.
class HistogramView : public QWidget {
    Q_OBJECT
  public:
    /// Values up to here are counted at once.
    static constexpr std::size_t at_once = 1u << 18;

    explicit HistogramView(QWidget* parent = nullptr);
    ~HistogramView() override;
    /// Null: nothing to show.
    void set_image(std::shared_ptr<const Image> image, Semantic semantic, int channel);
    /// Shows the handles; emits nothing.
    void set_range(double low, double high);
    void set_range_shown(bool shown);
    void set_logarithmic(bool on);
    bool logarithmic() const { return logarithmic_; }
    /// Of the image set last; null while it is being counted.
    const Histogram* current() const { return counted_ ? &histogram_ : nullptr; }
    /// "65536 values  2 NaN  1 Inf  14 negative"
    QString summary() const;

    QSize sizeHint() const override { return {300, 140}; }
    QSize minimumSizeHint() const override { return {160, 90}; }

  signals:
    void counted();                               ///< current() is there
    void range_dragged(double low, double high);  ///< low < high, or low > high when a person crossed them

  protected:
    void paintEvent(QPaintEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void mouseDoubleClickEvent(QMouseEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    bool event(QEvent* event) override;

  private:
    enum class Handle { none, low, high };
    void take(std::uint64_t serial, Histogram histogram);
    QRectF plot() const;
    double x_of(double value) const;
    double value_at(double x) const;
    Handle handle_at(QPointF position) const;
    void move_handle(double value);
    void paint_bars(QPainter& painter) const;
    void paint_handles(QPainter& painter) const;

    QThreadPool pool_;
    std::shared_ptr<std::atomic<bool>> cancelled_;
    std::uint64_t serial_ = 0;
    std::shared_ptr<const Image> image_;
    Semantic semantic_ = Semantic::generic;
    int channel_ = -1;
    Histogram histogram_;
    bool counted_ = false, logarithmic_ = false, range_shown_ = true;
    double low_ = 0, high_ = 1;
    double axis_low_ = 0, axis_high_ = 1;
    Handle dragged_ = Handle::none, active_ = Handle::low;
};

}  // namespace ir::widgets
