#include "widgets/image/view_transform.h"

#include <algorithm>
#include <cmath>

namespace ir::widgets {

void ViewTransform::set_view_size(QSizeF size_px) {
    if (size_px == view_) return;
    const QPointF middle = centre();
    view_ = size_px.expandedTo({1, 1});
    fitted_ ? fit() : look_at(middle, zoom_);
}

void ViewTransform::set_margins(QSizeF margins_px) {
    if (margins_px == margins_) return;
    margins_ = margins_px;
    if (fitted_) fit();
}

void ViewTransform::set_image_size(QSizeF size_px) {
    if (size_px == image_) return;
    const QSizeF before = image_;
    const QPointF middle = centre();
    image_ = size_px;
    if (fitted_ || before.isEmpty() || size_px.isEmpty()) return fit();
    const double ratio_x = size_px.width() / before.width(), ratio_y = size_px.height() / before.height();
    look_at({middle.x() * ratio_x, middle.y() * ratio_y}, zoom_ / std::max(ratio_x, ratio_y));
}

QPointF ViewTransform::image_from_view(QPointF view_px) const {
    return (view_px - offset_) / zoom_;
}

QPointF ViewTransform::view_from_image(QPointF image_px) const {
    return image_px * zoom_ + offset_;
}

QPointF ViewTransform::centre() const {
    return image_from_view({view_.width() / 2, view_.height() / 2});
}

void ViewTransform::zoom_about(QPointF view_px, double zoom) {
    const QPointF kept = image_from_view(view_px);
    zoom_ = std::clamp(zoom, min_zoom, max_zoom);
    offset_ = view_px - kept * zoom_;
    fitted_ = false;
    clamp_offset();
}

void ViewTransform::pan(QPointF delta_px) {
    offset_ += delta_px;
    fitted_ = false;
    clamp_offset();
}

void ViewTransform::fit() {
    fitted_ = true;
    zoom_ = 1;
    const QSizeF room = (view_ - margins_).expandedTo({1, 1});
    if (!image_.isEmpty())
        zoom_ = std::clamp(std::min(room.width() / image_.width(), room.height() / image_.height()), min_zoom,
                           max_zoom);
    offset_ = {(room.width() - image_.width() * zoom_) / 2, (room.height() - image_.height() * zoom_) / 2};
    clamp_offset();
}

void ViewTransform::look_at(QPointF image_px, double zoom) {
    zoom_ = std::clamp(zoom, min_zoom, max_zoom);
    offset_ = QPointF(view_.width() / 2, view_.height() / 2) - image_px * zoom_;
    fitted_ = false;
    clamp_offset();
}

void ViewTransform::clamp_offset() {
    // Some of the picture stays in sight, so that it is never lost; whole device pixels keep texels square.
    const double margin = 32;
    const auto clamped = [&](double offset, double view, double image) {
        const double low = std::min(0.0, margin - image * zoom_), high = std::max(0.0, view - margin);
        return std::round(std::clamp(offset, low, high));
    };
    offset_ = {clamped(offset_.x(), view_.width(), image_.width()),
               clamped(offset_.y(), view_.height(), image_.height())};
}

}  // namespace ir::widgets
