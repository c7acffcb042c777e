// The map by which photons are emitted: survival at the first surface times the light's fall-off.  [Smal19 §5.2]
// DEVIATION [Smal19 §5.2]: the fall-off has the texel's extent as a factor, so that photons have equal powers
// before the surface over wide cones and the faces of a cube, too.
layout(local_size_x = 8, local_size_y = 8) in;
#include "methods/photon-mapping/emission/rsm.glsl"

layout(r32f) uniform writeonly image2DArray probability;

uniform int first_layer, layers_drawn;

void main() {
    ivec3 place = ivec3(gl_GlobalInvocationID) + ivec3(0, 0, first_layer);
    int resolution = textureSize(shadow_maps, 0).x;
    if (any(greaterThanEqual(place.xy, ivec2(resolution)))) return;
    float value = 0.0;
    if (place.z < layers_drawn && texelFetch(rsm_normal_metalness, place, 0).w != 0.0) {
        RsmTexel t = rsm_texel(place.xy, place.z);
        float survival = rsm_survival(t);
        if (survival > 0.0) value = survival * t.part * t.extent_part;
    }
    imageStore(probability, place, vec4(value));
}
