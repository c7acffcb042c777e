// A direction for each sample of each pixel, with its density per solid angle. [Nalbach15 §3.1]
#include "lib/constants.glsl"
#include "lib/random.glsl"
#include "lib/spaces.glsl"
#include "passes/bounce/receiver.glsl"
#include "passes/bounce/tiles.glsl"

layout(rgba32f) uniform writeonly image2DArray directions;

uniform uint seed_low, seed_high, frame;
uniform uint first_sample, samples;  // of the batch, of all

/// Of the pixel in its block: those of a quarter, of a quarter of that and so on follow each other.
uint place_in_block(ivec2 pixel) {
    uint place = 0u;
    for (int bit = 0; bit < BLOCK_BITS; ++bit)
        place |= (uint(pixel.x) >> bit & 1u | (uint(pixel.y) >> bit & 1u) << 1) << 2 * bit;
    return place;
}

/// Words that are uniform one by one, for the lobe and the place in it. Stratified, those of all samples and
/// frames of a block of pixels are a (0, 2)-sequence and, for the lobe, multiples of the golden ratio, all shifted
/// by the block's hash: in every aligned square of pixels they are spread as evenly as their number allows.
/// [Kollig02; Cranley76; Ahmed20]
uvec3 random_words(ivec2 pixel, uint number) {
#if STRATIFIED
    ivec2 block = pixel >> BLOCK_BITS;
    uvec3 words = pcg4d(uvec4(uint(block.x) | uint(block.y) << 16u, seed_low, seed_high, 0u)).xyz;
    uint i = (frame + place_in_block(pixel)) * samples + number, second = 0u;
    for (uint rest = i, column = 1u << 31u; rest != 0u; rest >>= 1u, column ^= column >> 1u)
        if ((rest & 1u) != 0u) second ^= column;
    return words + uvec3(i * 2654435769u, bitfieldReverse(i), second);
#else
    uint place = uint(pixel.x) | uint(pixel.y) << 16u;
    return pcg4d(uvec4(place, seed_low, seed_high, frame * samples + number)).xyz;
#endif
}

#if LIGHT

/// As often as the surface scatters from there to the viewer: by BRDF times cosine, lobe by lobe.
vec4 chosen(Receiver receiver, ivec2 pixel, uvec3 words) {
    vec4 material = texelFetch(gbuffer_material, pixel, 0);
    if (is_unlit(material)) return vec4(0.0);
    vec3 v = viewer_of(receiver);
    Scatterer s = chooser_of(receiver, pixel, material);
    Scattered scattered =
        scatter(s, v, unit_float(words.x), unit_float(words.yz), MICROFACETS_VISIBLE_NORMALS);
    vec3 l = scattered.direction_ws;
    if (scattered.weight == vec3(0.0)) return vec4(0.0);  // into the surface
    return vec4(l, scattering_pdf(s, seen_from(s, v), l, dot(s.n, l), MICROFACETS_VISIBLE_NORMALS));
}

#else

/// On the hemisphere of the shading normal; what lies below the triangle's plane is closed.
vec4 chosen(Receiver receiver, ivec2 pixel, uvec3 words) {
    vec2 u = unit_float(words.yz);
    float phi = 2.0 * PI * u.y;
#if COSINE
    float z = sqrt(1.0 - u.x), density = z / PI;
#else
    float z = u.x, density = 0.5 / PI;
#endif
    float radius = sqrt(max(0.0, 1.0 - z * z));
    vec3 l = frame_around(receiver.normal) * vec3(radius * cos(phi), radius * sin(phi), z);
    return vec4(normalize(l), density);
}

#endif

void main() {
    ivec2 pixel = tile_pixel();
    ivec3 size = imageSize(directions);
    if (any(greaterThanEqual(pixel, size.xy))) return;
    Receiver receiver = receiver_at(pixel);
    for (int i = 0; i < size.z; ++i) {
        vec4 result = vec4(0.0);
        if (receiver.exists) result = chosen(receiver, pixel, random_words(pixel, first_sample + uint(i)));
        imageStore(directions, ivec3(pixel, i), result);
    }
}
