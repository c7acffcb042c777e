#pragma once

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

}  // namespace ir::passes
