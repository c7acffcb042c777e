#pragma once

#include "renderers/methods/photon-mapping/emission/points.h"

namespace ir::methods::photon_mapping {

/// Keys of the selectors: a layer of the RSM, and a step of warping (0: none; then horizontally and
/// vertically in turns, from the whole square to texels).
inline constexpr const char* source_selector = "source";
inline constexpr const char* warp_selector = "warp";

/// Declares the explanations of how points are warped: "emission.samples", "emission.points" and
/// "emission.histogram".
void show_emission(graph::GraphBuilder& builder, const Sources& sources, const EmissionMaps& maps,
                   const EmissionPoints& points, const Parameters& parameters);

std::vector<OutputDescription> view_outputs();

}  // namespace ir::methods::photon_mapping
