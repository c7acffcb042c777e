// The leg on which a photon came: map, whether along its direction or against it, or whether directly from the
// light; and the light.
const uint LEG_MAP = 0xffffu, LEG_ALONG = 1u << 16, LEG_DIRECT = 1u << 17, LEG_LIGHT_SHIFT = 24u;

// A photon where it arrived, with its differential: equals ir::methods::ldm_indirect::Photon. 64 bytes in std430.
struct Photon {
    vec3 centre_ws;
    uint source;  // texel of the lights' images: (layer * side + row) * side + column
    vec3 axis_u;  // m: half of D_u x
    uint leg;     // see LEG_…
    vec3 axis_v;  // m: half of D_v x
    float path_length;
    vec3 flux;    // W
    uint normal;  // geometric, on the viewer's side; octahedral
};
