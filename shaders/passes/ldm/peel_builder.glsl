// What the steps of depth peeling share.
#include "passes/ldm/builder.glsl"
#define LDM_ARRIVALS
#include "passes/ldm/fragments.glsl"

struct LdmPeeledChunk {
    uint first, planes, end;
};
layout(std430, binding = 13) coherent buffer LdmPeeledChunks { LdmPeeledChunk chunks[]; };
layout(std430, binding = 14) coherent buffer LdmPlanes { uint planes[]; };
/// Sizes of indirect dispatches, plane by plane.
layout(std430, binding = 7) buffer LdmPeeledLayers { uint layer_groups[]; };
layout(std430, binding = 9) buffer LayersAsked { uint layers_asked; };
layout(std430, binding = 10) buffer PlanesAsked { uint planes_asked; };

uniform uint chunk;         // in the batch
uniform uint plane_texels;  // of a chunk with all its maps
