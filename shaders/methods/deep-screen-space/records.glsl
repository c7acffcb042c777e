// A disc that stands for a piece of the scene's surface: equals ir::methods::deep_screen_space::Surfel. 64 bytes
// in std430.
struct Surfel {
    vec3 centre_ws;
    uint triangle;
    vec3 normal_ws;       // of the triangle's plane, by its winding
    float radius;         // m
    vec3 radiance_front;  // W/(m² sr), on the normal's side
    uint barycentrics;    // unpackUnorm2x16: weights of the second and third corner
    vec3 radiance_back;
    uint identity;        // what random choices about the surfel are made of
};
