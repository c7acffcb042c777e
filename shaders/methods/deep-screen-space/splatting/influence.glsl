// How far a surfel reaches.

uniform float shell_radius;  // m: d, where it is the same for all surfels; else its least value
uniform float whole_reach;   // m: nothing has an effect beyond
uniform float trade_off;     // ε; 0: d is the same for all surfels
uniform int open_level;      // whose shell ends at the whole reach; -1: none

/// d of the surfel, m: where the form factor of its disc, A / (π d²), is ε, or farther out, where the last shell would
/// else end before the whole reach.
float first_shell(float radius) {
    return trade_off > 0.0 ? max(radius * inversesqrt(trade_off), shell_radius) : shell_radius;
}

/// The surfel's shell of a level, m: beyond `inner`, up to `outer`; empty where they are equal.
struct Shell {
    float inner, outer;
};

Shell shell_of(float radius, int level) {
    float outer = ldexp(first_shell(radius), level);
    float inner = level == 0 ? 0.0 : 0.5 * outer;
    return Shell(min(inner, whole_reach), level == open_level ? whole_reach : min(outer, whole_reach));
}
