// The plane of a triangle, as exactly as single precision allows.

struct TrianglePlane {
    vec3 normal;  // unit length, by the winding; 0 for a triangle without area
    vec3 anchor;  // a corner
};

/// The cross product of the two shortest edges, which loses the fewest bits on slivers; lengths are scaled
/// first so that tiny triangles do not underflow.
TrianglePlane triangle_plane(vec3 a, vec3 b, vec3 c) {
    vec3 ab = b - a, bc = c - b, ca = a - c;
    float ab2 = dot(ab, ab), bc2 = dot(bc, bc), ca2 = dot(ca, ca);
    float longest = sqrt(max(ab2, max(bc2, ca2)));
    if (!(longest > 1e-30)) return TrianglePlane(vec3(0), a);  // the squares underflow
    vec3 anchor = a, first = -ca, second = ab;  // the longest edge is the one left out
    if (ab2 >= bc2 && ab2 >= ca2) {
        anchor = c;
        first = -bc;
        second = ca;
    } else if (ca2 >= bc2) {
        anchor = b;
        first = -ab;
        second = bc;
    }
    vec3 normal = cross(second / longest, first / longest);
    float size = length(normal);
    return TrianglePlane(size > 0.0 ? normal / size : vec3(0), anchor);
}
