// A photon where it arrived, with its differential: equals ir::methods::ldm_indirect::Photon. 64 bytes in std430.
struct Photon {
    vec3 position_ws;
    uint source;  // texel of the lights' images: (layer * side + row) * side + column
    vec3 axis_u;  // m: half of D_u x
    uint leg;     // bits 0-15 map; bit 16: 1 along its direction, 0 against it; bit 17: directly from the
                  // light; bits 24-31: light
    vec3 axis_v;  // m: half of D_v x
    float path_length;
    vec3 flux;    // W
    uint normal;  // geometric, on the viewer's side; octahedral
};
