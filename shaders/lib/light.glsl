// One element of the buffer "scene.lights" (renderers/passes/scene/scene_buffers.cpp writes it), and what a light
// without extent sends to a point. Declare the buffer where it is used:
//
//   layout(std430) readonly buffer Lights { Light lights[]; };

// The order of scene::LightType.
// C++: ir::passes::*
const int LIGHT_POINT = 0, LIGHT_SPOT = 1, LIGHT_DIRECTIONAL = 2, LIGHT_RECTANGLE = 3, LIGHT_DISK = 4;

// C++: ir::passes::LightData
struct Light {
    vec3 position_ws;
    int type;
    vec3 direction_ws;  // of travel
    float range;        // m; 0: unlimited
    vec3 intensity;     // point, spot W/sr; directional W/m²; rectangle, disk W/(m² sr)
    float cos_inner;    // of the spot's half-angles
    vec2 size;          // m
    float cos_outer;
    int shadow_layer;   // the first of "shadow.maps", or -1
    int shadow_layers;  // 0, 1, or 6: the faces of a cube
    int unused[3];
};

bool is_punctual(Light light) {
    return light.type <= LIGHT_DIRECTIONAL;
}

/// Fraction of a spot's intensity in a direction whose angle to the axis has this cosine: squared linear
/// between the cones, a hard edge where they coincide.  [glTF2 KHR_lights_punctual, inner and outer cone angles]
float spot_profile(float cosine, float cos_inner, float cos_outer) {
    float width = cos_inner - cos_outer;
    if (width < 1e-6) return cosine >= cos_outer ? 1.0 : 0.0;
    float fraction = clamp((cosine - cos_outer) / width, 0.0, 1.0);
    return fraction * fraction;
}

/// The same of a light; 1 where it is no spot.
float spot_fraction(Light light, float cosine) {
    return light.type == LIGHT_SPOT ? spot_profile(cosine, light.cos_inner, light.cos_outer) : 1.0;
}

/// The recommended window that takes a light to 0 at its range.  [glTF2 KHR_lights_punctual, range property]
float range_window(float range, float distance) {
    if (range <= 0.0) return 1.0;
    float ratio = distance / range;
    return clamp(1.0 - ratio * ratio * ratio * ratio, 0.0, 1.0);
}

/// What arrives of a point, spot or directional light, nothing in between.
struct PunctualArrival {
    vec3 direction_ws;  // to the light, unit length
    vec3 irradiance;    // W/m² on a surface that faces the light
};
PunctualArrival punctual_arrival(Light light, vec3 position_ws) {
    if (light.type == LIGHT_DIRECTIONAL) return PunctualArrival(-light.direction_ws, light.intensity);
    vec3 offset = light.position_ws - position_ws;
    float squared = dot(offset, offset);
    float distance = sqrt(squared);
    if (distance == 0.0) return PunctualArrival(vec3(0, 1, 0), vec3(0));
    vec3 direction_ws = offset / distance;
    float profile = spot_fraction(light, -dot(direction_ws, light.direction_ws));
    float part = profile * range_window(light.range, distance) / squared;
    return PunctualArrival(direction_ws, part * light.intensity);
}
