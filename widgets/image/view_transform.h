#pragma once

#include <QPoint>
#include <QPointF>
#include <QSizeF>

namespace ir::widgets {

/// Where a picture lies in a view. View lengths are device pixels, so that a zoom of 1 is exact on every
/// screen; picture lengths are its own pixels. Plain arithmetic, no widget.
class ViewTransform {
  public:
    static constexpr double min_zoom = 1.0 / 64, max_zoom = 256;

    /// A fitted picture stays fitted; otherwise the centre of the view keeps its place in the picture.
    void set_view_size(QSizeF size_px);
    /// Another resolution of the same picture keeps the region that is seen.
    void set_image_size(QSizeF size_px);
    /// What a fitted picture leaves free on the right and at the bottom.
    void set_margins(QSizeF margins_px);
    QSizeF view_size() const { return view_; }
    QSizeF image_size() const { return image_; }

    /// Device pixels per picture pixel.
    double zoom() const { return zoom_; }
    /// View position of the picture's top left corner.
    QPointF offset() const { return offset_; }
    bool is_fitted() const { return fitted_; }

    QPointF image_from_view(QPointF view_px) const;
    QPointF view_from_image(QPointF image_px) const;
    /// Of the pixel's middle.
    QPointF view_from_pixel(QPoint pixel) const {
        return view_from_image(QPointF(pixel) + QPointF(0.5, 0.5));
    }

    /// The picture's point under `view_px` stays there.
    void zoom_about(QPointF view_px, double zoom);
    void pan(QPointF delta_px);
    void fit();
    /// Sets zoom and the picture point at the view's centre: restores a remembered view.
    void look_at(QPointF image_px, double zoom);
    QPointF centre() const;

  private:
    void clamp_offset();
    QSizeF view_{1, 1}, image_{0, 0}, margins_{0, 0};
    double zoom_ = 1;
    QPointF offset_{0, 0};
    bool fitted_ = true;
};

}  // namespace ir::widgets
