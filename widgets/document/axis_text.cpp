#include "widgets/document/axis_text.h"

#include <sstream>

#include "projects/coordinate.h"
#include "projects/light_spec.h"
#include "renderers/core/error.h"

namespace ir::widgets {
namespace {

using projects::Json;

std::string trimmed(const std::string& text) {
    const auto first = text.find_first_not_of(" \t");
    return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

Json value_of(const std::string& key, const std::string& text) {
    if (text.empty()) throw UsageError(key + ": a value is missing between two commas");
    if (key == "size") {
        const auto size = projects::parse_size(text, key);
        return Json::array({size.x, size.y});
    }
    const Json json = Json::parse(text, nullptr, false);
    return json.is_number() || json.is_boolean() || json.is_string() ? json : Json(text);
}

std::string text_of(const std::string& key, const Json& value) {
    if (value.is_string()) return value.get<std::string>();
    if (key == "size" && value.is_array() && value.size() == 2)
        return value[0].dump() + "x" + value[1].dump();
    return value.dump();
}

}  // namespace

std::string axis_text(const projects::Sweep::Axis& axis) {
    std::string text;
    for (const auto& value : axis.values) text += (text.empty() ? "" : ", ") + text_of(axis.key, value);
    return text;
}

std::vector<Json> parse_axis(const std::string& key, const std::string& text) {
    std::vector<Json> values;
    std::istringstream stream(text + ",");
    for (std::string part; std::getline(stream, part, ',');) values.push_back(value_of(key, trimmed(part)));
    return values;
}

const std::vector<std::string>& general_axis_keys() {
    return projects::general_keys();
}

std::string axis_label(const projects::Project& project, const Registry& registry,
                       const std::vector<std::string>& experiments, const std::string& key) {
    for (const auto& id : experiments) {
        const auto* experiment = projects::find_item(project.experiments, id);
        const auto* method = experiment ? registry.find(experiment->method) : nullptr;
        if (const auto* parameter = method ? ir::find(method->parameters, key) : nullptr)
            return parameter->label;
    }
    return key;
}

Json present_value(const projects::Experiment& experiment, const std::string& key) {
    if (key == "size") return Json::array({experiment.size.x, experiment.size.y});
    if (key == "seed") return experiment.seed;
    if (key == "frames") return experiment.frames;
    if (key == "time") return experiment.time;
    if (key == "camera") return experiment.camera;
    if (key == "lights") return experiment.lights;
    if (key == "scene") return experiment.scene;
    const auto found = experiment.values.find(key);
    if (found == experiment.values.end()) return nullptr;
    return std::visit([](const auto& value) { return Json(value); }, found->second);
}

}  // namespace ir::widgets
