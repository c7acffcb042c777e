#include "projects/light_help.h"

#include <algorithm>

#include "projects/document_fields.h"
#include "projects/light_spec.h"

namespace ir::projects {
namespace {

/// Of each type, with what it must have and nothing else.
constexpr const char* examples[] = {
    "point:position=0,2,0;flux=40", "spot:position=0,3,0;target=0,0,0;outer=30;intensity=10",
    "directional:direction=0,-1,0;irradiance=3", "rect:position=0,2,0;target=0,0,0;size=1,0.5;radiance=10",
    "disk:position=0,2,0;target=0,0,0;size=0.5,0.5;radiance=10"};

std::string line_of(std::string name, const std::string& doc) {
    name.resize(std::max<std::size_t>(name.size(), 16), ' ');
    return "\n  " + name + doc;
}

std::string fields_of(const std::string& example) {
    const auto light = parse_light(example);
    std::string text;
    for (const auto& field : light_fields()) {
        const auto& key = field.text.key;
        if (!field.is_stored_in(light)) continue;
        const bool is_needed = example.find(key + "=") != std::string::npos;
        const bool replaces_target = key == "direction" && looks(light.type);
        text += line_of(is_needed ? key : replaces_target ? "or " + key : "[" + key + "]", field.text.doc);
    }
    std::string before;
    for (const auto quantity : allowed_quantities(light.type)) {
        const auto& strength = quantity_text(quantity);
        text += line_of(before + strength.key, strength.unit + ". " + strength.doc);
        before = "or ";
    }
    return text;
}

}  // namespace

std::string light_help() {
    std::string text = "A light is TYPE:FIELD=VALUE;FIELD=VALUE… Fields in brackets may be left out.";
    for (const char* example : examples) text += std::string("\n\n") + example + fields_of(example);
    return text;
}

}  // namespace ir::projects
