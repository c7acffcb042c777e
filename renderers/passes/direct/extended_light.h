#pragma once

#include <optional>
#include <vector>

#include "renderers/core/output.h"
#include "renderers/core/transport.h"
#include "renderers/graph/builder.h"
#include "renderers/passes/direct/light_parameters.h"
#include "renderers/passes/gbuffer/gbuffer.h"

namespace ir::passes {

struct ExtendedLightOptions {
    LightParameters parameters;
    Transport::Materials materials = Transport::Materials::gltf;
    bool environment = true, emissive_meshes = true;
    bool mirrors = true;  ///< whether mirrors show the sources that they reflect
};

/// For methods with direct light; each is 0 where there is no such source.
std::vector<OutputDescription> extended_light_outputs();

/// Declares "direct.extended", rgba32f: light of rectangles, disks, emissive meshes and the environment that
/// surfaces reflect towards the eye, W/(m² sr), by samples on the host, whatever the processor; their mean
/// over the frames in which nothing moved; and the filter. None where no such source shines, or where there
/// are no samples, which a note says: then the outputs are 0.
std::optional<graph::ImageRef> extended_light(graph::GraphBuilder& builder, const GBuffer& gbuffer,
                                              const ExtendedLightOptions& options);

}  // namespace ir::passes
