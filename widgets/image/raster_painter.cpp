#include "widgets/image/raster_painter.h"

#include <algorithm>
#include <cmath>

namespace ir::widgets {
namespace {

/// A divider needs two, holding a key one more.
constexpr std::size_t remembered_pictures = 4;

constexpr QColor below_colour{40, 90, 255}, above_colour{255, 60, 40};
constexpr QColor hidden_dark{100, 100, 100}, hidden_light{136, 136, 136};

enum class Pattern { below, above, hidden };

/// The same rules as in the view's shader, by position in the view.
QImage pattern_tile(Pattern pattern, int half) {
    const int period = 2 * half;
    QImage tile(period, period, QImage::Format_ARGB32_Premultiplied);
    tile.fill(Qt::transparent);
    const QColor stripe = pattern == Pattern::below ? below_colour : above_colour;
    for (int y = 0; y < period; ++y)
        for (int x = 0; x < period; ++x) {
            if (pattern == Pattern::hidden)
                tile.setPixelColor(x, y, (x < half) == (y < half) ? hidden_dark : hidden_light);
            else if (const int at = (pattern == Pattern::below ? x + y : x - y + period) % period; at < half)
                tile.setPixelColor(x, y, 3 * at < half ? QColor(Qt::black) : stripe);  // shows on any colour
        }
    return tile;
}

void set_mask(QImage& mask, const Image& image, int x, int y) {
    if (mask.isNull()) {
        mask = QImage(image.width, image.height, QImage::Format_ARGB32_Premultiplied);
        mask.fill(Qt::transparent);
    }
    reinterpret_cast<QRgb*>(mask.scanLine(y))[x] = qRgba(255, 255, 255, 255);
}

void paint_pattern(QPainter& painter, const QImage& mask, const QRectF& target, Pattern pattern, int half,
                   QSize view) {
    if (mask.isNull()) return;
    QImage layer(view, QImage::Format_ARGB32_Premultiplied);
    layer.fill(Qt::transparent);
    QPainter inner(&layer);
    inner.setRenderHint(QPainter::SmoothPixmapTransform, target.width() < mask.width());
    inner.drawImage(target, mask);
    inner.setCompositionMode(QPainter::CompositionMode_SourceIn);
    inner.fillRect(layer.rect(), QBrush(pattern_tile(pattern, half)));
    inner.end();
    painter.drawImage(0, 0, layer);
}

}  // namespace

void RasterPainter::paint(QPainter& painter, const CanvasState& state, qreal pixel_ratio) {
    const QRect view(QPoint(0, 0), state.transform.view_size().toSize());
    painter.fillRect(view, surround_colour);
    if (!state.has_image()) return;
    const int half = pattern_half(pixel_ratio), x = state.divider_x();
    paint_picture(painter, state.pictures[0], state, view & QRect(0, 0, x, view.height()), half);
    if (const QRect area = state.second_area(); !area.isEmpty())
        paint_picture(painter, state.pictures[1], state, area, half);
}

RasterPainter::Coloured& RasterPainter::coloured(const PreparedPicture& picture) {
    const auto known = std::find_if(known_.begin(), known_.end(), [&](const Coloured& entry) {
        return entry.from.same_pixels(picture) && entry.from.display == picture.display;
    });
    if (known != known_.end()) {
        std::rotate(known, known + 1, known_.end());
        return known_.back();
    }
    if (known_.size() >= remembered_pictures) known_.erase(known_.begin());
    known_.push_back({});
    known_.back().from = picture;
    colour(known_.back());
    ++colouring_count_;
    return known_.back();
}

void RasterPainter::colour(Coloured& target) const {
    const Image& image = *target.from.shown;
    const Display& display = target.from.display;
    target.image = to_qimage(image, display);
    for (int y = 0; y < image.height; ++y) {
        auto* line = reinterpret_cast<QRgb*>(target.image.scanLine(y));
        for (int x = 0; x < image.width; ++x) {
            const Cover cover = target.from.cover_at(x, y);
            if (cover == Cover::gap)
                line[x] = surround_colour.rgb();
            else if (cover == Cover::hidden && display.hide_invalid)
                set_mask(target.hidden, image, x, y);
            else if (display.zebra)
                switch (out_of_range(display, &image.pixels[image.index(x, y)], image.channels)) {
                    case OutOfRange::no:
                        break;
                    case OutOfRange::below:
                        set_mask(target.below, image, x, y);
                        break;
                    case OutOfRange::above:
                        set_mask(target.above, image, x, y);
                        break;
                }
        }
    }
}

void RasterPainter::paint_picture(QPainter& painter, const PreparedPicture& picture, const CanvasState& state,
                                  const QRect& clip, int half) {
    if (clip.isEmpty()) return;
    Coloured& drawn = coloured(picture);
    const ViewTransform& t = state.transform;
    const QRectF target(t.offset(), QSizeF(drawn.image.size()) * t.zoom());
    painter.save();
    painter.setClipRect(clip, Qt::IntersectClip);
    if (t.zoom() >= 1) {
        painter.drawImage(target, drawn.image);
    } else {
        if (drawn.reduced_zoom != t.zoom()) {  // the mean over each pixel's footprint, like the shader's
            const QSize size = (QSizeF(drawn.image.size()) * t.zoom()).toSize().expandedTo({1, 1});
            drawn.reduced = drawn.image.scaled(size, Qt::IgnoreAspectRatio, Qt::SmoothTransformation);
            drawn.reduced_zoom = t.zoom();
        }
        painter.drawImage(t.offset(), drawn.reduced);
    }
    const QSize view = t.view_size().toSize();
    paint_pattern(painter, drawn.hidden, target, Pattern::hidden, half, view);
    paint_pattern(painter, drawn.below, target, Pattern::below, half, view);
    paint_pattern(painter, drawn.above, target, Pattern::above, half, view);
    painter.restore();
}

}  // namespace ir::widgets
