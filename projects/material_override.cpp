#include "projects/material_override.h"

#include "projects/document_fields.h"

namespace ir::projects {

void validate(const MaterialOverride& change, const std::string& where) {
    validate_fields(change, material_fields(), where);
}

MaterialOverride read_material_override(ObjectReader& reader) {
    MaterialOverride change;
    read_fields(reader, change, material_fields());
    change.extra = reader.rest();
    return change;
}

Json to_json(const MaterialOverride& change) {
    Json json = Json::object();
    write_fields(json, change, material_fields());
    return json;
}

}  // namespace ir::projects
