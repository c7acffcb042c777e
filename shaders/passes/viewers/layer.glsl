// One layer of a 3D view: its elements where the method left them, and what is to be done with them.

#include "lib/floats.glsl"

/// The range is in the bits of the field's own type.
// C++: ir::passes::viewers::FilterBlock
struct FilterBlock {
    int offset, type;
    uint low, high;
};

layout(std430) readonly buffer Elements { uint element_words[]; };
/// Offsets are in words of four bytes within an element; -1: absent.
// C++: ir::passes::viewers::LayerBlock
layout(std430) readonly buffer LayerBlock {
    uint words;     // of an element
    uint step;      // every n-th element is drawn
    uint drawn;     // so many then
    uint number;    // index of the layer plus 1, as in the picture of ids
    int place[4];   // what it needs, in the order of scene_3d.h
    int normal, colatitude, longitude;
    int colour_offset, colour_type, colour_mode;
    float low, high;         // of the colour map
    float size_px;           // of a point or line
    float red, green, blue;  // linear; of a layer in one colour
    int primitive;
    int filter_count;
    FilterBlock filters[8];
} layer;

// C++: enum ir::passes::viewers::Primitive
const int PRIMITIVE_POINTS = 0, PRIMITIVE_LINES = 1, PRIMITIVE_DISCS = 2, PRIMITIVE_PARALLELOGRAMS = 3,
          PRIMITIVE_ELLIPSOIDS = 4, PRIMITIVE_SPHERE = 5;
// The order of FieldType.
// C++: ir::passes::viewers::*
const int TYPE_U32 = 0, TYPE_I32 = 1, TYPE_F32 = 2;
// What colours an element: LayerBlock::colour_mode.
// C++: enum ir::passes::viewers::ColourMode
const int COLOUR_SINGLE = 0, COLOUR_FIELD = 1, COLOUR_FACING = 2;

uniform vec3 eye_ws, view_axis_ws;
uniform bool orthographic;

// Where element number `index` begins.
uint element_base(uint index) { return index * layer.words; }

float float_at(uint base, int offset) { return uintBitsToFloat(element_words[base + uint(offset)]); }

vec3 vector_at(uint base, int offset) {
    return vec3(float_at(base, offset), float_at(base, offset + 1), float_at(base, offset + 2));
}

float number_at(uint base, int offset, int type) {
    uint bits = element_words[base + uint(offset)];
    return type == TYPE_F32 ? uintBitsToFloat(bits) : type == TYPE_I32 ? float(int(bits)) : float(bits);
}

// Whether the element lies in the ranges of all filters.
bool passes_filters(uint base) {
    for (int i = 0; i < layer.filter_count; ++i) {
        uint bits = element_words[base + uint(layer.filters[i].offset)];
        uint low = layer.filters[i].low, high = layer.filters[i].high;
        bool inside;
        if (layer.filters[i].type == TYPE_F32) {
            float x = uintBitsToFloat(bits);
            inside = (bits & 0x7fffffffu) <= 0x7f800000u && x >= uintBitsToFloat(low) && x <= uintBitsToFloat(high);
        } else if (layer.filters[i].type == TYPE_I32) {
            inside = int(bits) >= int(low) && int(bits) <= int(high);
        } else {
            inside = bits >= low && bits <= high;
        }
        if (!inside) return false;
    }
    return true;
}

vec3 towards_viewer(vec3 position_ws) { return orthographic ? -view_axis_ws : eye_ws - position_ws; }

// 1 where the element's normal looks at the viewer, -1 where away.
float facing(uint base, vec3 position_ws) {
    return sign(dot(vector_at(base, layer.normal), towards_viewer(position_ws)));
}

// The number that colours the element; may be anything, also not a number.
float colour_number(uint base, vec3 position_ws) {
    return layer.colour_mode == COLOUR_FACING ? facing(base, position_ws)
                                              : number_at(base, layer.colour_offset, layer.colour_type);
}
