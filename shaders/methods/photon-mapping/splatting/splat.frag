// Adds the photon to the texels that its kernel covers.  [Smal19 §6.2]
layout(early_fragment_tests) in;

#include "methods/photon-mapping/splatting/kernel.glsl"
#include "methods/photon-mapping/splatting/splat_view.glsl"
#include "methods/photon-mapping/splatting/inside.glsl"

layout(location = 0) flat in vec4 add_irradiance;
layout(location = 1) flat in vec2 add_direction;
layout(location = 2) flat in vec3 centre_ws;
layout(location = 3) flat in vec3 n_ws;
layout(location = 4) flat in vec3 u_ws;
layout(location = 5) flat in vec3 t_ws;
layout(location = 6) flat in vec3 axes;
layout(location = 7) flat in vec3 to_light_ws;

#ifdef COUNT
layout(location = 0) out float out_count;
#else
layout(location = 0) out vec4 out_irradiance;
layout(location = 1) out vec2 out_direction;
#endif

void main() {
    if (!covers_texel(centre_ws, n_ws, u_ws, t_ws, axes, to_light_ws, ivec2(gl_FragCoord.xy))) discard;
#ifdef COUNT
    out_count = 1.0;
#else
    out_irradiance = add_irradiance;
    out_direction = add_direction;
#endif
}
