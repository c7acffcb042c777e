#include <QPainter>
#include <algorithm>

#include "renderers/core/error.h"
#include "widgets/image/image_view.h"
#include "widgets/image/legend.h"
#include "widgets/image/raster_painter.h"

/// What an ImageView shows; how it is moved stands in image_view.cpp.
namespace ir::widgets {
namespace {

/// Room for a legend beside an exported picture: all that it needs.
constexpr qreal whole_legend = 10000;

}  // namespace

void ImageView::set_picture(std::shared_ptr<const Picture> picture) {
    const QSizeF size = picture ? QSizeF(picture->size().expandedTo({0, 0})) : QSizeF(0, 0);
    auto& second = state_.pictures[1];
    if (second.picture && QSizeF(second.picture->size()) != size) second = {{}, {}, {}, second.display};
    state_.pictures[0] = cache_.prepare(std::move(picture), display_);
    const auto& shown = state_.pictures[0].picture;
    state_.note = shown && !shown->has_image() ? shown->note : QString();
    state_.stale = stale_ || (shown && shown->stale);
    if (state_.has_image()) {
        const double before = state_.transform.zoom();
        state_.transform.set_image_size(size);
        if (state_.transform.zoom() != before) emit zoom_changed(state_.transform.zoom());
    }
    repaint_all();
}

void ImageView::set_second(std::shared_ptr<const Picture> picture) {
    if (picture && picture->has_image() && picture->size() != state_.transform.image_size().toSize()) {
        const QSizeF first = state_.transform.image_size();
        throw UsageError("sizes differ: A " + std::to_string(int(first.width())) + "x" +
                         std::to_string(int(first.height())) + ", B " +
                         std::to_string(picture->size().width()) + "x" +
                         std::to_string(picture->size().height()) + "; render both at one size");
    }
    state_.pictures[1] = cache_.prepare(std::move(picture), second_display_);
    repaint_all();
}

void ImageView::set_image(Image image, Semantic semantic) {
    set_picture(make_picture(std::move(image), semantic));
    emit zoom_changed(state_.transform.zoom());
}

void ImageView::set_note(const QString& note) {
    set_picture(make_note(note));
}

void ImageView::set_display(const Display& display) {
    if (display == display_) return;
    display_ = display;
    state_.pictures[0] = cache_.prepare(state_.pictures[0].picture, display_);
    repaint_all();
}

void ImageView::set_second_display(const Display& display) {
    if (display == second_display_) return;
    second_display_ = display;
    state_.pictures[1] = cache_.prepare(state_.pictures[1].picture, second_display_);
    repaint_all();
}

void ImageView::set_labels(const QString& label, const QString& second) {
    if (label == state_.label && second == state_.second_label) return;
    state_.label = label;
    state_.second_label = second;
    repaint_all();
}

void ImageView::set_wipe(double fraction) {
    state_.wipe = std::clamp(fraction, 0.0, 1.0);
    repaint_all();
}

void ImageView::set_legend(bool on) {
    state_.legend = on;
    repaint_all();
}

void ImageView::set_cursor_mark(QPoint pixel) {
    if (pixel == state_.cursor_mark) return;
    state_.cursor_mark = pixel;
    overlay_->update();
}

void ImageView::set_pins(const std::vector<PinMark>& pins) {
    if (pins == state_.pins) return;
    state_.pins = pins;
    repaint_all();
}

void ImageView::set_picked(QPoint pixel) {
    if (pixel == state_.picked) return;
    state_.picked = pixel;
    overlay_->update();
}

void ImageView::set_stale(bool stale) {
    stale_ = stale;
    state_.stale = stale_ || (picture() && picture()->stale);
    repaint_all();
}

void ImageView::follow(const ViewTransform& transform) {
    if (transform.is_fitted())
        state_.transform.fit();
    else
        state_.transform.look_at(transform.centre(), transform.zoom());
    repaint_all();
}

const Image& ImageView::image() const {
    static const Image none;
    return state_.has_image() ? *picture()->image : none;
}

const std::shared_ptr<const Picture>& ImageView::picture() const {
    return state_.pictures[0].picture;
}

const std::shared_ptr<const Picture>& ImageView::second() const {
    return state_.pictures[1].picture;
}

Semantic ImageView::semantic() const {
    return picture() ? picture()->semantic : Semantic::generic;
}

QImage ImageView::snapshot(bool overlays, bool legend, SnapshotScale scale) const {
    CanvasState drawn = state_;
    drawn.hint.clear();
    drawn.cursor_mark = {-1, -1};
    drawn.region_edited = false;
    drawn.stale = false;
    drawn.legend = legend;
    qreal ratio = devicePixelRatioF();
    QSize size = state_.transform.view_size().toSize();
    qreal beside = 0;  // where the legend goes when the whole picture is exported
    if (scale == SnapshotScale::picture_pixels && state_.has_image()) {
        ratio = 1;
        size = state_.transform.image_size().toSize();
        drawn.transform.set_view_size(size);
        drawn.transform.fit();
        drawn.legend = false;
        if (legend) beside = legend_size(state_.pictures[0], ratio, whole_legend).width() + 16;
    }
    const qreal height = beside > 0 ? legend_size(state_.pictures[0], ratio, whole_legend).height() + 16 : 0;
    QImage image(size.width() + int(beside), std::max(size.height(), int(height)), QImage::Format_RGB32);
    image.fill(surround_colour);
    QPainter painter(&image);
    painter.setFont(font());
    RasterPainter().paint(painter, drawn, ratio);
    if (overlays || legend) {
        if (!overlays) {  // the legend (and a reason for having no picture) alone
            drawn.label.clear();
            drawn.second_label.clear();
            drawn.picked = {-1, -1};
            drawn.region = {};
            drawn.pins.clear();
            drawn.pixel_grid = false;
        }
        paint_overlay(painter, drawn, ratio);
    }
    if (beside > 0)
        paint_legend(painter, state_.pictures[0], QPointF(size.width() + 8, 8), ratio, whole_legend);
    return image;
}

}  // namespace ir::widgets
