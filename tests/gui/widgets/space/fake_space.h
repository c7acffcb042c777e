#pragma once

#include "widgets/space/space_view.h"

namespace ir::widgets::test {

/// Points on a sphere of radius 1 in three layers, drawn by the simplest renderer that there is: what a 3D
/// view asks for comes back as a picture with layers and elements by pixel.
class FakeSpace {
  public:
    std::vector<CameraPose> cameras;  ///< of the pictures drawn, newest last
    CameraPose experiment;            ///< used where the scene has no camera of its own
    int points = 400;
    std::vector<Field> fields = buffer().fields;  ///< of what is drawn

    static AvailableBuffer buffer();
    static AvailableBuffer directions();
    static SpaceLayer layer() { return default_layer(buffer()); }
    SpacePicture draw(const SpaceScene& scene, QSize size);
};

/// Turns positions in the picture (device pixels) to those of the view.
QPoint in_view(const SpaceView& view, QPointF picture_px);
/// Middle of the pixels of an element; (-1, -1) when it is not drawn.
QPointF place_of(const SpacePicture& picture, int layer, std::int64_t element);

}  // namespace ir::widgets::test
