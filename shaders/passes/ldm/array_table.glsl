// Where the depths of rows and texels lie in arrays; other storages only sort as arrays do.
#include "passes/ldm/array_builder.glsl"

layout(std430) buffer LdmRows { uint rows[]; };
layout(std430) buffer LdmOffsets { uint offsets[]; };

uniform uint packed_words, wide_words;  // size of the batch's offsets in 16 and in 32 bits
uniform uint depth_words;               // that there is room for
