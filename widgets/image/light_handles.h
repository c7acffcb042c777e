#pragma once

#include <QString>
#include <optional>
#include <vector>

#include "widgets/image/camera_motion.h"

/// Handles by which a light is moved in a picture: where they are, and where a drag brings the light. Plain
/// arithmetic, no widget. World space, metres.
namespace ir::widgets {

/// A light as it stands in space.
struct PlacedLight {
    enum class Shape { point, cone, sun, rectangle, disk };
    Shape shape = Shape::point;
    QString name;                    ///< "Spot, no. 2 of Evening"
    glm::dvec3 position{0};          ///< a sun has none: where its handles stand
    glm::dvec3 direction{0, -1, 0};  ///< of travel, of length one; a point has none
    double half_angle = 45;          ///< degrees, of a cone
    glm::dvec2 size{1};              ///< sides of a rectangle, diameters of a disk
    bool tells = true;               ///< that it is out of sight, where it is
    bool moves() const { return shape != Shape::sun; }
    bool turns() const { return shape != Shape::point; }
    bool operator==(const PlacedLight&) const = default;
};

/// The centre moves parallel to the picture, x, y and z along the world's axes.
enum class LightHandle { none, centre, x, y, z, direction };
/// Those of a light, the first ones above the others.
std::vector<LightHandle> handles_of(const PlacedLight& light);
/// Its far end, where it is `length` long; of the centre, the light's place.
glm::dvec3 end_of(const PlacedLight& light, LightHandle handle, double length);

/// Its outline: a closed line for a rectangle or disk, the rim of a cone `length` away. Empty for others.
std::vector<glm::dvec3> outline_of(const PlacedLight& light, double length);

/// A drag of a handle from where the light was. The light stays where it was last wherever a line of sight
/// says nothing: along an axis that it runs along, and beyond what can be seen.
class LightDrag {
  public:
    LightDrag() = default;
    LightDrag(const PlacedLight& start, LightHandle handle, const CameraPose& camera, double length);
    /// The handle's end follows the line of sight. Pulled over the edge of the sphere of directions and back,
    /// a direction points to the other side.
    PlacedLight to(const Sight& sight);
    LightHandle handle() const { return handle_; }
    const PlacedLight& start() const { return start_; }

  private:
    std::optional<glm::dvec3> position_at(const Sight& sight) const;
    std::optional<double> along_axis(const Sight& sight) const;
    glm::dvec3 direction_at(const Sight& sight);

    PlacedLight start_, last_;
    LightHandle handle_ = LightHandle::none;
    CameraPose camera_;
    double length_ = 1;
    bool points_away_ = false, is_outside_ = false;
};

/// Moved along the camera's axes by parts of the picture's height at the light, else at the target.
PlacedLight nudged(const PlacedLight& light, const CameraPose& camera, const glm::dvec3& right_up_forward);
/// Turned about the camera's up and right, radians.
PlacedLight turned(const PlacedLight& light, const CameraPose& camera, double yaw, double pitch);

}  // namespace ir::widgets
