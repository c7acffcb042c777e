#pragma once

#include <QPainter>
#include <QWidget>

#include "widgets/space/space_marks.h"
#include "widgets/space/space_scene.h"

namespace ir::widgets {

/// What a 3D view writes over its picture. Owned by the view, read by its overlay.
struct OverlayState {
    std::vector<LayerInfo> layers;  ///< of the picture, as far as the scene still has them
    CameraPose camera;              ///< that the picture was drawn with
    bool has_picture = false;
    bool busy = false;   ///< a newer picture takes long
    bool stale = false;  ///< newer buffers are being rendered
    QString moment;      ///< SpacePicture::moment
    QString note;        ///< why there is no newer picture
    QString hover;
    QPointF hover_at;
    SpaceMarks marks = {};
};

/// Paints tripod, scale, legends, notes and the text at the cursor; `area` is the picture's in logical
/// pixels.
void paint_space_overlay(QPainter& painter, const OverlayState& state, const QRectF& area);

/// How high the legends of layers are where they are lines at the top; 0: they stand in a corner.
double legend_strip(std::size_t layers, const QSizeF& area);

/// A transparent widget that paints the above.
QWidget* make_space_overlay(const OverlayState& state, QWidget* parent);

/// "812", "12.3 k", "3.2 M".
QString count_text(std::uint64_t count);
/// "every 7th of 3.2 M points", or "3.2 M points".
QString amount_text(OutputKind kind, std::uint64_t elements, std::uint64_t stride);
/// The same of a drawn layer; where filters are set, how many pass: "12.3 k of 2.7 M points".
QString amount_text(const LayerInfo& info);
/// "depth", "radiance, z", "colatitude, lower bound", "facing", "one colour".
QString colour_text(const SpaceLayer& layer, const std::vector<Field>& fields);
/// What is said of an element under the cursor: its layer, number, values and what a click shows.
QString element_text(const SpaceScene& scene, const std::vector<LayerInfo>& drawn,
                     const std::vector<SpaceSelector>& selectors, const SpaceElement& element,
                     const QString& values);
/// "y", "upper bound".
QString component_name(OutputKind kind, const Field& field, int component);

}  // namespace ir::widgets
