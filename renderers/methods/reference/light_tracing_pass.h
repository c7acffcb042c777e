#pragma once

#include <optional>
#include <vector>

#include "renderers/methods/reference/estimate.h"
#include "renderers/methods/reference/passes.h"
#include "renderers/methods/reference/progress.h"

namespace ir::methods::reference {

/// Layers of sums: those of the randomisations, all light together, then, where the picture is made of parts,
/// direct and indirect light.
constexpr int direct_layer = randomisations, indirect_layer = randomisations + 1;

/// Light that no path from the camera finds (light_tracer.h): declares "reference.light_sums", to be added to
/// the sums of the camera's paths, and the pass "trace light". Each sample has as many paths as there are
/// pixels. Nothing where there are none. `specular`: specular_materials() of the scene.
std::optional<graph::ImageRef> trace_light(graph::GraphBuilder& builder, const PathInputs& inputs,
                                           const Parameters& parameters, const std::vector<bool>& specular,
                                           const Progress& progress, const std::shared_ptr<Tally>& tally,
                                           int layers);

}  // namespace ir::methods::reference
