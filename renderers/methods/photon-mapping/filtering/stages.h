#pragma once

#include <string>

#include "renderers/methods/photon-mapping/stages.h"
#include "renderers/passes/a_trous/a_trous.h"

/// The steps of the filter.
namespace ir::methods::photon_mapping {

using passes::a_trous::compute_by_rows;

inline const std::string folder = "methods/photon-mapping/filtering/";  ///< of its shaders

/// Of the filter in space, and of the edges that the one in time respects.
passes::a_trous::Options filter_options(const Parameters& parameters);

/// "filter.temporal" rgba32f (E, W/m²; x of the sum of directions to the light) and
/// "filter.temporal_direction" rg32f (y and z of it): the estimate at the view's resolution, and its average
/// over frames. [Smal19 §6.2.1, §7.2]
passes::a_trous::Signal accumulate(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer,
                                   graph::ImageRef surfaces, const Splat& splat,
                                   const Parameters& parameters);

/// "filter.irradiance" and "filter.direction": the à-trous transform with clipped details; `input` itself
/// without passes. Declares the views of its levels, too.  [Smal19 §7.3]
passes::a_trous::Signal smooth(graph::GraphBuilder& builder, graph::ImageRef surfaces,
                               const passes::a_trous::Signal& input, const Parameters& parameters);

}  // namespace ir::methods::photon_mapping
