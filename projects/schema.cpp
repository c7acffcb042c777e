#include "projects/schema.h"

#include <cmath>

#include "projects/document_fields.h"
#include "projects/motion.h"
#include "renderers/core/transport.h"

namespace ir::projects {
namespace {

Json type(const char* name) {
    return {{"type", name}};
}
Json reference(const std::string& definition) {
    return {{"$ref", "#/$defs/" + definition}};
}
Json list_of(Json items) {
    return {{"type", "array"}, {"items", std::move(items)}};
}
Json array_of(const char* item, int count, const Json& limits = Json::object()) {
    Json each = type(item);
    each.update(limits);
    return {{"type", "array"}, {"items", each}, {"minItems", count}, {"maxItems", count}};
}

Json limits_of(const Range& range) {
    constexpr Range unlimited;
    Json limits = Json::object();
    if (range.min > unlimited.min) limits[range.is_above_min ? "exclusiveMinimum" : "minimum"] = range.min;
    if (range.max < unlimited.max) limits["maximum"] = range.max;
    return limits;
}

/// The type of a member, by what the table binds.
struct TypeOf {
    const FieldText& text;
    Json number(const char* name) const {
        Json json = type(name);
        json.update(limits_of(text.range));
        return json;
    }
    Json operator()(const bool*) const {
        return text.choices.empty() ? type("boolean") : Json{{"enum", text.choices}};
    }
    Json operator()(const int*) const { return number("integer"); }
    Json operator()(const std::uint64_t*) const { return {{"type", "integer"}, {"minimum", 0}}; }
    Json operator()(const double*) const { return number("number"); }
    Json operator()(const std::string*) const {
        auto json = type("string");
        if (text.writing == FieldText::Writing::required) json["minLength"] = 1;
        return json;
    }
    Json operator()(const glm::ivec2*) const { return array_of("integer", 2, limits_of(text.range)); }
    Json operator()(const glm::dvec2*) const { return array_of("number", 2, limits_of(text.range)); }
    Json operator()(const glm::dvec3*) const { return array_of("number", 3, limits_of(text.range)); }
    Json operator()(const glm::dvec4*) const { return array_of("number", 4, limits_of(text.range)); }
    Json operator()(const std::vector<std::string>*) const { return list_of(type("string")); }
    Json operator()(const std::vector<Json>*) const { return type("array"); }
    template <class Given>
    Json operator()(const std::optional<Given>*) const {
        return (*this)(static_cast<const Given*>(nullptr));
    }
};

Json described(Json json, const FieldText& text) {
    if (!text.label.empty()) json["title"] = text.label;
    if (!text.doc.empty()) json["description"] = text.doc;
    return json;
}

Json object(Json properties, const std::vector<std::string>& required = {}) {
    Json json{{"type", "object"}, {"properties", std::move(properties)}};
    if (!required.empty()) json["required"] = required;
    return json;
}

template <class Item>
void add_fields(Json& object, const Fields<Item>& fields) {
    Item item{};
    for (const auto& field : fields) {
        object["properties"][field.text.key] =
            described(std::visit(TypeOf{field.text}, field.slot(item)), field.text);
        if (field.text.writing == FieldText::Writing::required) object["required"].push_back(field.text.key);
    }
}

Json item() {
    return object({{"id", reference("id")}, {"name", type("string")}}, {"id"});
}

template <class Item>
Json item_with(const Fields<Item>& fields) {
    auto json = item();
    add_fields(json, fields);
    return json;
}

Json json_of(const Value& value) {
    return std::visit([](const auto& plain) { return Json(plain); }, value);
}

Json parameter_schema(const ParameterDescription& parameter) {
    Json json;
    switch (parameter.type) {
        case ParameterType::toggle:
            json = type("boolean");
            break;
        case ParameterType::choice:
            json["enum"] = parameter.supported;
            if (parameter.supported.empty())
                for (const auto& choice : parameter.choices) json["enum"].push_back(choice.key);
            break;
        default:
            json = type(parameter.type == ParameterType::integer ? "integer" : "number");
            if (std::isfinite(parameter.hard.min)) json["minimum"] = parameter.hard.min;
            if (std::isfinite(parameter.hard.max)) json["maximum"] = parameter.hard.max;
    }
    json["title"] = parameter.label;
    json["description"] = parameter.doc + (parameter.unit.empty() ? "" : " Unit: " + parameter.unit + ".");
    json["default"] = json_of(parameter.default_value);
    return json;
}

/// The groups "transport" and "values" of one method's experiments.
Json groups_of(const MethodDescription& method) {
    Json transport = Json::object(), values = Json::object();
    for (const auto& parameter : method.parameters)
        (is_transport_key(parameter.key) ? transport : values)[parameter.key] = parameter_schema(parameter);
    return {{"transport", object(transport)}, {"values", object(values)}};
}

Json preset_schema() {
    auto preset = object({{"transport", type("object")}, {"values", type("object")}});
    add_fields(preset, preset_fields());
    return preset;
}

Json experiment_schema(const Registry& registry) {
    auto json = item();
    auto& properties = json["properties"];
    for (const char* key : {"notes", "scene", "camera", "lights", "reference", "active_preset"})
        properties[key] = type("string");
    properties["method"] = {{"type", "string"}, {"minLength", 1}};
    properties["method_version"] = {{"type", "integer"}, {"minimum", 1}};
    properties["transport"] = type("object");
    properties["values"] = type("object");
    properties["presets"] = {{"type", "object"}, {"additionalProperties", reference("preset")}};
    properties["shaders"] = {{"type", "object"},
                             {"maxProperties", most_changed_shaders},
                             {"additionalProperties", list_of(type("string"))},
                             {"description", "By shader file: the lines of hunks, as diff -u writes them."}};
    add_fields(json, experiment_fields());
    json["required"].push_back("method");
    for (const auto* method : registry.methods())
        json["allOf"].push_back(
            {{"if", {{"properties", {{"method", {{"const", method->id}}}}}, {"required", {"method"}}}},
             {"then", {{"properties", groups_of(*method)}}}});
    return json;
}

Json scene_schema() {
    auto part =
        object({{"transform", array_of("number", 16)},
                {"materials", {{"type", "object"}, {"additionalProperties", reference("material")}}}});
    add_fields(part, part_fields());
    auto json = item();
    json["properties"]["parts"] = list_of(std::move(part));
    json["properties"]["parts"]["minItems"] = 1;
    json["required"].push_back("parts");
    return json;
}

Json light_schema() {
    auto json = object({{"type", {{"enum", Json::array()}}}}, {"type"});
    add_fields(json, light_fields());
    for (const auto kind : LightSpec::types) {
        const auto name = to_string(kind);
        json["properties"]["type"]["enum"].push_back(name);
        Json one_of = Json::array();
        for (const auto quantity : allowed_quantities(kind)) {
            const auto& text = quantity_text(quantity);
            json["properties"][text.key] = described(TypeOf{text}(static_cast<double*>(nullptr)), text);
            one_of.push_back({{"required", {text.key}}});
        }
        json["allOf"].push_back(
            {{"if", {{"properties", {{"type", {{"const", name}}}}}}}, {"then", {{"oneOf", one_of}}}});
    }
    return json;
}

Json light_set_schema() {
    const Json scene{{"const", scene_lights}};
    auto json = item();
    json["properties"]["lights"] = {{"anyOf", {scene, list_of({{"anyOf", {scene, reference("light")}}})}}};
    const auto& text = constant_environment_text();
    const auto constant = described(array_of("number", 3, limits_of(text.range)), text);
    const auto map = object(
        {{"source", {{"type", "string"}, {"minLength", 1}}}, {"content_hash", type("string")}}, {"source"});
    json["properties"]["environment"] = {{"anyOf", {scene, constant, map}}};
    return json;
}

/// What moves, and by kind what its keys have.
Json motion_schema() {
    using Kind = Motion::Kind;
    auto json = item();
    auto& properties = json["properties"];
    properties["moves"] = {{"enum", Json::array()}};
    for (const char* moved : {"camera", "lights", "scene"}) properties[moved] = type("string");
    properties["light"] = {{"type", {"integer", "string"}}};
    properties["part"] = type("integer");
    for (const char* flag : {"loop", "smooth"}) properties[flag] = type("boolean");
    properties["keys"] = type("array");
    json["required"].push_back("moves");
    for (const auto kind : {Kind::camera, Kind::light, Kind::part}) {
        const auto name = to_string(kind);
        json["properties"]["moves"]["enum"].push_back(name);
        auto key = object(Json::object());
        add_fields(key, key_fields(kind));
        json["allOf"].push_back({{"if", {{"properties", {{"moves", {{"const", name}}}}}}},
                                 {"then", {{"properties", {{"keys", list_of(std::move(key))}}}}}});
    }
    return json;
}

Json sweep_schema() {
    auto json = item_with(sweep_fields());
    json["properties"]["axes"] = list_of(
        object({{"key", {{"type", "string"}, {"minLength", 1}}}, {"values", type("array")}}, {"key"}));
    return json;
}

}  // namespace

Json project_schema(const Registry& registry) {
    Json material = object(Json::object());
    add_fields(material, material_fields());
    const auto items = [](const char* definition) { return list_of(reference(definition)); };
    Json properties{{"$schema", type("string")},
                    {"schema", {{"const", schema_version}}},
                    {"name", type("string")},
                    {"notes", type("string")},
                    {"scenes", items("scene")},
                    {"cameras", items("camera")},
                    {"lights", items("light_set")},
                    {"motion", items("motion")},
                    {"images", items("image")},
                    {"experiments", items("experiment")},
                    {"comparisons", items("comparison")},
                    {"sweeps", items("sweep")},
                    {"plots", items("plot")},
                    {"analyses", items("analysis")},
                    {"shaders_allowed", type("boolean")}};
    Json schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                {"title", "Interreflect project"},
                {"description", "project.json, as this build writes it. Other keys are kept as they are."}};
    schema.update(object(std::move(properties), {"schema"}));
    schema["$defs"] = {{"id", {{"type", "string"}, {"pattern", "^[A-Za-z0-9_-][A-Za-z0-9_.-]*$"}}},
                       {"scene", scene_schema()},
                       {"material", material},
                       {"camera", item_with(camera_fields())},
                       {"light", light_schema()},
                       {"light_set", light_set_schema()},
                       {"motion", motion_schema()},
                       {"image", item_with(image_fields())},
                       {"experiment", experiment_schema(registry)},
                       {"preset", preset_schema()},
                       {"comparison", item_with(comparison_fields())},
                       {"sweep", sweep_schema()},
                       {"plot", item_with(plot_fields())},
                       {"analysis", item_with(analysis_fields())}};
    return schema;
}

}  // namespace ir::projects
