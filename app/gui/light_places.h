#pragma once

#include "app/engine/live.h"
#include "projects/light_spec.h"

/// Where a light comes to stand with one step. It is as bright as makes a white surface where it is aimed
/// look about white at an exposure, in stops.
namespace ir::gui {

/// A point light before a surface, along its normal: a tenth of the scene's radius away, so that it lights
/// more than a spot; of what is near the camera, at most a quarter of the picture's height there, so that it
/// is seen with what it lights; at most half of the way to the next surface. The surface gets the light.
projects::LightSpec light_before(const engine::SurfacePoint& surface, const CameraPose& camera,
                                 const scene::Bounds& bounds, double exposure);
/// A spot at the camera that looks at a point. Its cone is as wide as the picture's diagonal, and full in
/// half of it.
projects::LightSpec light_from_camera(const CameraPose& camera, double aspect, const glm::dvec3& aim,
                                      double exposure);
/// A point light at the camera, for surfaces as far away as a point. It stays there when the camera moves:
/// what a document says does not depend on who looks at it.
projects::LightSpec headlight(const CameraPose& camera, const glm::dvec3& aim, double exposure);
/// For a scene without light: in a room in front of the camera, where the way is free; of things from before
/// them, on the left and above.
projects::LightSpec light_for_view(const CameraPose& camera, const scene::Bounds& bounds);

}  // namespace ir::gui
