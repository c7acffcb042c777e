#include "projects/light_spec.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <numbers>
#include <span>

#include "projects/document_fields.h"
#include "projects/text.h"
#include "renderers/core/error.h"
#include "renderers/core/limits.h"
#include "renderers/core/spot_cone.h"
#include "renderers/core/value.h"

namespace ir::projects {
namespace {

using Type = LightSpec::Type;
using Quantity = LightSpec::Quantity;

std::vector<std::string_view> split(std::string_view text, char separator) {
    std::vector<std::string_view> parts;
    while (true) {
        const auto end = text.find(separator);
        parts.push_back(text.substr(0, end));
        if (end == std::string_view::npos) return parts;
        text.remove_prefix(end + 1);
    }
}

template <std::size_t count>
std::array<double, count> parse_numbers(std::string_view text, const std::string& what, const char* form) {
    const auto parts = split(text, ',');
    std::array<double, count> numbers{};
    if (parts.size() != count)
        throw UsageError(what + ": '" + printable(text) + "' is not allowed; give " + form);
    for (std::size_t i = 0; i < count; ++i) numbers[i] = parse_number(parts[i], what);
    return numbers;
}

std::vector<std::string> allowed_fields(Type type) {
    LightSpec light;
    light.type = type;
    std::vector<std::string> keys;
    for (const auto& field : light_fields())
        if (field.is_stored_in(light)) keys.push_back(field.text.key);
    for (const auto quantity : allowed_quantities(type)) keys.push_back(to_string(quantity));
    return keys;
}

Type parse_type(std::string_view text, std::string_view spec) {
    if (const auto type = light_type_of(text)) return *type;
    throw UsageError("light '" + printable(spec) + "': unknown type '" + printable(text) + "'; give " +
                     light_type_names());
}

using Given = std::map<std::string, std::string_view, std::less<>>;

/// Splits "key=value;…" and refuses keys that the type does not have or that stand twice.
Given parse_fields(std::string_view text, Type type, const std::string& where) {
    const auto allowed = allowed_fields(type);
    Given given;
    for (const auto part : split(text, ';')) {
        if (part.empty()) continue;
        const auto equals = part.find('=');
        const std::string key(part.substr(0, equals));
        if (equals == std::string_view::npos ||
            std::find(allowed.begin(), allowed.end(), key) == allowed.end())
            throw UsageError(where + "unknown field '" + printable(key) + "'; allowed are " +
                             listed(allowed));
        if (!given.emplace(key, part.substr(equals + 1)).second)
            throw UsageError(where + "field '" + key + "' stands twice; give it once");
    }
    return given;
}

void require(const Given& given, const std::string& key, const std::string& where) {
    if (given.count(key) == 0) throw UsageError(where + "field '" + key + "' is missing; add " + key + "=…");
}

void take_quantity(LightSpec& light, const Given& all, const std::string& where) {
    std::vector<std::string> names;
    int given = 0;
    for (const auto quantity : allowed_quantities(light.type)) {
        names.push_back(to_string(quantity));
        const auto found = all.find(names.back());
        if (found == all.end()) continue;
        light.quantity = quantity;
        light.amount = parse_number(found->second, where + names.back());
        ++given;
    }
    if (given == 1) return;
    std::string choices = names.front();
    for (std::size_t i = 1; i < names.size(); ++i) choices += " or " + names[i];
    throw UsageError(where + (given == 0 ? "its strength is missing" : "its strength is given twice") +
                     "; give " + choices);
}

void require_all(const LightSpec& light, const Given& given, const std::string& where) {
    for (const auto& key : allowed_fields(light.type))
        if (key == "position" || key == "outer" || key == "size") require(given, key, where);
    if (light.type == Type::directional) require(given, "direction", where);
    if (looks(light.type) && given.count("target") + given.count("direction") != 1)
        throw UsageError(where + "give either target or direction");
}

void parse(std::string_view text, const std::string& what, double& value) {
    value = parse_number(text, what);
}
void parse(std::string_view text, const std::string& what, glm::dvec2& value) {
    value = parse_vec2(text, what);
}
void parse(std::string_view text, const std::string& what, glm::dvec3& value) {
    value = parse_vec3(text, what);
}
void parse(std::string_view text, const std::string& what, std::optional<glm::dvec3>& value) {
    value = parse_vec3(text, what);
}
template <class Other>
void parse(std::string_view, const std::string& what, Other&) {
    throw std::logic_error(what + ": no light has such a field");
}

std::string numbers_text(const std::vector<double>& numbers) {
    std::string text;
    for (const double number : numbers) text += (text.empty() ? "" : ",") + shortest_text(number);
    return text;
}

void validate_places(const LightSpec& light, const std::string& where) {
    if (looks(light.type) && light.target.has_value() == light.direction.has_value())
        throw UsageError(where + "give either target or direction");
    if (light.type == Type::directional && !light.direction)
        throw UsageError(where + "direction is missing; give the direction of travel");
    if (light.target && *light.target == light.position)
        throw UsageError(where + "target must differ from position");
    if (light.direction && glm::length(*light.direction) == 0)
        throw UsageError(where + "direction must not be 0,0,0");
}

}  // namespace

std::string to_string(LightSpec::Type type) {
    return LightSpec::type_names.at(static_cast<std::size_t>(type));
}

std::optional<Type> light_type_of(std::string_view name) {
    for (const auto type : LightSpec::types)
        if (to_string(type) == name) return type;
    return {};
}

std::string light_type_names() {
    std::string names = to_string(LightSpec::types.front());
    for (const auto type : std::span(LightSpec::types).subspan(1))
        names += (type == LightSpec::types.back() ? " or " : ", ") + to_string(type);
    return names;
}

std::string to_string(LightSpec::Quantity quantity) {
    return quantity_text(quantity).key;
}

bool looks(Type type) {
    return type == Type::spot || type == Type::rect || type == Type::disk;
}

std::vector<Quantity> allowed_quantities(Type type) {
    switch (type) {
        case Type::point:
        case Type::spot:
            return {Quantity::intensity, Quantity::flux};
        case Type::directional:
            return {Quantity::irradiance};
        case Type::rect:
        case Type::disk:
            return {Quantity::radiance, Quantity::flux};
    }
    return {};
}

double flux_per_unit(const LightSpec& light) {
    constexpr double pi = std::numbers::pi;
    switch (light.type) {
        case Type::point:
            return 4 * pi;
        case Type::spot:
            return spot_solid_angle(glm::radians(light.inner), glm::radians(light.outer));
        case Type::rect:
            return pi * light.size.x * light.size.y;
        case Type::disk:
            return pi * (pi / 4 * light.size.x * light.size.y);
        case Type::directional:
            break;
    }
    throw std::logic_error("a light without an end has no flux");
}

glm::dvec3 LightSpec::travel() const {
    if (target) return glm::normalize(*target - position);
    return direction ? glm::normalize(*direction) : glm::dvec3{0, -1, 0};
}

double LightSpec::intensity() const {
    return quantity == Quantity::flux ? amount / flux_per_unit(*this) : amount;
}

void validate(const LightSpec& light) {
    const std::string where = to_string(light.type) + " light: ";
    const auto allowed = allowed_quantities(light.type);
    if (std::find(allowed.begin(), allowed.end(), light.quantity) == allowed.end())
        throw UsageError(where + to_string(light.quantity) + " does not fit; give " +
                         to_string(allowed.front()));
    double amount = light.amount;
    const auto& strength = quantity_text(light.quantity);
    if (const auto problem = problem_with(strength, &amount); !problem.empty())
        throw UsageError(where + strength.key + " " + problem);
    validate_fields(light, light_fields(), where);
    validate_places(light, where);
    if (light.type == Type::spot && light.inner > light.outer)
        throw UsageError(where + "inner must not exceed outer");
}

LightSpec parse_light(std::string_view spec) {
    const auto colon = spec.find(':');
    LightSpec light;
    light.type = parse_type(spec.substr(0, colon), spec);
    const std::string where = "light '" + to_string(light.type) + "': ";
    const auto given =
        parse_fields(colon == std::string_view::npos ? "" : spec.substr(colon + 1), light.type, where);
    require_all(light, given, where);
    take_quantity(light, given, where);
    for (const auto& field : light_fields())
        if (const auto found = given.find(field.text.key); found != given.end())
            std::visit([&](auto place) { parse(found->second, where + found->first, light.*place); },
                       field.member);
    validate(light);
    return light;
}

std::string to_string(const LightSpec& light) {
    auto values = light;
    std::string text = to_string(light.type) + ":", color;
    for (const auto& field : light_fields()) {
        const auto numbers = numbers_of(field.slot(values));
        if (!field.counts_in(light) || numbers.empty()) continue;
        const auto part = field.text.key + "=" + numbers_text(numbers) + ";";
        if (field.text.key == "color")
            color = light.color == glm::dvec3(1) ? "" : ";color=" + numbers_text(numbers);
        else if (field.text.key != "inner" || light.inner != 0)
            text += part;
    }
    return text + to_string(light.quantity) + "=" + shortest_text(light.amount) + color;
}

glm::dvec3 parse_vec3(std::string_view text, const std::string& what) {
    const auto n = parse_numbers<3>(text, what, "three numbers x,y,z");
    return {n[0], n[1], n[2]};
}

glm::dvec2 parse_vec2(std::string_view text, const std::string& what) {
    const auto n = parse_numbers<2>(text, what, "two numbers x,y");
    return {n[0], n[1]};
}

glm::ivec2 parse_size(std::string_view text, const std::string& what) {
    const auto parts = split(text, 'x');
    glm::ivec2 size{0};
    for (std::size_t i = 0; i < parts.size() && i < 2; ++i) {
        const auto* end = parts[i].data() + parts[i].size();
        const auto result = std::from_chars(parts[i].data(), end, size[static_cast<int>(i)]);
        if (result.ec != std::errc{} || result.ptr != end) size = {0, 0};
    }
    if (parts.size() != 2 || size.x < 1 || size.y < 1 || size.x > max_image_side || size.y > max_image_side)
        throw UsageError(what + ": '" + printable(text) +
                         "' is not allowed; give WIDTHxHEIGHT, each from 1 to " +
                         std::to_string(max_image_side));
    return size;
}

double parse_number(std::string_view text, const std::string& what) {
    double number = 0;
    const auto* end = text.data() + text.size();
    const auto result = std::from_chars(text.data(), end, number);
    if (result.ec != std::errc{} || result.ptr != end || !std::isfinite(number))
        throw UsageError(what + ": '" + printable(text) + "' is not allowed; give a number");
    return number;
}

}  // namespace ir::projects
