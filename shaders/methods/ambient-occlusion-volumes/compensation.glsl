// The compensation map: what is open on average where the sum over all triangles has a value.
//
// DEVIATION [McGuire10]: the map's values are not the paper's, whose text was not at hand. They are means over the
// pixels of ten scenes of the accessibility by rays, piecewise linear and never rising, with a map for each fall-off
// and choice of sides; docs/methods/ambient-occlusion-volumes.md has the scenes and what it is worth.

const int NODES = 12;
const float NODE_SUMS[NODES] = float[NODES](0.0, 0.1, 0.2, 0.3, 0.5, 0.7, 1.0, 1.4, 2.0, 3.0, 4.5, 7.0);
const float HARD_FRONT[NODES] =
    float[NODES](1.0, 0.939, 0.883, 0.810, 0.684, 0.524, 0.338, 0.320, 0.232, 0.211, 0.199, 0.131);
const float HARD_BOTH[NODES] =
    float[NODES](1.0, 0.970, 0.933, 0.879, 0.790, 0.664, 0.519, 0.448, 0.396, 0.329, 0.201, 0.201);
const float SMOOTH_FRONT[NODES] =
    float[NODES](1.0, 0.923, 0.831, 0.719, 0.570, 0.375, 0.326, 0.287, 0.166, 0.153, 0.116, 0.116);
const float SMOOTH_BOTH[NODES] =
    float[NODES](1.0, 0.953, 0.887, 0.794, 0.678, 0.523, 0.449, 0.409, 0.387, 0.247, 0.150, 0.134);

float measured_at(int node) {
    if (params.falloff == FALLOFF_HARD) return params.sides == SIDES_FRONT ? HARD_FRONT[node] : HARD_BOTH[node];
    return params.sides == SIDES_FRONT ? SMOOTH_FRONT[node] : SMOOTH_BOTH[node];
}

float measured_accessibility(float sum) {
    int node = 0;
    while (node < NODES - 2 && sum > NODE_SUMS[node + 1]) ++node;
    float part = clamp((sum - NODE_SUMS[node]) / (NODE_SUMS[node + 1] - NODE_SUMS[node]), 0.0, 1.0);
    return mix(measured_at(node), measured_at(node + 1), part);
}
