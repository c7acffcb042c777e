#pragma once

#include <vector>

#include "renderers/core/light_kind.h"
#include "renderers/core/parameter.h"

namespace ir::passes {

/// How direct light of sources with an extent is found: rectangles, disks, emissive meshes, the environment.
struct LightParameters {
    int light_samples = 16;
    bool light_filter = false;  ///< without a graphics card more samples do more in the same time
    float light_filter_strength = 2;
};

/// For every method with direct light.
ParameterTable<LightParameters> light_parameters();

/// What a description says to be missing without samples: light in these parts, of these kinds.
MissingLight without_light_samples(std::vector<LightPart> parts = {LightPart::direct},
                                   std::vector<LightKind> kinds = {LightKind::lamp, LightKind::surface,
                                                                   LightKind::environment});

}  // namespace ir::passes
