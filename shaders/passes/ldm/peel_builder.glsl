// What the steps of depth peeling share.
#include "passes/ldm/chunk.glsl"
#define LDM_ARRIVALS
#include "passes/ldm/fragments.glsl"

struct LdmPeeledChunk {
    uint first, planes, end;
};
layout(std430) coherent buffer LdmPeeledChunks { LdmPeeledChunk chunks[]; };
layout(std430) coherent buffer LdmPlanes { uint planes[]; };
/// Sizes of indirect dispatches, plane by plane.
layout(std430) buffer LdmPeeledLayers { uint layer_groups[]; };
layout(std430) buffer LayersRequested { uint layers_requested; };
layout(std430) buffer PlanesRequested { uint planes_requested; };

uniform uint chunk;         // in the batch
uniform uint plane_texels;  // of a chunk with all its maps
uniform uint plane_room;    // entries of planes that there is room for
