#include <QPaintEvent>
#include <QPainter>

#include "widgets/image/canvas.h"

namespace ir::widgets {
namespace {

class RasterCanvas final : public QWidget, public Canvas {
  public:
    RasterCanvas(const CanvasState& state, QWidget* parent) : QWidget(parent), state_(state) {
        setAttribute(Qt::WA_OpaquePaintEvent);
        setAttribute(Qt::WA_TransparentForMouseEvents);
    }
    QWidget* widget() override { return this; }
    void image_changed() override { display_changed(); }
    void display_changed() override {
        coloured_ = to_qimage(state_.shown, state_.display);
        update();
    }
    const char* kind() const override { return "raster"; }

  protected:
    void paintEvent(QPaintEvent*) override {
        QPainter painter(this);
        painter.fillRect(rect(), surround_colour);
        const qreal ratio = devicePixelRatioF();
        if (!coloured_.isNull()) {
            const auto& t = state_.transform;
            painter.save();
            painter.scale(1 / ratio, 1 / ratio);
            painter.setRenderHint(QPainter::SmoothPixmapTransform, t.zoom() < 1);
            painter.drawImage(QRectF(t.offset(), t.image_size() * t.zoom()), coloured_);
            painter.restore();
        }
    }

  private:
    const CanvasState& state_;
    QImage coloured_;
};

}  // namespace

Canvas* make_raster_canvas(const CanvasState& state, QWidget* parent) {
    return new RasterCanvas(state, parent);
}

}  // namespace ir::widgets
