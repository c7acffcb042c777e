// What a ray from a light carries, beside where it is in the buffer of rays. 32 bytes.
// C++: ir::methods::photon_mapping::EmittedRay
struct EmittedRay {
    vec3 power;   // W
    float range;  // m, at which a point or spot light ends; 0: nowhere
    uint light;   // light_name()
    uint has_extent;  // 1: light samples find its direct light
    uint unused[2];
};
