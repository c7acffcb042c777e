#include "app/engine/camera_pose.h"

#include "projects/document_json.h"

namespace ir::engine {

nlohmann::ordered_json camera_json(const scene::Camera& camera) {
    return projects::pose_json(pose_of(camera));
}

}  // namespace ir::engine
