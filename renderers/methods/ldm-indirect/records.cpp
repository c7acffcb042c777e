#include "renderers/methods/ldm-indirect/records.h"

namespace ir::methods::ldm_indirect {

using graph::FieldType;

std::vector<graph::Field> photon_fields() {
    return {{"centre", FieldType::f32, 3}, {"source", FieldType::u32},    {"axis_u", FieldType::f32, 3},
            {"leg", FieldType::u32},       {"axis_v", FieldType::f32, 3}, {"path_length"},
            {"flux", FieldType::f32, 3},   {"normal", FieldType::u32}};
}

}  // namespace ir::methods::ldm_indirect
