#include <cmath>

#include "renderers/core/error.h"
#include "renderers/scene/gltf/nodes.h"

namespace ir::scene::gltf {

void apply_rest_pose(Document& document, Scene&, const std::vector<int>& nodes) {
    for (std::size_t i = 0; i < nodes.size(); ++i)
        if (nodes[i] >= 0 && document.model.nodes[i].skin >= 0)
            document.warnings.add("skins are ignored; meshes keep the pose that their vertices have");
}

}  // namespace ir::scene::gltf
