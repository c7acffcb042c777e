// V of the directions of a batch of maps, at pixels of the grid: one invocation queries one map for one pixel.
layout(local_size_x = 64) in;
#include "passes/ldm/effect_pixels.glsl"
#include "passes/ldm/frames.glsl"
#include "passes/ldm/storage.glsl"
#include "passes/ldm/trace.glsl"
#include "passes/ldm/self_hit.glsl"
#include "methods/ldm-ao/visibility.glsl"

/// By map, of all, and pixel: V of the direction that is above the surface.
layout(std430) writeonly buffer Openness { float openness_of[]; };

uniform uint first_item, end_item;
uniform uint first_frame;  // of the batch

void main() {
    uint item = first_item + gl_GlobalInvocationID.x;
    if (item >= end_item) return;
    uint map = item / pixel_count(), pixel = item % pixel_count();
    EffectSurface x = surface_of(pixel);
    if (!x.exists) return;
    MapFrame frame = ldm_frames[first_frame + map];
    bool forward = dot(x.normal, frame.direction.xyz) > 0.0;
    float facing = dot(x.geometric_normal, frame.direction.xyz), open = 0.0;
    if (forward ? facing > 0.0 : facing < 0.0) {  // else below the surface: closed
        float reach = params.max_distance > 0.0 ? params.max_distance / frame.direction.w : LDM_FAR_QUANTA;
        LdmHit hit = ldm_trace(frame, map, x.position, x.geometric_normal, forward, reach);
        open = openness(hit.found, max(hit.distance, 0.0) * frame.direction.w);
    }
    openness_of[(first_frame + map) * pixel_count() + pixel] = open;
}
