#pragma once

#include "renderers/core/transport.h"
#include "renderers/passes/blur/blur.h"
#include "renderers/passes/direct/light_parameters.h"

namespace ir::methods::hbao {

/// Counts from 0 in the order of the choices of "weighting".
enum class Weighting { cosine, published };
/// The same of "turning".
enum class Turning { none, pattern, hash };

struct Parameters {
    int directions = 16;
    int steps = 12;
    Transport transport = default_occlusion;
    Weighting weighting = Weighting::cosine;
    Turning turning = Turning::pattern;
    float angle_bias = 5;
    passes::BlurParameters blur{.radius = 3};
    float ambient = 0.5f;
    passes::LightParameters light;
};

ParameterTable<Parameters> parameter_table();

}  // namespace ir::methods::hbao
