#pragma once

#include "renderers/core/transport.h"
#include "renderers/passes/direct/light_parameters.h"
#include "renderers/passes/ldm/parameters.h"

namespace ir::methods::ldm_ao {

/// Which hits come from exact rays instead of the maps.
enum class Exact { none, near, all, selected };

/// Whether exact hits stand in place of those of a map while it is queried.
inline bool replaces_hits(Exact exact) {
    return exact == Exact::near || exact == Exact::all;
}

/// How the set of directions lies. Counts from 0 in the order of the choices of parameter "orientation".
enum class Orientation { level, tilted };

/// What shines from outside in the output "lit".
enum class AmbientSource { constant, environment };

struct Parameters {
    passes::ldm::MapParameters maps;
    passes::ldm::NodeKind nodes = passes::ldm::NodeKind::sloped;
    Transport transport = default_occlusion;
    Exact exact = Exact::none;
    float exact_texels = 4;
    Orientation orientation = Orientation::level;
    bool progressive = false;
    AmbientSource ambient_source = AmbientSource::constant;
    float ambient = 0.5f;
    passes::LightParameters light;
};

ParameterTable<Parameters> parameter_table();

}  // namespace ir::methods::ldm_ao
