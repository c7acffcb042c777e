#pragma once

#include "renderers/methods/reference/estimate.h"
#include "renderers/methods/reference/passes.h"
#include "renderers/methods/reference/path_world.h"
#include "renderers/methods/reference/progress.h"

namespace ir::methods::reference {

/// Layers of sums: those of the randomisations, all light together, then, where the picture is made of parts,
/// direct and indirect light.
constexpr int direct_layer = randomisations, indirect_layer = randomisations + 1;

/// What light brings that is traced from its sources (light_tracer.h): declares "reference.light_sums", to be
/// added to the sums of the camera's paths, and the pass "trace light". Each sample has as many paths as
/// there are pixels. `inputs` must have an emission. `materials`: sharp_materials() of the scene.
graph::ImageRef trace_light(graph::GraphBuilder& builder, const PathInputs& inputs,
                            const Parameters& parameters, const SharpMaterials& materials,
                            const Progress& progress, const std::shared_ptr<Tally>& tally, int layers);

}  // namespace ir::methods::reference
