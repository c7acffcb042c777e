#pragma once

#include <optional>

#include "renderers/graph/builder.h"
#include "renderers/methods/reference/parameters.h"
#include "renderers/passes/gbuffer/gbuffer.h"

namespace ir::methods::reference {

/// What paths start from and run through.
struct PathInputs {
    std::optional<passes::GBuffer> gbuffer;  ///< paths start on it; else on rays through the pixels
    graph::ImageRef valid;
    graph::ObjectRef bvh;       ///< passes::Bvh
    graph::ObjectRef surfaces;  ///< passes::SurfaceLookup; of ambient occlusion only without a G-buffer
    graph::ObjectRef lights;    ///< passes::LightSampler; of light only
};

/// Declares all that the parameters ask for: G-buffer, or first hits and "valid" of rays; BVH, surfaces and
/// lights.
PathInputs path_inputs(graph::GraphBuilder& builder, const Parameters& parameters);

}  // namespace ir::methods::reference
