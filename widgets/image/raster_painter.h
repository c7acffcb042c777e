#pragma once

#include <QImage>
#include <QPainter>
#include <array>

#include "widgets/image/canvas.h"

namespace ir::widgets {

/// Draws pictures with QPainter: the canvas without OpenGL, and every snapshot. Keeps the coloured pictures
/// as long as pixels and display stay.
class RasterPainter {
  public:
    /// The painter's unit is a device pixel.
    void paint(QPainter& painter, const CanvasState& state, qreal pixel_ratio);
    void clear() { known_.clear(); }
    int colouring_count() const { return colouring_count_; }

  private:
    struct Coloured {
        PreparedPicture from;
        QImage image;                 ///< surround in gaps
        QImage below, above, hidden;  ///< white where there is a pattern, else transparent; null: nowhere
        QImage reduced;               ///< at the zoom below, smaller than life
        double reduced_zoom = 0;
    };
    Coloured& coloured(const PreparedPicture& picture);
    void colour(Coloured& target) const;
    void paint_picture(QPainter& painter, const PreparedPicture& picture, const CanvasState& state,
                       const QRect& clip, int half);

    std::vector<Coloured> known_;  ///< oldest first
    int colouring_count_ = 0;
};

}  // namespace ir::widgets
