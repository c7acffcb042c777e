/// A vector as a member of a record that lies in memory without gaps.
float[3] floats(vec3 v) { return float[3](v.x, v.y, v.z); }

/// Views skip what lies here.
const vec3 NOWHERE = vec3(uintBitsToFloat(0x7fc00000u));

// By bits: compilers may assume that there are no other numbers.
bool is_finite(float x) { return (floatBitsToUint(x) & 0x7f800000u) != 0x7f800000u; }
bool is_finite(vec3 v) { return is_finite(v.x) && is_finite(v.y) && is_finite(v.z); }
bool is_finite(vec4 v) { return is_finite(v.xyz) && is_finite(v.w); }
