#pragma once

#include "renderers/core/transport.h"
#include "renderers/passes/ldm/builder.h"

namespace ir::methods::ldm_ao {

enum class SelfHit { tangent_plane, normal_offset };
/// Which hits come from exact rays instead of the maps.
enum class Exact { none, near, all };

struct Parameters {
    int directions = 128;
    int resolution = 200;
    passes::ldm::StorageKind storage = passes::ldm::StorageKind::arrays;
    passes::ldm::BuilderKind builder = passes::ldm::BuilderKind::compute;
    Transport transport;
    SelfHit self_hit = SelfHit::tangent_plane;
    float self_hit_tolerance = 3;
    float slope_tolerance = 0.35f;
    float largest_dip = 1;
    float normal_offset = 1;
    Exact exact = Exact::none;
    float exact_texels = 4;
    bool progressive = false;
    float ambient = 0.5f;
};

ParameterTable<Parameters> parameter_table();

}  // namespace ir::methods::ldm_ao
