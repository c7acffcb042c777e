// First hits of exact rays by pixel and map, four to a word: 0 is none, 1 … 255 the distance from 0 to the reach.
layout(std430) readonly buffer ExactHits { uint exact_hits[]; };

uniform uint exact_words;   // of a pixel
uniform float exact_texels;  // reach; negative: all hits

/// Distance in metres up to which hits come from exact rays.
float exact_reach(MapFrame frame) {
    const float unlimited = 1.0 / 0.0;
    float reach = exact_texels < 0.0
                      ? unlimited
                      : exact_texels * max(length(frame.step_u.xyz), length(frame.step_v.xyz));
    return params.max_distance > 0.0 ? min(reach, params.max_distance) : reach;
}

// C++: ir::methods::ldm_ao::exact_steps
const float EXACT_STEPS = 254.0;

/// In metres; negative: no hit. Without a reach the distance of a hit does not matter.
float exact_distance(uint pixel, uint map, float reach) {
    uint hit = exact_hits[pixel * exact_words + map / 4u] >> (8u * (map % 4u)) & 255u;
    if (hit == 0u) return -1.0;
    return isinf(reach) ? 0.0 : reach * float(hit - 1u) / EXACT_STEPS;
}
