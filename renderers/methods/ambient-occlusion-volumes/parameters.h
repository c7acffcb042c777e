#pragma once

#include "renderers/core/transport.h"
#include "renderers/passes/bounce/directions.h"
#include "renderers/passes/bounce/reconstruction.h"
#include "renderers/passes/direct/light_parameters.h"
#include "renderers/scene/world.h"

namespace ir::methods::ambient_occlusion_volumes {

/// Count from 0 in the order of the choices of the parameters of the same names.
enum class Sides { front, both };
enum class Compensation { none, independent, measured };

struct Parameters {
    bool visibility = true;  ///< by bounced z-buffer; else additive, as published in 2010
    Transport transport = default_occlusion;
    passes::bounce::DirectionParameters directions;
    Sides sides = Sides::front;                      ///< without visibility
    Compensation compensation = Compensation::none;  ///< without visibility
    passes::bounce::ReconstructionParameters reconstruction;
    bool culling = true;
    float ambient = 0.5f;
    passes::LightParameters light;
};

ParameterTable<Parameters> parameter_table();

/// Whether volumes stand on both sides of their triangles: a ray meets triangles from either.
bool both_sides(const Parameters& parameters);

/// How far triangles reach, m: the maximum distance, or where that is 0 as far as anything is apart.
float reach_of(const Parameters& parameters, const scene::World& world);

}  // namespace ir::methods::ambient_occlusion_volumes
