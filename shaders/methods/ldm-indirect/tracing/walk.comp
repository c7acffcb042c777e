// Walks through the map that a photon was traced through, from where it was split. [Aalund15 §3.1, Fig. 4]
layout(local_size_x = 1) in;
#include "passes/ldm/frames.glsl"
#include "passes/ldm/storage.glsl"
#define LDM_VIEWS
#include "passes/ldm/trace.glsl"
#include "passes/ldm/self_hit.glsl"
#include "passes/ldm/way_out.glsl"

float reach_quanta(MapFrame frame) { return LDM_FAR_QUANTA; }
float open_length(vec3 position_ws, vec3 direction) { return way_out(position_ws, direction); }
#include "passes/ldm/walk.glsl"

/// Where the photon was split.
// C++: ir::methods::ldm_indirect::SplitPlace
struct SplitPlace {
    vec3 position_ws;
    uint map;         // that its way is along; NO_MAP: there is no photon
    vec3 shading_ws;  // shading normal
    float unused0;
    vec3 normal_ws;   // geometric
    float unused1;
};
layout(std430) readonly buffer Split { SplitPlace split; };

// C++: ir::methods::ldm_indirect::no_map
const uint NO_MAP = 0xffffffffu;

uniform uint first_map;  // of the batch that is in memory

void main() {
    if (split.map == NO_MAP || split.map < first_map) return;
    frame_index = split.map;
    map = split.map - first_map;
    walk_from(split.position_ws, split.shading_ws, split.normal_ws);
}
