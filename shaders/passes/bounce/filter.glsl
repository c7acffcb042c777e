// What a sample of a neighbour adds to a pixel: its weight, and what the pixel's own surface makes of it.
// [Nalbach15 §3.3]
#include "lib/floats.glsl"
#include "lib/constants.glsl"
#include "passes/blur/weights.glsl"
#include "passes/bounce/receiver.glsl"

uniform sampler2DArray directions;
uniform sampler2DArray incoming;

uniform int samples;

#if KERNELS
uniform sampler2D kernels;  // radius of each pixel's, pixels
#endif

/// By how much the kernel is narrower than the blur's radius says.
float narrowing_at(ivec2 pixel) {
#if KERNELS
    return float(radius) / texelFetch(kernels, pixel, 0).x;
#else
    return 1.0;
#endif
}

#if LIGHT
#define Value vec3
uniform float material_tolerance;
/// Of the pixel's own samples in what each neighbour gives; 0: none, as published.
uniform float balance;

/// How a pixel chooses its directions.
struct Chooser {
    Scatterer scatterer;
    SeenScatterer seen;
};

Chooser chooser_at(Receiver receiver, ivec2 pixel) {
    Scatterer s = chooser_of(receiver, pixel, texelFetch(gbuffer_material, pixel, 0));
    return Chooser(s, seen_from(s, viewer_of(receiver)));
}

/// α, 1/sr
float density_of(Chooser chooser, vec3 direction_ws) {
    float cosine = dot(chooser.scatterer.n, direction_ws);
    if (cosine <= 0.0) return 0.0;
    return scattering_pdf(chooser.scatterer, chooser.seen, direction_ws, cosine, MICROFACETS_VISIBLE_NORMALS);
}
#else
#define Value float
#endif

/// The pixel that is reconstructed.
struct Target {
    ivec2 pixel;
    Receiver receiver;
    BlurSurface surface;
    float narrowing;
#if LIGHT
    vec2 material;  // metallic, roughness
    Scatterer scatterer;
    SeenScatterer seen;
    Chooser chooser;
#endif
};

/// Of one sample: nominator and denominator of the estimate, without the neighbour's weight.
struct Part {
    Value value;
    float share;
};

/// As the blur sees it.
BlurSurface surface_at(ivec2 pixel) {
    return BlurSurface(texelFetch(gbuffer_position, pixel, 0).xyz, texelFetch(gbuffer_normal, pixel, 0).xyz,
                       texelFetch(gbuffer_geometric_normal, pixel, 0).xyz);
}

#if LIGHT

vec2 filtered_material(vec4 material) { return vec2(material.x, max(material.y, min_roughness)); }

/// False where nothing is to be reconstructed.
bool target_at(ivec2 pixel, out Target target) {
    target.pixel = pixel;
    target.receiver = receiver_at(pixel);
    target.surface = surface_at(pixel);
    target.narrowing = narrowing_at(pixel);
    if (!target.receiver.exists) return false;
    vec4 material = texelFetch(gbuffer_material, pixel, 0);
    target.material = filtered_material(material);
    target.scatterer = scatterer_of(target.receiver, texelFetch(gbuffer_albedo, pixel, 0).rgb, material);
    target.seen = seen_from(target.scatterer, viewer_of(target.receiver));
    if (balance > 0.0) target.chooser = chooser_at(target.receiver, pixel);
    return !is_unlit(material);
}

/// 0: the pixel has no samples.
float material_weight(Target target, ivec2 pixel) {
    vec4 material = texelFetch(gbuffer_material, pixel, 0);
    if (is_unlit(material)) return 0.0;
#if MATERIALS == 2  // SCATTERING_LAMBERT
    return 1.0;
#else
    vec2 difference = (filtered_material(material) - target.material) / material_tolerance;
    return exp(-dot(difference, difference));
#endif
}

/// f_r L ⟨n, ω⟩ / `density`. Directions that left their surface on no side have no light, but they are samples.
Part part_of(Target target, vec4 direction, vec3 radiance, float density) {
    Part part = Part(vec3(0.0), 1.0);
    if (direction.w > 0.0 && is_above(target.scatterer, direction.xyz))
        part.value = scattering_value(target.scatterer, target.seen, direction.xyz,
                                      dot(target.receiver.normal, direction.xyz)) *
                     radiance / density;
    return part;
}

/// What a neighbour's sample is divided by: its own density, or where the pixel's samples stand beside it the mean of
/// both by the balance heuristic, so that no weight exceeds 1 / `balance` times what it is among the pixel's own.
/// DEVIATION [Nalbach15 §3.3]: divided by α_q alone, f_p / α_q has no bound where the lobes of p and q differ.
float density_for(Target target, ivec2 pixel, vec4 direction) {
    if (balance == 0.0 || pixel == target.pixel) return direction.w;
    float own = direction.w > 0.0 ? density_of(target.chooser, direction.xyz) : 0.0;
    return mix(direction.w, own, balance) / (1.0 - balance);
}

Value incoming_at(ivec3 place, vec4 direction) {
    return direction.w > 0.0 ? texelFetch(incoming, place, 0).rgb : vec3(0.0);
}

#else

bool target_at(ivec2 pixel, out Target target) {
    target.pixel = pixel;
    target.receiver = receiver_at(pixel);
    target.surface = surface_at(pixel);
    target.narrowing = narrowing_at(pixel);
    return target.receiver.exists;
}

/// Which directions are asked for does not depend on the material, so neither does what they are worth.
float material_weight(Target target, ivec2 pixel) { return 1.0; }

/// V ⟨n, ω⟩ / (π α), and for the ratio the same with V = 1. Below the pixel's triangle all is closed.
Part part_of(Target target, vec4 direction, float visibility, float density) {
    if (direction.w == 0.0) return Part(0.0, 0.0);
    float open = max(dot(target.receiver.normal, direction.xyz), 0.0) / (PI * direction.w);
    if (dot(target.receiver.geometric_normal, direction.xyz) <= 0.0) visibility = 0.0;
#if RATIO
    return Part(visibility * open, open);
#else
    return Part(visibility * open, 1.0);
#endif
}

Value incoming_at(ivec3 place, vec4 direction) { return texelFetch(incoming, place, 0).x; }

float density_for(Target target, ivec2 pixel, vec4 direction) { return direction.w; }

#endif

/// w(p, q), 1 for the pixel itself.
float neighbour_weight(Target target, ivec2 pixel) {
    if (pixel == target.pixel) return 1.0;
    BlurSurface there = surface_at(pixel);
    if (there.geometric_normal == vec3(0.0)) return 0.0;
    vec2 offset = target.narrowing * vec2(pixel - target.pixel);
    return blur_weight(target.surface, there, offset) * material_weight(target, pixel);
}

/// Of the sample at a place of the stacks; not finite values count for nothing.
Part part_at(Target target, ivec3 place) {
    vec4 direction = texelFetch(directions, place, 0);
    Part part = part_of(target, direction, incoming_at(place, direction), density_for(target, place.xy, direction));
    if (!is_finite(part.value)) return Part(Value(0.0), 0.0);
    return part;
}

/// How the pixel's own samples stand beside those of a neighbour.
struct Beside {
#if LIGHT
    Chooser chooser;
#endif
    bool is_there;  // else they do not
};

Beside beside(Target target, ivec2 pixel) {
    Beside b;
    b.is_there = false;
#if LIGHT
    if (balance == 0.0 || pixel == target.pixel) return b;
    b.is_there = true;
    b.chooser = chooser_at(receiver_at(pixel), pixel);
#endif
    return b;
}

/// What the pixel's own sample adds there.
Value value_beside(Target target, Beside b, int number) {
#if LIGHT
    if (!b.is_there) return Value(0.0);
    ivec3 place = ivec3(target.pixel, number);
    vec4 direction = texelFetch(directions, place, 0);
    if (direction.w == 0.0) return Value(0.0);
    float density = mix(density_of(b.chooser, direction.xyz), direction.w, balance) / balance;
    Value value = part_of(target, direction, incoming_at(place, direction), density).value;
    return is_finite(value) ? value : Value(0.0);
#else
    return Value(0.0);
#endif
}

/// Among (2 radius + 1)² neighbours, rows first.
ivec2 neighbour(Target target, int index) {
    int across = 2 * radius + 1;
    return target.pixel + ivec2(index % across, index / across) - radius;
}

bool is_inside(ivec2 pixel) {
    return all(greaterThanEqual(pixel, ivec2(0))) && all(lessThan(pixel, textureSize(gbuffer_position, 0)));
}
