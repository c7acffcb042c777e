#include <QPaintEvent>
#include <QPainter>

#include "widgets/image/canvas.h"
#include "widgets/image/raster_painter.h"

namespace ir::widgets {
namespace {

class RasterCanvas final : public QWidget, public Canvas {
  public:
    RasterCanvas(const CanvasState& state, QWidget* parent) : QWidget(parent), state_(state) {
        setAttribute(Qt::WA_OpaquePaintEvent);
        setAttribute(Qt::WA_TransparentForMouseEvents);
    }
    QWidget* widget() override { return this; }
    void state_changed() override {
        if (!state_.has_image()) pictures_.clear();  // a hidden pane needs no memory
        update();
    }
    const char* kind() const override { return "raster"; }
    int upload_count() const override { return pictures_.colouring_count(); }

  protected:
    void paintEvent(QPaintEvent*) override {
        QPainter painter(this);
        painter.fillRect(rect(), surround_colour);
        const qreal ratio = devicePixelRatioF();
        painter.scale(1 / ratio, 1 / ratio);
        pictures_.paint(painter, state_, ratio);
    }

  private:
    const CanvasState& state_;
    RasterPainter pictures_;
};

}  // namespace

Canvas* make_raster_canvas(const CanvasState& state, QWidget* parent) {
    return new RasterCanvas(state, parent);
}

}  // namespace ir::widgets
