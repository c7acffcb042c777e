#include "renderers/core/light_use.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <optional>

#include "renderers/core/transport.h"

namespace ir {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array all_kinds{LightKind::punctual, LightKind::lamp, LightKind::surface,
                               LightKind::environment};
constexpr std::array<const char*, light_kinds> kind_names{"punctual", "lamp", "surface", "environment"};
constexpr std::array all_parts{LightPart::seen, LightPart::direct, LightPart::indirect};
constexpr std::array<const char*, light_parts> part_names{"seen", "direct", "indirect"};

std::string choice(const Settings& settings, const std::string& key) {
    const auto found = settings.find(key);
    const auto* text = found == settings.end() ? nullptr : std::get_if<std::string>(&found->second);
    return text ? *text : std::string();
}

/// What the keys `emitters` and `environment_light` leave of a kind's light, as their texts say.
bool is_wanted(LightPart part, LightKind kind, const Settings& settings) {
    if (kind == LightKind::punctual) return part != LightPart::seen;
    const auto emitters = choice(settings, "emitters");
    if (part == LightPart::indirect && emitters == "direct") return false;
    if (kind == LightKind::environment) {
        const auto found = settings.find("environment_light");
        return part != LightPart::seen && (found == settings.end() || found->second != Value{false});
    }
    if (kind == LightKind::surface && part == LightPart::seen) return true;
    return emitters != "none";
}

template <class Item, class Container>
bool contains(const Container& container, const Item& item) {
    return std::find(container.begin(), container.end(), item) != container.end();
}

/// Light of `a` in these parts that `b` lacks.
std::vector<LightPart> surplus(const UsedLight& a, const UsedLight& b, const std::vector<LightPart>& parts) {
    std::vector<LightPart> result;
    for (const auto part : parts)
        if (contains(a.parts, part) && !contains(b.parts, part)) result.push_back(part);
    return result;
}

/// "is seen and gives direct and indirect light".
std::string what_it_does(const std::vector<LightPart>& parts) {
    std::string gives;
    for (const auto part : parts)
        if (part != LightPart::seen) gives += (gives.empty() ? "" : " and ") + to_string(part);
    if (!gives.empty()) gives = "gives " + gives + " light";
    if (!contains(parts, LightPart::seen)) return gives;
    return gives.empty() ? "is seen" : "is seen and " + gives;
}

using ReadJson = nlohmann::json;  // objects of any number of keys are read quickly

template <class Enum, std::size_t count>
std::optional<Enum> named(const ReadJson& json, const std::array<const char*, count>& names) {
    for (std::size_t i = 0; i < count; ++i)
        if (json == names[i]) return static_cast<Enum>(i);
    return std::nullopt;
}

LightUse use_of(const MethodDescription& method, const Settings& settings,
                const std::vector<LightPart>& parts) {
    LightUse use;
    for (const auto part : parts)
        for (const auto kind : all_kinds) use.set(part, kind, is_wanted(part, kind, settings));
    for (const auto& missing : method.missing_light) {
        if (!std::ranges::all_of(missing.active_when,
                                 [&](const Condition& each) { return holds(each, settings); }))
            continue;
        for (const auto part : missing.parts)
            for (const auto kind : missing.kinds) use.set(part, kind, false);
    }
    return use;
}

}  // namespace

std::string to_string(LightKind kind) {
    return kind_names[static_cast<std::size_t>(kind)];
}

std::string to_string(LightPart part) {
    return part_names[static_cast<std::size_t>(part)];
}

std::string text_of(LightKind kind) {
    constexpr std::array texts{"point, spot and directional lights", "rectangle and disk lights",
                               "emissive surfaces", "the environment"};
    return texts[static_cast<std::size_t>(kind)];
}

std::string text_of(LightPart part) {
    constexpr std::array texts{"what is seen of them", "direct light", "indirect light"};
    return texts[static_cast<std::size_t>(part)];
}

std::size_t LightUse::differing_kinds(const LightUse& other) const {
    return static_cast<std::size_t>(std::count_if(all_kinds.begin(), all_kinds.end(), [&](LightKind kind) {
        return std::any_of(all_parts.begin(), all_parts.end(),
                           [&](LightPart part) { return has(part, kind) != other.has(part, kind); });
    }));
}

std::vector<LightPart> light_parts_of(const std::string& paths) {
    if (paths == "direct") return {LightPart::direct};
    if (paths == "indirect") return {LightPart::indirect};
    if (paths == "full") return {all_parts.begin(), all_parts.end()};
    return {};
}

std::vector<LightPart> parts_in_both(const Settings& a, const Settings& b) {
    const auto others = light_parts_of(choice(b, "paths"));
    auto parts = light_parts_of(choice(a, "paths"));
    std::erase_if(parts, [&](LightPart part) { return !contains(others, part); });
    return parts;
}

LightUse light_use(const MethodDescription& method, const Settings& settings) {
    return use_of(method, settings, light_parts_of(choice(settings, "paths")));
}

LightUse light_use_of_lit(const MethodDescription& method, const Settings& settings) {
    return use_of(method, settings, {LightPart::direct});
}

Settings with_light_use(const MethodDescription& reference, Settings settings, const LightUse& wanted) {
    const auto values = [&](const std::string& key) -> std::vector<Value> {
        const auto* parameter = find(reference.parameters, key);
        if (!parameter) return {};
        if (parameter->type == ParameterType::toggle) return {true, false};
        std::vector<Value> keys;
        for (const auto& each : parameter->choices) keys.emplace_back(each.key);
        return keys;
    };
    std::vector<Settings> candidates{std::move(settings)};
    for (const char* key : {"emitters", "environment_light"}) {
        const auto choices = values(key);
        if (choices.empty()) continue;
        std::vector<Settings> more;
        for (const auto& candidate : candidates)
            for (const auto& value : choices) {
                more.push_back(candidate);
                more.back()[key] = value;
            }
        candidates = std::move(more);
    }
    return *std::min_element(candidates.begin(), candidates.end(), [&](const auto& a, const auto& b) {
        return light_use(reference, a).differing_kinds(wanted) <
               light_use(reference, b).differing_kinds(wanted);
    });
}

std::vector<UsedLight> used_lights(const std::vector<LightSource>& sources, const LightUse& use) {
    std::vector<UsedLight> result;
    for (const auto& source : sources) {
        result.push_back({source, {}});
        for (const auto part : all_parts)
            if (use.has(part, source.kind)) result.back().parts.push_back(part);
    }
    return result;
}

std::vector<std::string> light_differences(const std::vector<UsedLight>& a, const std::vector<UsedLight>& b,
                                           const std::vector<LightPart>& parts, const std::string& name_a,
                                           const std::string& name_b) {
    std::vector<std::string> result;
    for (const auto& left : a) {
        const auto right = std::find_if(b.begin(), b.end(),
                                        [&](const UsedLight& each) { return each.source == left.source; });
        if (right == b.end()) continue;
        const auto only_left = surplus(left, *right, parts), only_right = surplus(*right, left, parts);
        const auto add = [&](const std::vector<LightPart>& only, const std::string& where) {
            if (!only.empty())
                result.push_back(left.source.name + " " + what_it_does(only) + " in " + where + " alone");
        };
        add(only_left, name_a);
        add(only_right, name_b);
    }
    return result;
}

std::string to_json(const std::vector<UsedLight>& lights) {
    Json json = Json::array();
    for (const auto& [source, parts] : lights) {
        Json names = Json::array();
        for (const auto part : parts) names.push_back(to_string(part));
        json.push_back({{"source", source.name}, {"kind", to_string(source.kind)}, {"parts", names}});
    }
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::vector<UsedLight> used_lights_from_json(const std::string& text) {
    std::vector<UsedLight> result;
    const auto json = ReadJson::parse(text, nullptr, false);
    if (!json.is_array()) return {};
    for (const auto& each : json) {
        const auto kind =
            named<LightKind>(each.is_object() ? each.value("kind", ReadJson()) : ReadJson(), kind_names);
        if (!kind || !each.value("source", ReadJson()).is_string() ||
            !each.value("parts", ReadJson()).is_array())
            return {};
        result.push_back({{*kind, each["source"].get<std::string>()}, {}});
        for (const auto& name : each["parts"])
            if (const auto part = named<LightPart>(name, part_names)) result.back().parts.push_back(*part);
    }
    return result;
}

}  // namespace ir
