#pragma once

#include <QPointF>

#include "widgets/space/space_scene.h"

/// Movements of the free camera that ImageView's camera has not: plain arithmetic, no widget.
namespace ir::widgets {

/// Goes nearer (factor < 1) or further; the point of the target's plane that is seen at `at` stays there.
/// `at` is in heights of the picture from its middle, right and up.
CameraPose dollied_towards(const CameraPose& pose, QPointF at, double factor);

/// The same direction, at such a distance that the box fits a picture of that width : height.
CameraPose framed(const CameraPose& pose, const SpaceBox& box, double aspect);

/// How the unit sphere of directions is seen at first.
CameraPose sphere_pose();
/// Opened so far that a picture of that width : height shows below a strip at its top, a part of its height,
/// along the smaller side what a square shows.
CameraPose fitted_below(const CameraPose& pose, double aspect, double strip);
/// Nearer or further, but neither into the sphere nor out of sight.
CameraPose sphere_dollied(const CameraPose& pose, double factor);

/// A length of 1, 2 or 5 times a power of ten, at most `max_length`.
double round_length(double max_length);

}  // namespace ir::widgets
