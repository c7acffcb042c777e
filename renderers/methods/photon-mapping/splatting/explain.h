#pragma once

#include "renderers/methods/photon-mapping/splatting/draw_kernels.h"

namespace ir::methods::photon_mapping {

/// Declares "splat.explain.photons" and "splat.explain.sum": the photons whose kernels cover the picked
/// pixel, gathered from the whole photon buffer, and their sum against what was splatted.
void explain_pixel(graph::GraphBuilder& builder, const Kernels& kernels, graph::ImageRef irradiance);

}  // namespace ir::methods::photon_mapping
