#pragma once

#include "renderers/core/transport.h"
#include "renderers/passes/blur/blur.h"
#include "renderers/passes/direct/light_parameters.h"

namespace ir::methods::ssdo {

/// Counts from 0 in the order of the choices of "estimator".
enum class Estimator { density, published };
/// The same of "turning".
enum class Turning { none, pattern, hash };
/// The same of "environment_by".
enum class EnvironmentBy { samples, occlusion };

struct Parameters {
    int samples = 16;
    int layers = 1;
    Transport transport{.paths = default_light.paths, .max_distance = 1};
    EnvironmentBy environment_by = EnvironmentBy::samples;
    float step_radius = 0;  ///< m; 0: the maximum distance
    Estimator estimator = Estimator::density;
    float strength = 1;
    float min_distance = 0.2f;
    Turning turning = Turning::pattern;
    passes::BlurParameters blur{.radius = 3};
    passes::LightParameters light;
};

ParameterTable<Parameters> parameter_table();

}  // namespace ir::methods::ssdo
