#pragma once

#include <QImage>
#include <QWidget>
#include <vector>

#include "widgets/profile/waveform.h"

namespace ir::widgets {

/// Waveforms beside each other over one axis of values. Brighter is more often. Dark in every theme, as the
/// colours of channels add up to white.
class WaveformView : public QWidget {
    Q_OBJECT
  public:
    explicit WaveformView(QWidget* parent = nullptr);
    /// More than max_shown are left out, and the view says so. `logarithmic`: rare values are seen better.
    void set_waveforms(std::vector<Waveform> waveforms, bool logarithmic);
    const std::vector<Waveform>& waveforms() const { return waveforms_; }
    /// Where a waveform is drawn, logical pixels.
    QRectF place_of(std::size_t waveform) const;
    /// What is counted at a place; empty: nothing is drawn there.
    QString text_at(QPointF place) const;

    static constexpr std::size_t max_shown = 4;
    QSize sizeHint() const override { return {420, 160}; }

  protected:
    void paintEvent(QPaintEvent* event) override;
    bool event(QEvent* event) override;

  private:
    void paint_axis(QPainter& painter) const;
    double axis_value(int part) const;
    std::size_t shown() const { return std::min(waveforms_.size(), max_shown); }

    std::vector<Waveform> waveforms_;
    std::vector<QImage> images_;
    double axis_width_ = 0;  ///< of the numbers at the left, logical pixels
};

}  // namespace ir::widgets
