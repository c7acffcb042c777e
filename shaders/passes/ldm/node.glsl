// What a node with slopes (nodes=sloped) says of its surface beside its depth at the texel's centre: the depth that it
// gains a column and a row, in 8 bits each. A plain node has a depth alone. On the host:
// renderers/passes/ldm/host/node.h, and vectors in rasterise.inl and query_lists.inl.
//
// DEVIATION [Aalund15 §3.1]: nodes of the paper are depths. A hit must also lie before x where its slopes say that
// its surface is at x's own place. Slopes alone are worse than plain depths: on convex detail a neighbour's plane,
// continued to x, lies in front of x.

/// A slope s, in sides of a texel per texel, is kept as s / (1 + |s|) in so many steps; codes end before infinity.
// C++: ir::passes::ldm::*
const float LDM_SLOPE_STEPS = 127.0, LDM_MAX_SLOPE_CODE = 126.0;

/// Larger slopes, of surfaces that a map sees edge-on, are kept as this.
// C++: ir::passes::ldm::*
const float LDM_MAX_KEPT_SLOPE = 1e6;

/// Largest slope that queries reckon with, in quanta per texel: the host holds twice as many in 16 bits.
// C++: ir::passes::ldm::max_slope_quanta
const float LDM_MAX_SLOPE = 16383.0;

/// Nodes farther beyond the depth from which hits count, in sides of a texel, are hits whatever their slopes: so far
/// their surface need not reach.
// C++: ir::passes::ldm::slope_reach
const float LDM_SLOPE_REACH = 2.0;

/// This part of the rule's slope tolerance is enough: at the texel's centre it need not cover curved surfaces, since
/// slopes must agree, too. Measured at 128 maps of 200² and 3 m, RMSE of all pixels on Sponza and in the atrium: 0.037
/// and 0.039; with the whole 0.042 and 0.049, with 0.6 of it 0.038 and 0.042, with none 0.039 and 0.039.
// C++: ir::passes::ldm::sloped_tolerance
const float LDM_SLOPED_TOLERANCE = 0.3;

/// Tells whether nodes lie before x by their slopes, too.
struct LdmSlopeTest {
    vec2 place;  // of x, texels from the texel's centre
    float depth, tolerance, texel_quanta;
    int key;  // as ldm_neighbours() takes it
    bool forward;
};

/// Codes of both slopes, in quanta per texel, that of the columns in the lower half of 16 bits.
uint ldm_slope_codes(vec2 slope, float texel_quanta) {
    vec2 s = clamp(slope / texel_quanta, -LDM_MAX_KEPT_SLOPE, LDM_MAX_KEPT_SLOPE);
    ivec2 code = ivec2(clamp(round(LDM_SLOPE_STEPS * s / (1.0 + abs(s))), -LDM_MAX_SLOPE_CODE, LDM_MAX_SLOPE_CODE));
    return uint(code.x & 0xff) | uint(code.y & 0xff) << 8;
}

/// The slopes that codes stand for, whole quanta per texel.
vec2 ldm_slopes(uint codes, float texel_quanta) {
    vec2 s = vec2(bitfieldExtract(int(codes), 0, 8), bitfieldExtract(int(codes), 8, 8)) / LDM_SLOPE_STEPS;
    return clamp(round(s / (1.0 - abs(s)) * texel_quanta), -LDM_MAX_SLOPE, LDM_MAX_SLOPE);
}

/// Quanta by which x's own surface may seem to lie before x, `place` texels from the centre, since codes are rounded:
/// half a step of its slopes, at most a side of a texel.
float ldm_slope_tolerance(vec2 slope, vec2 place, float texel_quanta) {
    vec2 widening = 1.0 + abs(slope) / texel_quanta;
    return texel_quanta * min(dot(abs(place), widening * widening) / (2.0 * LDM_SLOPE_STEPS), 1.0);
}

/// Of a node that lies beyond the key.
bool ldm_lies_before(LdmSlopeTest test, int depth, uint codes) {
    int ahead = test.forward ? depth - test.key + 1 : test.key - depth;
    if (float(ahead) > floor(LDM_SLOPE_REACH * test.texel_quanta)) return true;
    float here = float(depth) + dot(ldm_slopes(codes, test.texel_quanta), test.place);
    return (test.forward ? here - test.depth : test.depth - here) > test.tolerance;
}
