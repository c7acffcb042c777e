// Rays and their first hits, as renderers/passes/raytracing/trace_rays.h describes them. Every ray of the
// buffer is traced that has far > 0. Declare the buffers where they are used:
//
//   layout(std430) buffer Rays { Ray rays[]; };

/// 32 bytes.
// C++: ir::passes::RayRecord
struct Ray {
    vec3 origin_ws;
    float far;          // hits beyond are none; <= 0: no ray
    vec3 direction_ws;  // of unit length
    float any_hit;      // not 0: whether anything is hit is all that counts; the hit need not be the first
};

/// 16 bytes.
// C++: ir::passes::RayHitRecord
struct RayHit {
    float distance;  // infinite: nothing is hit
    uint triangle;   // of World::indices
    float u, v;      // barycentric weights of the triangle's second and third corner
};

const float RAY_INFINITY = uintBitsToFloat(0x7f800000u);

Ray no_ray() { return Ray(vec3(0), 0.0, vec3(0, 0, 1), 0.0); }
RayHit no_hit() { return RayHit(RAY_INFINITY, 0u, 0.0, 0.0); }
bool is_hit(RayHit hit) { return hit.distance < RAY_INFINITY; }
