// Form factor from a point with a normal to a polygon. [Baum89]

#include "lib/constants.glsl"

/// θ n·Γ of an edge, as seen from the origin; twice pi times its part. `q - p` in place of q loses less where both
/// are far away.
float edge_term(vec3 p, vec3 q, vec3 n) {
    vec3 moment = cross(p, q - p);
    float size = length(moment);
    return size > 0.0 ? atan(size, dot(p, q)) * dot(n, moment) / size : 0.0;
}

/// Of the triangle's part above the plane through the origin with the normal n: 0 … 1, positive where the
/// triangle is seen from the side that its winding points to.
float form_factor(vec3 p[3], vec3 n) {
    float above[3] = float[](dot(p[0], n), dot(p[1], n), dot(p[2], n));
    vec3 polygon[4];
    int count = 0;
    for (int i = 0; i < 3; ++i) {
        int next = (i + 1) % 3;
        if (above[i] > 0.0) polygon[count++] = p[i];
        if ((above[i] > 0.0) != (above[next] > 0.0))
            polygon[count++] = mix(p[i], p[next], above[i] / (above[i] - above[next]));
    }
    float sum = 0.0;
    for (int i = 0; i < count; ++i) sum += edge_term(polygon[i], polygon[i + 1 < count ? i + 1 : 0], n);
    return -sum / (2.0 * PI);
}
