#include "renderers/core/describe.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "renderers/core/error.h"
#include "renderers/core/light_use.h"
#include "renderers/core/transport.h"
#include "renderers/core/words.h"

namespace ir {
namespace {

using Json = nlohmann::ordered_json;

const char* type_name(ParameterType type) {
    static constexpr const char* names[] = {"toggle", "integer", "number", "choice"};
    return names[static_cast<int>(type)];
}

const char* on_change_name(OnChange change) {
    static constexpr const char* names[] = {"nothing", "reset-history", "reallocate", "recompile"};
    return names[static_cast<int>(change)];
}

Json json_of(const Value& value) {
    return std::visit([](const auto& v) { return Json(v); }, value);
}

Json json_of(const Range& range) {
    Json json = Json::object();
    if (std::isfinite(range.min)) json["min"] = range.min;
    if (std::isfinite(range.max)) json["max"] = range.max;
    return json;
}

Json json_of(const Condition& condition) {
    Json values = Json::array();
    for (const auto& value : condition.values) values.push_back(json_of(value));
    return {{"key", condition.key}, {"values", values}};
}

Json json_of(const OutputDescription& output) {
    const auto& map = output.colour_map;
    Json json{{"key", output.key},
              {"label", output.label},
              {"kind", to_string(output.kind)},
              {"semantic", to_string(output.semantic)},
              {"unit", output.unit},
              {"colour_map", map.empty() ? default_colour_map(output.semantic) : map},
              {"doc", full_doc(output)},
              {"explains", output.explains}};
    for (const auto& categories : output.categories)
        for (const auto& [value, label, colour] : categories.values)
            json["categories"][categories.field].push_back(
                {{"value", value}, {"label", label}, {"colour", colour}});
    if (!output.active_when.key.empty()) json["active_when"] = json_of(output.active_when);
    return json;
}

Json json_of(const ParameterDescription& p) {
    Json json{{"key", p.key},
              {"label", p.label},
              {"type", type_name(p.type)},
              {"default", json_of(p.default_value)}};
    if (p.type == ParameterType::integer || p.type == ParameterType::number) {
        json["hard_range"] = json_of(p.hard);
        json["soft_range"] = json_of(p.soft);
    }
    if (!p.unit.empty()) json["unit"] = p.unit;
    for (const auto& choice : p.choices) {
        const bool supported = p.supported.empty() || std::find(p.supported.begin(), p.supported.end(),
                                                                choice.key) != p.supported.end();
        if (!supported) continue;
        json["choices"].push_back({{"key", choice.key}, {"label", choice.label}, {"doc", choice.doc}});
        if (choice.effect == Effect::cost) json["choices"].back()["effect"] = "cost";
    }
    if (!p.exact.empty()) json["exact"] = p.exact;
    json["doc"] = p.doc;
    if (!p.citation.empty()) json["citation"] = p.citation;
    json["group"] = is_transport_key(p.key) ? "transport" : "method";
    json["effect"] = p.effect == Effect::image ? "image" : "cost";
    json["on_change"] = on_change_name(p.on_change);
    if (p.accumulates) json["accumulates"] = true;
    if (p.coarse) json["coarse"] = json_of(*p.coarse);
    if (!p.active_when.key.empty()) json["active_when"] = json_of(p.active_when);
    json["since_version"] = p.since_version;
    if (p.value_in_older_projects) json["value_in_older_projects"] = json_of(*p.value_in_older_projects);
    return json;
}

std::string number(double value) {
    return to_string(Value{value});
}

std::string range_text(const Range& range) {
    const bool low = std::isfinite(range.min), high = std::isfinite(range.max);
    if (low && high) return number(range.min) + " … " + number(range.max);
    if (low) return "≥ " + number(range.min);
    if (high) return "≤ " + number(range.max);
    return "any";
}

std::string allowed_text(const ParameterDescription& p) {
    if (p.type == ParameterType::toggle) return "true, false";
    if (p.type != ParameterType::choice) return range_text(p.hard) + (p.unit.empty() ? "" : " " + p.unit);
    std::string text;
    for (const auto& choice : p.choices)
        if (p.supported.empty() ||
            std::find(p.supported.begin(), p.supported.end(), choice.key) != p.supported.end())
            text += (text.empty() ? "`" : ", `") + choice.key + "`";
    return text;
}

constexpr const char* explains_text = " Explains the pixel or items that are picked.";

/// " Only where `key` is a, b and `other` is c."; empty without a condition.
std::string condition_sentence(const std::vector<Condition>& conditions) {
    std::string text;
    for (const auto& condition : conditions)
        if (const auto one = condition_text(condition); !one.empty())
            text += (text.empty() ? " Only where " : " and ") + one;
    return text.empty() ? text : text + ".";
}

template <class Item>
std::string texts_of(const std::vector<Item>& items) {
    std::string text;
    for (std::size_t i = 0; i < items.size(); ++i)
        text += (i == 0 ? "" : i + 1 < items.size() ? ", " : " and ") + text_of(items[i]);
    return text;
}

/// A list of what the picture lacks; empty: nothing.
std::string missing_light_text(const MethodDescription& method) {
    std::string text;
    for (const auto& missing : method.missing_light)
        text += "- " + texts_of(missing.kinds) + ": " + texts_of(missing.parts) + "." +
                condition_sentence(missing.active_when) + "\n";
    if (text.empty()) return text;
    const auto* paths = find(method.parameters, "paths");
    const bool only_lit = paths && paths->supported == std::vector<std::string>{"ao"};
    return (only_lit ? "Missing light of the output “" + std::string(lit_output_key) + "”:"
                     : "Missing light, which *Match* leaves out of the reference, too:") +
           "\n\n" + text + "\n";
}

std::string coarse_text(const ParameterDescription& p) {
    const bool is_number = p.type == ParameterType::integer || p.type == ParameterType::number;
    return (is_number ? "at most " : "") + to_string(*p.coarse);
}

std::string count_text(const SelectorDescription& selector) {
    return selector.parameter.empty() ? std::to_string(selector.count) : selector.parameter;
}

Json json_of(const SelectorDescription& selector) {
    return {{"key", selector.key},
            {"label", selector.label},
            {"doc", selector.doc},
            {"count", count_text(selector)}};
}

/// What follows the doc of a parameter and of its choices.
std::string further_text(const ParameterDescription& p) {
    std::string text;
    if (!p.exact.empty()) text += " Exact stand-ins: " + listed(p.exact) + ".";
    text += condition_sentence({p.active_when});
    if (p.coarse) text += " In coarse pictures " + coarse_text(p) + ".";
    return p.citation.empty() ? text : text + " [" + p.citation + "]";
}

const char* changes_text(const ParameterDescription& p) {
    return p.effect == Effect::image ? "image" : "cost";
}

std::string what_it_shows(const OutputDescription& output) {
    return "**" + output.label + ".** " + full_doc(output) + condition_sentence({output.active_when}) +
           (output.explains ? explains_text : "");
}

std::string items_text(const SelectorDescription& selector) {
    return "0 … `" + count_text(selector) + "` − 1, or all";
}

std::string markdown_of(const ParameterDescription& p) {
    std::string text = "**" + p.label + ".** " + p.doc + further_text(p) +
                       "\n\n- default: " + to_string(p.default_value) + "\n- allowed: " + allowed_text(p) +
                       "\n- changes: " + changes_text(p) + "\n";
    for (const auto& choice : p.choices)
        if (!choice.doc.empty()) text += "- `" + choice.key + "`: " + choice.doc + "\n";
    return text;
}

std::string markdown_of(const OutputDescription& output) {
    return what_it_shows(output) + "\n\n- kind: " + to_string(output.kind) +
           "\n- semantic: " + to_string(output.semantic) +
           (output.unit.empty() ? "" : "\n- unit: " + output.unit) + "\n";
}

std::string markdown_of(const SelectorDescription& selector) {
    return "**" + selector.label + ".** " + selector.doc + "\n\n- items: " + items_text(selector) + "\n";
}

/// What `text_of` gives for the one item of the method with this key.
template <class TextOf>
std::string text_of_one(const MethodDescription& method, const std::string& key, TextOf text_of) {
    const auto in = [&](const auto& items) -> std::string {
        for (const auto& item : items)
            if (item.key == key) return text_of(item);
        return {};
    };
    for (const auto& text : {in(method.parameters), in(method.outputs), in(method.selectors)})
        if (!text.empty()) return text;
    auto known = words_of(method.parameters, &ParameterDescription::key);
    for (const auto& output : method.outputs) known.push_back(output.key);
    for (const auto& selector : method.selectors) known.push_back(selector.key);
    throw UsageError("method '" + method.id + "' has no parameter, output or selector '" + key + "'" +
                     known_are(key, known));
}

}  // namespace

std::string condition_text(const Condition& condition) {
    if (condition.key.empty()) return {};
    std::string text = "`" + condition.key + "` is";
    for (const auto& value : condition.values)
        text += (&value == &condition.values.front() ? " " : ", ") + to_string(value);
    return text;
}

std::string describe_json(const MethodDescription& method) {
    Json json{{"id", method.id},           {"title", method.title},   {"version", method.version},
              {"summary", method.summary}, {"papers", method.papers}, {"background", method.background}};
    json["parameters"] = Json::array();
    for (const auto& parameter : method.parameters) json["parameters"].push_back(json_of(parameter));
    json["outputs"] = Json::array();
    for (const auto& output : method.outputs) json["outputs"].push_back(json_of(output));
    for (const auto& missing : method.missing_light) {
        Json row;
        for (const auto part : missing.parts) row["parts"].push_back(to_string(part));
        for (const auto kind : missing.kinds) row["kinds"].push_back(to_string(kind));
        for (const auto& condition : missing.active_when) row["active_when"].push_back(json_of(condition));
        json["missing_light"].push_back(std::move(row));
    }
    if (method.is_reference) json["is_reference"] = true;
    if (!method.variance.empty()) json["variance"] = method.variance;
    json["selectors"] = Json::array();
    for (const auto& selector : method.selectors) json["selectors"].push_back(json_of(selector));
    return json.dump(2);
}

std::string describe_markdown(const MethodDescription& method) {
    std::string text = "# " + method.title + "\n\n`" + method.id + "`, version " +
                       std::to_string(method.version) + "\n\n" + method.summary + "\n\n";
    if (!method.papers.empty()) {
        text += "Papers: ";
        for (std::size_t i = 0; i < method.papers.size(); ++i) text += (i ? ", " : "") + method.papers[i];
        text += ".\n\n";
    }
    text += missing_light_text(method);
    text += "## Parameters\n\n| key | default | allowed | changes | what it does |\n|---|---|---|---|---|\n";
    for (const auto& p : method.parameters) {
        text += "| `" + p.key + "` | " + to_string(p.default_value) + " | " + allowed_text(p) + " | " +
                changes_text(p) + " | **" + p.label + ".** " + p.doc;
        for (const auto& choice : p.choices)
            if (!choice.doc.empty() && (p.supported.empty() || p.supported.size() > 1))
                text += " `" + choice.key + "`: " + choice.doc;
        text += further_text(p) + " |\n";
    }
    text += "\n## Outputs\n\n| key | kind | semantic | unit | what it shows |\n|---|---|---|---|---|\n";
    for (const auto& o : method.outputs)
        text += "| `" + o.key + "` | " + to_string(o.kind) + " | " + to_string(o.semantic) + " | " + o.unit +
                " | " + what_it_shows(o) + " |\n";
    if (method.selectors.empty()) return text;
    text +=
        "\n## Selectors\n\nWhat can be looked at one by one.\n\n| key | items | what is chosen "
        "|\n|---|---|---|\n";
    for (const auto& selector : method.selectors)
        text += "| `" + selector.key + "` | " + items_text(selector) + " | **" + selector.label + ".** " +
                selector.doc + " |\n";
    return text;
}

std::string describe_json(const MethodDescription& method, const std::string& key) {
    return text_of_one(method, key, [](const auto& item) { return json_of(item).dump(2); });
}

std::string describe_markdown(const MethodDescription& method, const std::string& key) {
    return text_of_one(method, key,
                       [](const auto& item) { return "# `" + item.key + "`\n\n" + markdown_of(item); });
}

}  // namespace ir
