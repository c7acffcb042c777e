// The leg on which a photon came: map, whether along its direction or against it, or whether directly from the
// light; and the light.
const uint LEG_MAP = 0xffffu, LEG_ALONG = 1u << 16, LEG_DIRECT = 1u << 17, LEG_LIGHT_SHIFT = 24u;

/// A photon where it arrived, with its differential. 64 bytes. Seen as glyphs, photons are their footprints.
// C++: ir::methods::ldm_indirect::Photon
struct Photon {
    vec3 centre_ws;
    uint source;  // texel of the lights' images: (layer * side + row) * side + column, side being `emission`
    vec3 axis_u;  // m: half of D_u x, before scaling by splat_size and clamping
    uint leg;     // LEG_…: bits 0-15 map, counted from 0; bit 16: 1 along its direction, 0 against it (or,
                  // bit 17: directly from the light); bits 24-31: light
    vec3 axis_v;  // m: half of D_v x
    float path_length;  // m: from the light
    vec3 flux;    // W
    uint normal;  // geometric normal of the receiver, on the viewer's side; octahedral, 2 x 16 bits SNORM
};
