// The kernels of all photons as they are splatted, for views.
#include "lib/floats.glsl"
#include "methods/photon-mapping/splatting/photon_kernel.glsl"
#include "methods/photon-mapping/splatting/inside.glsl"

layout(local_size_x = 256) in;

// C++: ir::methods::photon_mapping::ShownKernel
struct ShownKernel {
    float centre[3], axis_u[3], axis_v[3], axis_w[3], irradiance[3];
    uint bounce, light;
    float radius;
    uint photon, lights_pixel;
};
layout(std430) writeonly buffer ShownKernels { ShownKernel shown[]; };
layout(std430) buffer KernelCount { uint kernel_count; };

uniform uint first_item, end_item;
uniform ivec2 picked_texel;  // negative: none

bool lights_pixel(Kernel k, Photon photon) {
    return picked_texel.x >= 0 && !isinf(texelFetch(depths, picked_texel, 0).x) &&
           covers_texel(k.centre_ws, k.n_ws, k.u_ws, k.t_ws, k.axes, direction_of(photon), picked_texel);
}

void main() {
    uint i = first_item + gl_GlobalInvocationID.x;
    uint end = min(end_item, stored);
    if (i == first_item) atomicMax(kernel_count, end);
    if (i >= end || i >= uint(shown.length())) return;
    Photon photon = photons[i];
    Kernel k = kernel_of(photon);
    shown[i].centre = floats(is_splatted(photon) ? k.centre_ws : NOWHERE);
    shown[i].axis_u = floats(k.axes.x * k.u_ws);
    shown[i].axis_v = floats(k.axes.y * k.t_ws);
    shown[i].axis_w = floats(k.axes.z * k.n_ws);
    shown[i].irradiance = floats(k.irradiance);
    shown[i].bounce = bounce_of(photon);
    shown[i].light = light_of(photon);
    shown[i].radius = k.radius;
    shown[i].photon = i;
    shown[i].lights_pixel = uint(lights_pixel(k, photon));
}
