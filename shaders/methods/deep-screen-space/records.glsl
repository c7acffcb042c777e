/// A disc that stands for a piece of the scene's surface. 48 bytes. Seen as a glyph it is its disc.
// C++: ir::methods::deep_screen_space::Surfel
struct Surfel {
    vec3 centre_ws;
    uint triangle;      // of World::indices
    vec3 normal_ws;     // unit, of the triangle's plane, by its winding
    float radius;       // m: π radius² is the area that the surfel stands for
    uint barycentrics;  // unpackUnorm2x16: weights of the second and third corner
    uint identity;      // hash of triangle and place: what random choices about the surfel are made of, the same
                        // whatever else is culled
    uint order;   // its number among all: those near each other in it lie near each other, as far as placement cares
    uint unused;
};

/// What a surfel sends, W/(m² sr): the diffuse part of direct light; or its irradiance, W/m². 24 bytes.
// C++: ir::methods::deep_screen_space::SurfelLight
struct SurfelLight {
    float front[3];  // on the normal's side
    float back[3];   // on the other side
};

vec3 light_of_side(SurfelLight light, bool is_front) {
    return is_front ? vec3(light.front[0], light.front[1], light.front[2])
                    : vec3(light.back[0], light.back[1], light.back[2]);
}

bool is_dark(SurfelLight light) { return light_of_side(light, true) == vec3(0) && light_of_side(light, false) == vec3(0); }
