#pragma once

#include <QColor>
#include <QFontMetrics>
#include <QLine>
#include <QWidget>
#include <array>
#include <vector>

#include "widgets/image/display.h"
#include "widgets/image/light_handles.h"
#include "widgets/image/prepared_picture.h"
#include "widgets/image/view_transform.h"

namespace ir::widgets {

/// Surroundings of pictures: the sRGB code of 18 % grey, so that colours can be judged.
inline constexpr QColor surround_colour{118, 118, 118};

/// A marked pixel with its number, in a colour of its own.
struct PinMark {
    QPoint pixel;
    QColor colour;
    int number = 1;
    bool operator==(const PinMark&) const = default;
};

/// Text beside a pixel.
struct SaidMark {
    QPoint pixel{-1, -1};
    QString text;
    bool operator==(const SaidMark&) const = default;
};

/// What is marked in a picture, in its pixels.
struct Marks {
    std::vector<PinMark> pins;  ///< pixels that are kept in sight
    QPoint picked{-1, -1};      ///< negative: none
    SaidMark said;              ///< what shaders print of the pixel that is explained
    QRect region;               ///< pixels that are measured; empty: none
    QLine line;                 ///< from the middle of a pixel to that of another one; null: none
    QPoint cursor{-1, -1};      ///< where the cursor is in a linked view; negative: nowhere
    bool hinted = true;         ///< how the tool is used, where there is room for that
};

/// What a canvas draws. Owned by the view, read by its canvas.
struct CanvasState {
    /// The picture, and the one that is seen right of the divider or in the lens (empty: there is neither).
    std::array<PreparedPicture, 2> pictures;
    ViewTransform transform;
    double wipe = 0.5;       ///< the divider, a fraction of the picture's width
    bool has_lens = false;   ///< instead of the divider
    QPointF lens{0.5, 0.5};  ///< its middle, fractions of the picture's size
    bool pixel_grid = true, legend = false;
    bool legend_room = false;     ///< the room of a legend stays free where none is
    QString label, second_label;  ///< in the top corners
    QString note;                 ///< instead of a picture: why there is none
    QString hint;                 ///< in the bottom left corner: how the tool is used
    bool stale = false;           ///< a newer picture is being rendered
    Marks marks;
    bool region_edited = false;                    ///< the marked one has handles and shows its size
    bool line_edited = false;                      ///< likewise
    CameraPose camera;                             ///< of the picture, for what is drawn in its space
    std::optional<PlacedLight> light;              ///< has handles
    LightHandle light_handle = LightHandle::none;  ///< that the cursor is over or holds

    bool has_image() const { return !pictures[0].empty(); }
    bool has_second() const { return has_image() && !pictures[1].empty(); }
    bool has_divider() const { return has_second() && !has_lens; }
    /// By fractions of the picture. Returns the pixel in its middle.
    QPoint move_lens(QPointF way);
    /// View x of the divider in whole device pixels; the right edge of the view without one.
    int divider_x() const;
    /// Whether a place of the view, device pixels, takes hold of the divider.
    bool is_over_divider(QPointF place, qreal pixel_ratio) const;
    /// Where the second picture is seen, device pixels of the view; empty: nowhere.
    QRect second_area() const;
    /// The picture that is seen at a pixel.
    const PreparedPicture& at(QPointF image_px) const;
};

/// Where a view's legends stand: beside the picture, or in a line below it, whichever leaves the picture
/// larger.
struct LegendPlace {
    bool is_line = false;
    QSizeF margins{0, 0};  ///< that they take on the right and at the bottom, device pixels
};
LegendPlace legend_place(const CanvasState& state, qreal pixel_ratio);

/// Half the width of a stripe of the zebra and a field of the chequer, device pixels.
int pattern_half(qreal pixel_ratio);

/// The surface that a picture is drawn on: OpenGL where there is one, a plain widget elsewhere. Both draw the
/// same.
class Canvas {
  public:
    virtual ~Canvas() = default;
    virtual QWidget* widget() = 0;
    /// Pictures, displays, place or divider changed. What is on the graphics card already stays there.
    virtual void state_changed() = 0;
    virtual const char* kind() const = 0;  ///< "OpenGL" or "raster"
    virtual int upload_count() const = 0;
};

/// OpenGL where a context can be made (a shown QOpenGLWidget crashes Qt where it cannot), else raster.
Canvas* make_canvas(const CanvasState& state, QWidget* parent);
Canvas* make_gl_canvas(const CanvasState& state, QWidget* parent);
Canvas* make_raster_canvas(const CanvasState& state, QWidget* parent);
bool has_opengl();

/// A hint in as many lines as its parts need in so many pixels.
QString wrapped_hint(const QString& hint, const QFontMetrics& metrics, int width);

/// Everything over the picture (labels, divider, grid, numbers, marks, hint, note, legend) on a painter whose
/// unit is a device pixel.
void paint_overlay(QPainter& painter, const CanvasState& state, qreal pixel_ratio);
/// A transparent widget with that, which lies over either surface.
QWidget* make_overlay(const CanvasState& state, QWidget* parent);

}  // namespace ir::widgets
