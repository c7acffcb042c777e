#pragma once

#include <span>
#include <vector>

#include "renderers/core/inspection.h"
#include "renderers/methods/photon-mapping/emission/points.h"

namespace ir::methods::photon_mapping {

/// Keys of the selectors: a layer of the RSM, and a step of warping (0: none; then horizontally and
/// vertically in turns, from the whole square to texels).
inline constexpr const char* source_selector = "source";
inline constexpr const char* warp_selector = "warp";

/// The layer of the RSM that the selector names, or Inspection::all.
int shown_source(const Inspection& inspection, const Sources& sources);

/// Texels, x + resolution · y, of the points of a source among the first `count` candidates.
std::vector<std::uint32_t> texels_of(std::span<const std::uint32_t> candidates, std::uint64_t count,
                                     int source, int resolution);

/// Declares the explanations of how points are warped: "emission.samples", "emission.points" and
/// "emission.histogram".
void show_emission(graph::GraphBuilder& builder, const Sources& sources, const EmissionMaps& maps,
                   const EmissionPoints& points, const Parameters& parameters);

std::vector<OutputDescription> view_outputs();

}  // namespace ir::methods::photon_mapping
