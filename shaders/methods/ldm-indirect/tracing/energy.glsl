// Rows of the table of energy: what was emitted and where it went.
// C++: ir::methods::ldm_indirect::*
const uint ROW_EMITTED = 0u, ROW_NOTHING = 1u, ROW_RANGE = 2u, ROW_DEGENERATE = 3u, ROW_ABSORBED = 4u,
           ROW_UNSPLIT = 5u, ROW_INDIRECT = 6u,  // and the causes behind the first surface
           ROW_DIRECT = 14u,                     // and the causes of photons that are stored there
           ENERGY_ROWS = 22u;

/// A row of "indirect.energy".
// C++: ir::methods::ldm_indirect::EnergyRow
struct Row {
    uint cause, leg;  // leg 0: to the first surface, 1: behind it, 2: stored there
    uint photons;
    float flux[3];  // W
};
