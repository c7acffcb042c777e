#pragma once

#include <vector>

#include "renderers/core/output.h"
#include "renderers/core/parameter.h"

namespace ir::methods::ldm_indirect {

enum class Gloss { none, mirror, lobe };
enum class GlossTracer { maps, cube, rays };
enum class GlossLanding { direction, plane };

/// What interfaces that are seen reflect of the scene.
struct GlossParameters {
    Gloss kind = Gloss::lobe;                    ///< where they look
    GlossTracer tracer = GlossTracer::rays;      ///< what finds what is there
    GlossLanding landing = GlossLanding::plane;  ///< of a map's hit
    float near = 4;                              ///< texels within which exact rays look first
    int samples = 4;                             ///< directions of a pixel and frame
    float highlight_rays = 1;                    ///< of them meet a highlight at least
};

ParameterTable<GlossParameters> gloss_parameters();
std::vector<OutputDescription> gloss_outputs();

}  // namespace ir::methods::ldm_indirect
