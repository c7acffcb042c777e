// How far a surfel reaches.

uniform float shell_radius;  // m: d, where it is the same for all surfels; else its least value
uniform float whole_reach;   // m: nothing has an effect beyond
uniform float trade_off;     // ε; 0: d is the same for all surfels
uniform bool dark_is_idle;   // surfels that send no light do nothing

/// d of the surfel, m: where the form factor of its disc, A / (π d²), is ε, or farther out, where the last shell would
/// else end before the whole reach; 0: it does nothing.
// DEVIATION [Nalbach14]: "depending on the estimated influence" [Nalbach15 §4.1] leaves open which; there it also
// depends on the radiance that is sent, which here only counts as none or some, as ε would else depend on exposure.
float first_shell(Surfel surfel) {
    if (dark_is_idle && surfel.radiance_front == vec3(0) && surfel.radiance_back == vec3(0)) return 0.0;
    return trade_off > 0.0 ? max(surfel.radius * inversesqrt(trade_off), shell_radius) : shell_radius;
}

/// The surfel's shell of a level, m: beyond `inner`, up to `outer`; empty where they are equal.
struct Shell {
    float inner, outer;
};

Shell shell_of(Surfel surfel, int level) {
    float outer = ldexp(first_shell(surfel), level);
    float inner = level == 0 ? 0.0 : 0.5 * outer;
    return Shell(min(inner, whole_reach), min(outer, whole_reach));
}
