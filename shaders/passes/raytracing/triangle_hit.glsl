// A ray against a triangle, in coordinates relative to the ray's origin.

/// Of the sum of the three sides: what a side may lie on the wrong side of 0. Without it 1 in 10,000 rays at
/// edges slipped through (6 of 59,040, one mesh).
const float TRIANGLE_SLACK = 1.1920929e-7;

vec3 exact_cross(vec3 a, vec3 b) {
    precise vec3 c = a.yzx * b.zxy - a.zxy * b.yzx;
    return c;
}

/// Twice the volume that the direction spans with the edge from p to q: on which side the ray passes. Only
/// its sign changes when p and q change places, bit for bit, so that no ray slips between two triangles that
/// share an edge. Sum and difference of p and q in place of themselves keep the error in proportion to the
/// edge's length, not to the square of its distance.  After the robust test of Embree. [Davidovic12]
float side_of_edge(vec3 p, vec3 q, vec3 direction) {
    precise vec3 moment = exact_cross(q - p, p + q);
    precise float x = moment.x * direction.x, y = moment.y * direction.y, z = moment.z * direction.z;
    precise float volume = (x + y) + z;
    return volume;
}

/// The product of whichever two edges loses less, by component: slivers have one that loses nearly all.
vec3 stable_normal(vec3 e0, vec3 e1, vec3 e2) {
    vec3 p = e0.yzx * e1.zxy, q = e0.zxy * e1.yzx, r = e1.yzx * e2.zxy, s = e1.zxy * e2.yzx;
    return mix(r - s, p - q, lessThan(abs(q), abs(s)));
}

/// Weights u and v of corners b and c. Both sides count; no hit where the triangle is seen edge-on, or has
/// lost its area.
bool hits_triangle(vec3 a, vec3 b, vec3 c, vec3 direction, out float distance, out float u, out float v) {
    float w_a = side_of_edge(b, c, direction), w_b = side_of_edge(c, a, direction),
          w_c = side_of_edge(a, b, direction);
    distance = u = v = 0.0;
    float sum = w_a + w_b + w_c, slack = TRIANGLE_SLACK * abs(sum);
    if (min(w_a, min(w_b, w_c)) < -slack && max(w_a, max(w_b, w_c)) > slack) return false;
    vec3 normal = stable_normal(b - a, c - b, a - c);
    float rise = dot(normal, direction);
    if (sum == 0.0 || rise == 0.0) return false;
    distance = dot(normal, a) / rise;
    u = min(w_b / sum, 1.0);
    v = min(w_c / sum, 1.0);
    return true;
}
