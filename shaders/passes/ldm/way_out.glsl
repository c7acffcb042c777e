// Where rays leave the scene, for views.

uniform vec3 scene_min, scene_max;

/// m, to the scene's bounds.
float way_out(vec3 position_ws, vec3 direction) {
    float length_ws = distance(scene_min, scene_max);
    for (int i = 0; i < 3; ++i) {
        if (direction[i] == 0.0) continue;
        float wall = direction[i] > 0.0 ? scene_max[i] : scene_min[i];
        length_ws = min(length_ws, max((wall - position_ws[i]) / direction[i], 0.0));
    }
    return length_ws;
}
