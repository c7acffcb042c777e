#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "renderers/core/transport.h"
#include "renderers/graph/builder.h"
#include "renderers/passes/gbuffer/gbuffer.h"

namespace ir::passes {

/// What the eye sees besides surfaces, where the transport has light that is not scattered.
struct SeenLight {
    glm::vec3 background{0};  ///< where there is no surface: of a constant environment, W/(m² sr)
    /// "direct.seen" rgba32f, to be added: rectangles and disks, and, where there is no surface, the
    /// environment map. Only where the scene has such.
    std::optional<graph::ImageRef> image = {};
};

SeenLight seen_light(graph::GraphBuilder& builder, const GBuffer& gbuffer, const Transport& transport);

}  // namespace ir::passes
