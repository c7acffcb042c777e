/// A vector as a member of a record that lies in memory without gaps.
float[3] floats(vec3 v) { return float[3](v.x, v.y, v.z); }
