#include "projects/light_spec.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <numbers>

#include "projects/text.h"
#include "renderers/core/error.h"
#include "renderers/core/limits.h"

namespace ir::projects {
namespace {

using Type = LightSpec::Type;
using Quantity = LightSpec::Quantity;

constexpr std::array types{Type::point, Type::spot, Type::directional, Type::rect, Type::disk};

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

bool looks(Type type) {
    return type == Type::spot || type == Type::rect || type == Type::disk;
}

std::vector<std::string> allowed_fields(Type type) {
    std::vector<std::string> fields;
    if (type != Type::directional) fields.push_back("position");
    if (looks(type)) fields.push_back("target");
    if (type != Type::point) fields.push_back("direction");
    for (const auto quantity : allowed_quantities(type)) fields.push_back(to_string(quantity));
    if (type == Type::spot) fields.insert(fields.end(), {"outer", "inner"});
    if (type == Type::rect || type == Type::disk) fields.push_back("size");
    fields.push_back("color");
    return fields;
}

Type parse_type(std::string_view text, std::string_view spec) {
    for (const auto type : types)
        if (to_string(type) == text) return type;
    throw UsageError("light '" + printable(spec) + "': unknown type '" + printable(text) +
                     "'; give point, spot, directional, rect or disk");
}

using Fields = std::map<std::string, std::string_view, std::less<>>;

/// Splits "key=value;…" and refuses keys that the type does not have or that stand twice.
Fields parse_fields(std::string_view text, Type type, const std::string& where) {
    const auto allowed = allowed_fields(type);
    Fields fields;
    for (const auto part : split(text, ';')) {
        if (part.empty()) continue;
        const auto equals = part.find('=');
        const std::string key(part.substr(0, equals));
        if (equals == std::string_view::npos ||
            std::find(allowed.begin(), allowed.end(), key) == allowed.end())
            throw UsageError(where + "unknown field '" + printable(key) + "'; allowed are " +
                             listed(allowed));
        if (!fields.emplace(key, part.substr(equals + 1)).second)
            throw UsageError(where + "field '" + key + "' stands twice; give it once");
    }
    return fields;
}

void require(const Fields& fields, const std::string& key, const std::string& where) {
    if (fields.count(key) == 0) throw UsageError(where + "field '" + key + "' is missing; add " + key + "=…");
}

void take_quantity(LightSpec& light, const Fields& fields, const std::string& where) {
    std::vector<std::string> names;
    int given = 0;
    for (const auto quantity : allowed_quantities(light.type)) {
        names.push_back(to_string(quantity));
        const auto found = fields.find(names.back());
        if (found == fields.end()) continue;
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

void require_places(const LightSpec& light, const Fields& fields, const std::string& where) {
    if (light.type != Type::directional) require(fields, "position", where);
    if (light.type == Type::directional) require(fields, "direction", where);
    if (light.type == Type::spot) require(fields, "outer", where);
    if (light.type == Type::rect || light.type == Type::disk) require(fields, "size", where);
    if (looks(light.type) && fields.count("target") + fields.count("direction") != 1)
        throw UsageError(where + "give either target or direction");
}

std::string text_of(double number) {
    char text[40];
    return {text, std::to_chars(text, text + sizeof text, number).ptr};
}

std::string text_of(const glm::dvec3& v) {
    return text_of(v.x) + "," + text_of(v.y) + "," + text_of(v.z);
}

bool is_finite(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void validate_places(const LightSpec& light, const std::string& where) {
    if (!is_finite(light.position)) throw UsageError(where + "position must be finite");
    if (looks(light.type) && light.target.has_value() == light.direction.has_value())
        throw UsageError(where + "give either target or direction");
    if (light.type == Type::directional && !light.direction)
        throw UsageError(where + "direction is missing; give the direction of travel");
    if (light.target && (!is_finite(*light.target) || *light.target == light.position))
        throw UsageError(where + "target must be finite and differ from position");
    if (light.direction && (!is_finite(*light.direction) || glm::length(*light.direction) == 0))
        throw UsageError(where + "direction must be finite and not 0,0,0");
}

}  // namespace

std::string to_string(LightSpec::Type type) {
    static constexpr std::array names{"point", "spot", "directional", "rect", "disk"};
    return names.at(static_cast<std::size_t>(type));
}

std::string to_string(LightSpec::Quantity quantity) {
    static constexpr std::array names{"intensity", "flux", "irradiance", "radiance"};
    return names.at(static_cast<std::size_t>(quantity));
}

std::vector<Quantity> allowed_quantities(Type type) {
    switch (type) {
        case Type::point:
            return {Quantity::intensity, Quantity::flux};
        case Type::spot:
            return {Quantity::intensity};
        case Type::directional:
            return {Quantity::irradiance};
        case Type::rect:
        case Type::disk:
            return {Quantity::radiance};
    }
    return {};
}

glm::dvec3 LightSpec::travel() const {
    if (target) return glm::normalize(*target - position);
    return direction ? glm::normalize(*direction) : glm::dvec3{0, -1, 0};
}

double LightSpec::intensity() const {
    return quantity == Quantity::flux ? amount / (4 * std::numbers::pi) : amount;
}

void validate(const LightSpec& light) {
    const std::string where = to_string(light.type) + " light: ";
    const auto allowed = allowed_quantities(light.type);
    if (std::find(allowed.begin(), allowed.end(), light.quantity) == allowed.end())
        throw UsageError(where + to_string(light.quantity) + " does not fit; give " +
                         to_string(allowed.front()));
    if (!std::isfinite(light.amount) || light.amount < 0)
        throw UsageError(where + to_string(light.quantity) + " must be a number of at least 0");
    if (!is_finite(light.color) || light.color.x < 0 || light.color.y < 0 || light.color.z < 0)
        throw UsageError(where + "color must be three numbers of at least 0");
    validate_places(light, where);
    if (light.type == Type::spot && !(light.outer > 0 && light.outer <= 90))
        throw UsageError(where + "outer must be above 0 and at most 90 degrees");
    if (light.type == Type::spot && !(light.inner >= 0 && light.inner <= light.outer))
        throw UsageError(where + "inner must lie between 0 and outer (degrees)");
    const bool has_size = light.type == Type::rect || light.type == Type::disk;
    if (has_size && !(light.size.x > 0 && light.size.y > 0 && std::isfinite(light.size.x + light.size.y)))
        throw UsageError(where + "size must be two numbers above 0 (metres)");
}

LightSpec parse_light(std::string_view spec) {
    const auto colon = spec.find(':');
    LightSpec light;
    light.type = parse_type(spec.substr(0, colon), spec);
    const std::string where = "light '" + to_string(light.type) + "': ";
    const auto fields =
        parse_fields(colon == std::string_view::npos ? "" : spec.substr(colon + 1), light.type, where);
    require_places(light, fields, where);
    take_quantity(light, fields, where);
    for (const auto& [key, text] : fields) {
        if (key == "position") light.position = parse_vec3(text, where + key);
        if (key == "target") light.target = parse_vec3(text, where + key);
        if (key == "direction") light.direction = parse_vec3(text, where + key);
        if (key == "color") light.color = parse_vec3(text, where + key);
        if (key == "size") light.size = parse_vec2(text, where + key);
        if (key == "outer") light.outer = parse_number(text, where + key);
        if (key == "inner") light.inner = parse_number(text, where + key);
    }
    validate(light);
    return light;
}

std::string to_string(const LightSpec& light) {
    std::string text = to_string(light.type) + ":";
    if (light.type != Type::directional) text += "position=" + text_of(light.position) + ";";
    if (light.target) text += "target=" + text_of(*light.target) + ";";
    if (light.direction) text += "direction=" + text_of(*light.direction) + ";";
    if (light.type == Type::spot) text += "outer=" + text_of(light.outer) + ";";
    if (light.type == Type::spot && light.inner != 0) text += "inner=" + text_of(light.inner) + ";";
    if (light.type == Type::rect || light.type == Type::disk)
        text += "size=" + text_of(light.size.x) + "," + text_of(light.size.y) + ";";
    text += to_string(light.quantity) + "=" + text_of(light.amount);
    return light.color == glm::dvec3(1) ? text : text + ";color=" + text_of(light.color);
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
