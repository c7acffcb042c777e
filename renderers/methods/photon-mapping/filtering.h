#pragma once

#include "renderers/core/method.h"
#include "renderers/methods/photon-mapping/splatting.h"

namespace ir::methods::photon_mapping {

struct Filtered {
    graph::ImageRef
        irradiance;  ///< "filter.irradiance" rgba32f, at the view's resolution, as Splat::irradiance
    graph::ImageRef direction;  ///< "filter.direction" rg32f
};

/// Up-sampling, temporal filter, à-trous passes and clipped details.
Filtered filter_irradiance(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, const Splat& splat,
                           const Parameters& parameters);

/// The main result "radiance" and the final "irradiance": reflection of what was filtered, with direct light
/// and emission where the transport asks for them.
void compose(graph::GraphBuilder& builder, const passes::SceneBuffers& scene, const passes::GBuffer& gbuffer,
             const Filtered& filtered, const Parameters& parameters);

std::vector<OutputDescription> filtering_outputs();
/// From the unfiltered estimate to the final irradiance.
std::vector<Stage> filtering_stages();

}  // namespace ir::methods::photon_mapping
