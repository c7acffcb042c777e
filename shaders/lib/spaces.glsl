// Frames about a direction and packings of unit vectors. Vectors named `n` are of unit length.

// Columns: tangent, bitangent, n; right-handed. Discontinuous only across n.z = 0. [Duff17 listing 3]
mat3 frame_around(vec3 n) {
    float s = n.z >= 0.0 ? 1.0 : -1.0;
    float a = -1.0 / (s + n.z);
    float b = n.x * n.y * a;
    return mat3(vec3(1.0 + s * n.x * n.x * a, s * b, -s * n.x),
                vec3(b, s + n.y * n.y * a, -n.y),
                n);
}

// 1 for 0 too, so that nothing collapses onto an axis.
vec2 sign_not_zero(vec2 v) {
    return vec2(v.x >= 0.0 ? 1.0 : -1.0, v.y >= 0.0 ? 1.0 : -1.0);
}

// Unit vector to [-1, 1]²; covers the whole sphere. [Cigolle14 "oct"]
vec2 octahedral_from_direction(vec3 n) {
    vec2 p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
    return n.z >= 0.0 ? p : (1.0 - abs(p.yx)) * sign_not_zero(p);
}

// Inverse of octahedral_from_direction; of unit length.
vec3 direction_from_octahedral(vec2 p) {
    vec3 v = vec3(p, 1.0 - abs(p.x) - abs(p.y));
    if (v.z < 0.0) v.xy = (1.0 - abs(v.yx)) * sign_not_zero(v.xy);
    return normalize(v);
}

// Octahedral packing in 2 × 16 bits; the angular error is below 0.005 degrees.
uint packed_direction(vec3 n) { return packSnorm2x16(octahedral_from_direction(n)); }
vec3 unpacked_direction(uint bits) { return direction_from_octahedral(unpackSnorm2x16(bits)); }

// Stereographic projection from the pole -z: [-1, 1]² for directions with n.z >= 0, undefined at n = -z.
// [Cigolle14 "stereo"]
vec2 stereographic_from_direction(vec3 n) { return n.xy / (1.0 + n.z); }

// Inverse of stereographic_from_direction; of unit length.
vec3 direction_from_stereographic(vec2 p) {
    float d = dot(p, p);
    return vec3(2.0 * p, 1.0 - d) / (1.0 + d);
}
