// How far a surfel reaches on level 0.

uniform float shell_radius;  // m: d, at most
uniform float trade_off;     // ε; 0: d is the same for all surfels
uniform bool dark_is_idle;   // surfels that send no light do nothing

/// m: where the form factor of the disc, A / (π d²), has fallen to ε; 0: the surfel does nothing.
// DEVIATION [Nalbach14]: "depending on the estimated influence" leaves open which; there it also depends on the
// radiance that is sent, which here only counts as none or some, as ε would else depend on exposure.
float surfel_reach(Surfel surfel) {
    if (dark_is_idle && surfel.radiance_front == vec3(0) && surfel.radiance_back == vec3(0)) return 0.0;
    return trade_off > 0.0 ? min(surfel.radius * inversesqrt(trade_off), shell_radius) : shell_radius;
}
