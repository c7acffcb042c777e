/// A disc that stands for a piece of the scene's surface. 64 bytes. Seen as a glyph it is its disc.
// C++: ir::methods::deep_screen_space::Surfel
struct Surfel {
    vec3 centre_ws;
    uint triangle;        // of World::indices
    vec3 normal_ws;       // unit, of the triangle's plane, by its winding
    float radius;         // m: π radius² is the area that the surfel stands for
    vec3 radiance_front;  // W/(m² sr), on the normal's side: diffuse part of direct light, and emission
    uint barycentrics;    // unpackUnorm2x16: weights of the second and third corner
    vec3 radiance_back;   // on the other side
    uint identity;        // hash of triangle and place: what random choices about the surfel are made of, the
                          // same whatever else is culled
};
