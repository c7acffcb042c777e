#pragma once

#include <QColor>
#include <QWidget>

#include "widgets/image/display.h"
#include "widgets/image/view_transform.h"

namespace ir::widgets {

/// Surroundings of pictures: the sRGB code of 18 % grey, so that colours can be judged.
inline constexpr QColor surround_colour{118, 118, 118};

/// What a canvas draws. Owned by the view, read by its canvas.
struct CanvasState {
    Image image;  ///< as it arrived
    Image shown;  ///< at most four channels of it
    Display display;
    Semantic semantic = Semantic::generic;
    ViewTransform transform;
    bool pixel_grid = true;
    QString note;           ///< instead of a picture: why there is none
    QString hint;           ///< in the bottom left corner: how the tool is used
    bool stale = false;     ///< a newer picture is being rendered
    QPoint picked{-1, -1};  ///< marked pixel; negative: none
};

/// The surface that a picture is drawn on: OpenGL where there is one, a plain widget elsewhere. Both draw the
/// same.
class Canvas {
  public:
    virtual ~Canvas() = default;
    virtual QWidget* widget() = 0;
    virtual void image_changed() = 0;
    virtual void display_changed() = 0;
    virtual const char* kind() const = 0;  ///< "OpenGL" or "raster"
};

/// OpenGL where a context can be made (a shown QOpenGLWidget crashes Qt where it cannot), else raster.
Canvas* make_canvas(const CanvasState& state, QWidget* parent);
Canvas* make_gl_canvas(const CanvasState& state, QWidget* parent);
Canvas* make_raster_canvas(const CanvasState& state, QWidget* parent);
bool has_opengl();

/// Pixel grid, numbers in pixels, hint, note and stale badge: a transparent widget that lies over either
/// surface.
QWidget* make_overlay(const CanvasState& state, QWidget* parent);

}  // namespace ir::widgets
