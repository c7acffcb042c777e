// The leg on which a photon came: map, whether along its direction or against it, or whether directly from the
// light; what of its kernel lies beyond its surface; and the light.
// C++: ir::methods::ldm_indirect::*
const uint LEG_MAP = 0xffffu, LEG_ALONG = 1u << 16, LEG_DIRECT = 1u << 17, LEG_BEYOND_SHIFT = 18u,
           LEG_BEYOND = 63u, LEG_LIGHT_SHIFT = 24u;
/// What of a kernel may count as lost beyond its surface, in 1/64: what is left is at most so much brighter.
// C++: ir::methods::ldm_indirect::max_beyond
const uint MAX_BEYOND = 48u;

/// A photon where it arrived, with its differential. 80 bytes. Seen as glyphs, photons are their footprints.
// C++: ir::methods::ldm_indirect::Photon
struct Photon {
    vec3 centre_ws;
    uint source;  // number of the primary photon; the first are texels of the lights' images:
                  // (layer * side + row) * side + column, side being `emission`
    vec3 axis_u;  // m: half of D_u x, before scaling by splat_size and clamping
    uint leg;     // LEG_…: bits 0-15 map, counted from 0; bit 16: 1 along its direction, 0 against it (or,
                  // bit 17: directly from the light); bits 18-23: 64ths of the kernel that lie beyond its
                  // surface; bits 24-31: light
    vec3 axis_v;  // m: half of D_v x
    float path_length;  // m: from the light
    vec3 flux;    // W
    uint normal;  // geometric normal of the receiver, on the viewer's side; octahedral, 2 x 16 bits SNORM
    float distance;  // m: from the first surface; 0: directly from the light
    float unused0, unused1, unused2;
};

/// Of the kernel.
float part_on_surface(Photon photon) { return 1.0 - float(photon.leg >> LEG_BEYOND_SHIFT & LEG_BEYOND) / 64.0; }
