// Where along its ray a photon lights what it meets, in ways from its sender to where it lands.
/// DEVIATION [Aalund15 §3.4, eq. 5]: print lights whatever lies in an ellipsoid about the receiver's plane: surfaces
/// behind thin walls, too, and it loses what bends away from the plane. A beam gives each surface that it meets first
/// the same flux across it.
// C++: ir::methods::ldm_indirect::beam_begins
const float BEAM_BEGINS = 0.4;
// C++: ir::methods::ldm_indirect::beam_ends
const float BEAM_ENDS = 3.0;
