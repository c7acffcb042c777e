#include "renderers/methods/deep-screen-space/records.h"

namespace ir::methods::deep_screen_space {

using graph::FieldType;

std::vector<graph::Field> surfel_fields() {
    return {{"centre", FieldType::f32, 3},         {"triangle", FieldType::u32},
            {"normal", FieldType::f32, 3},         {"radius"},
            {"radiance_front", FieldType::f32, 3}, {"barycentrics", FieldType::u32},
            {"radiance_back", FieldType::f32, 3},  {"identity", FieldType::u32}};
}

}  // namespace ir::methods::deep_screen_space
