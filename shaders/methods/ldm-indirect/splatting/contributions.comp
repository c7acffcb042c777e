// What each photon adds to pixels of a grid, in no order. One invocation has one photon.
#include "lib/luminance.glsl"
#include "methods/ldm-indirect/splatting/kernel.glsl"
#include "methods/ldm-indirect/splatting/outline.glsl"
#include "passes/ldm/effect_pixels.glsl"
#ifdef CLIPPED
#include "methods/ldm-indirect/splatting/clipping.glsl"
#endif

layout(local_size_x = 64) in;

layout(std430) readonly buffer Photons { Photon photons[]; };
/// Of a photon to a pixel's irradiance.
// C++: ir::methods::ldm_indirect::Contribution
struct Contribution {
    uint cell;    // of the grid
    uint source;  // primary photon
    uint leg;     // LEG_…
    float light;  // luminance, W/m²
};
layout(std430) writeonly buffer Contributions { Contribution contributions[]; };
layout(std430) buffer ContributionCount { uint contribution_count; };
layout(std430) buffer Found { uint found; };  // as many, for the host

uniform uint first_item, end_item;

void add_to_cell(Kernel k, Photon photon, uint cell) {
    EffectSurface x = surface_of(cell);
    vec3 irradiance;
    if (!x.exists || !add_kernel(k, x.position, x.geometric_normal, irradiance)) return;
#ifdef CLIPPED
    if (!is_lit(k, pixel_of(cell), textureSize(gbuffer_position, 0), x.position)) return;
#endif
    atomicAdd(contribution_count, 1u);
    uint place = atomicAdd(found, 1u);
    if (place < uint(contributions.length()))
        contributions[place] = Contribution(cell, photon.source, photon.leg, luminance(irradiance));
}

void main() {
    uint i = first_item + gl_GlobalInvocationID.x;
    if (i >= min(end_item, stored)) return;
    Photon photon = photons[i];
    if ((photon.leg & LEG_DIRECT) != 0u) return;
    Footprint f = footprint_of(photon);
    if (!f.counts) return;
    Outline o = outline_of(f);
    if (!is_in_view(o)) return;
    Kernel k = kernel_of(f);
    ivec4 bounds = pixels_of(o);
    ivec2 first = max(bounds.xy - first_pixel + pixel_step - 1, ivec2(0)) / pixel_step;
    // One more, as pixels of the last cells are moved into the picture.
    ivec2 last = min((bounds.zw - first_pixel + pixel_step - 1) / pixel_step, cells - 1);
    for (int y = first.y; y <= last.y; ++y)
        for (int x = first.x; x <= last.x; ++x) add_to_cell(k, photon, uint(y * cells.x + x));
}
