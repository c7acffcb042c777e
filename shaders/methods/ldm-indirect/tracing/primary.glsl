// A photon from a pixel of a light's image, or from a source with an extent, to the first surface, x1.
// [Aalund15 §4.2, §6]
// 160 bytes. Differentials are halved, as in records of photons: transfer and rotation are linear.
// C++: ir::methods::ldm_indirect::Primary
struct Primary {
    vec3 position_ws;     // x1
    uint source;          // texel of the lights' images; behind them photons of sources with an extent
    vec3 axis_u;          // m: half of D_u x at x1
    uint light;           // number, or LIGHT_…
    vec3 axis_v;
    float path_length;    // m
    vec3 turn_u;          // half of D_u d
    float cosine_sum;     // Σ|cosθ| over the maps, θ to the shading normal
    vec3 turn_v;
    uint fate;            // one of PRIMARY_…
    vec3 direction_ws;    // d1, of travel, unit length
    float reached;        // part of the emitted flux that the light's range lets arrive
    vec3 normal_ws;       // geometric, on the light's side
    float solid_angle;    // sr of the pixel; m² for a directional light; 0 of a source with an extent
    vec3 shading_ws;      // shading normal
    float missed;         // part of `emitted` that rays that met nothing carry beside it: right in the mean
    vec3 emitted;         // W
    float unused0;
    vec3 reflectance;     // ρ
    float unused1;
};

// What stands in place of a light's number.
// C++: ir::methods::ldm_indirect::*
const uint LIGHT_MESH = 254u, LIGHT_ENVIRONMENT = 255u;

// C++: ir::methods::ldm_indirect::*
const uint PRIMARY_NOTHING = 0u,  // the pixel sees no surface, no light shines into it, or the ray leaves the scene
    PRIMARY_SPLITS = 1u,
    PRIMARY_DEGENERATE = 2u;      // its footprint has no size that a float holds

vec3 arrived_flux(Primary p) { return p.emitted * p.reached; }
vec3 reflected_flux(Primary p) { return arrived_flux(p) * p.reflectance; }
/// Black and unlit surfaces send nothing on.
bool sends_on(Primary p) { return p.fate == PRIMARY_SPLITS && reflected_flux(p) != vec3(0); }

/// What becomes of a photon behind x1, and of one that is stored at x1 itself.
// C++: enum ir::methods::ldm_indirect::Cause
const uint CAUSE_BELOW = 0u, CAUSE_LEFT = 1u, CAUSE_OUTSIDE = 2u, CAUSE_HIDDEN = 3u, CAUSE_BACK = 4u,
           CAUSE_DEGENERATE = 5u, CAUSE_STORED = 6u, CAUSE_STORED_HIDDEN = 7u;
// C++: ir::methods::ldm_indirect::causes
const uint CAUSES = 8u;

/// Parts of a primary photon's reflected flux, and numbers of photons, by cause.
// C++: ir::methods::ldm_indirect::Shares
struct Shares {
    float part[8];
    uint photons[8];
};
