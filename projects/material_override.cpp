#include "projects/material_override.h"

#include "renderers/core/error.h"
#include "renderers/core/value.h"

namespace ir::projects {
namespace {

/// Calls `visit(name, member, least, most)` for every member: the one list of names and ranges.
template <class Override, class Visit>
void each_member(Override& change, Visit visit) {
    visit("base_colour", change.base_colour, 0.0, 1.0);
    visit("metallic", change.metallic, 0.0, 1.0);
    visit("roughness", change.roughness, 0.0, 1.0);
    visit("emission", change.emission, 0.0, 1e9);
    visit("normal_scale", change.normal_scale, -100.0, 100.0);
    visit("ior", change.ior, 1.0, 10.0);
    visit("transmission", change.transmission, 0.0, 1.0);
}

bool is_within(double number, double least, double most) {
    return number >= least && number <= most;
}
template <class Vector>
bool is_within(const Vector& vector, double least, double most) {
    for (int i = 0; i < Vector::length(); ++i)
        if (!is_within(vector[i], least, most)) return false;
    return true;
}

void read(ObjectReader& reader, const char* name, std::optional<double>& member) {
    if (reader.has(name)) member = reader.number(name, 0);
}
void read(ObjectReader& reader, const char* name, std::optional<glm::dvec3>& member) {
    member = reader.optional_vec3(name);
}
void read(ObjectReader& reader, const char* name, std::optional<glm::dvec4>& member) {
    member = reader.optional_vec4(name);
}

Json json_of(double number) {
    return number;
}
template <class Vector>
Json json_of(const Vector& vector) {
    Json array = Json::array();
    for (int i = 0; i < Vector::length(); ++i) array.push_back(vector[i]);
    return array;
}

/// Empty where all is well.
std::string problem(const MaterialOverride& change, std::string& member_name) {
    std::string text;
    each_member(change, [&](const char* name, const auto& member, double least, double most) {
        if (!text.empty() || !member || is_within(*member, least, most)) return;
        member_name = name;
        text = "must lie between " + ir::to_string(Value{least}) + " and " + ir::to_string(Value{most});
    });
    return text;
}

}  // namespace

void validate(const MaterialOverride& change, const std::string& where) {
    std::string name;
    if (const auto text = problem(change, name); !text.empty()) throw UsageError(where + name + " " + text);
}

MaterialOverride read_material_override(ObjectReader& reader) {
    MaterialOverride change;
    each_member(change, [&](const char* name, auto& member, double, double) { read(reader, name, member); });
    std::string name;
    if (const auto text = problem(change, name); !text.empty()) reader.fail(name, text);
    change.extra = reader.rest();
    return change;
}

Json to_json(const MaterialOverride& change) {
    Json json = Json::object();
    each_member(change, [&](const char* name, const auto& member, double, double) {
        if (member) json[name] = json_of(*member);
    });
    return json;
}

}  // namespace ir::projects
