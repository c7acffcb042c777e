// Random numbers from hashes of integers: stateless or with a small state, the same on every device.

// Hashes of one to four words. [Jarzynski20 listings of pcg, pcg2d, pcg3d, pcg4d]
uint pcg(uint v) {
    uint state = v * 747796405u + 2891336453u;
    uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

uvec2 pcg2d(uvec2 v) {
    v = v * 1664525u + 1013904223u;
    v.x += v.y * 1664525u;
    v.y += v.x * 1664525u;
    v ^= v >> 16u;
    v.x += v.y * 1664525u;
    v.y += v.x * 1664525u;
    v ^= v >> 16u;
    return v;
}

uvec3 pcg3d(uvec3 v) {
    v = v * 1664525u + 1013904223u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v ^= v >> 16u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    return v;
}

uvec4 pcg4d(uvec4 v) {
    v = v * 1664525u + 1013904223u;
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    v ^= v >> 16u;
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    return v;
}

// Uniform in [0, 1): the upper 24 bits, which float holds exactly, so that 1 is never reached.
float unit_float(uint bits) { return float(bits >> 8u) * (1.0 / 16777216.0); }
vec2 unit_float(uvec2 bits) { return vec2(bits >> 8u) * (1.0 / 16777216.0); }
vec3 unit_float(uvec3 bits) { return vec3(bits >> 8u) * (1.0 / 16777216.0); }
vec4 unit_float(uvec4 bits) { return vec4(bits >> 8u) * (1.0 / 16777216.0); }
