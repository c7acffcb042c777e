/// 1 beyond d_max; below it 0 or (d/d_max)². [Aalund15 §3.3]
float visibility(float distance_ws) {
    if (params.falloff == FALLOFF_HARD) return 0.0;
    float part = distance_ws / params.max_distance;
    return part * part;
}

/// V of what a ray meets first, or of a ray that meets nothing.
float openness(bool is_hit, float distance_ws) {
    return !is_hit ? 1.0 : params.max_distance > 0.0 ? visibility(distance_ws) : 0.0;
}
