// By bits: compilers may assume that there are no other numbers.
bool is_finite(float x) { return (floatBitsToUint(x) & 0x7f800000u) != 0x7f800000u; }
bool is_finite(vec3 v) { return is_finite(v.x) && is_finite(v.y) && is_finite(v.z); }
bool is_finite(vec4 v) { return is_finite(v.xyz) && is_finite(v.w); }
