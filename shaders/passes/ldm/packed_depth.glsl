// Depths of LDM_PACKED_BITS bits, which stand for the middle of the quanta that are rounded to them.
const int PACKED_BITS = LDM_PACKED_BITS;
const int PACKED_AWAY = 16 - PACKED_BITS;
/// Bits of a node: with LDM_SLOPES codes of slopes stand below its depth.
#ifdef LDM_SLOPES
const int NODE_BITS = PACKED_BITS + 16;
#else
const int NODE_BITS = PACKED_BITS;
#endif

uint packed_depth(uint depth) {
    return depth >> PACKED_AWAY;
}

uint unpacked_depth(uint bits) {
    return bits << PACKED_AWAY | 1u << (PACKED_AWAY - 1);
}
