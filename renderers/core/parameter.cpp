#include "renderers/core/parameter.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "renderers/core/error.h"
#include "renderers/core/words.h"

namespace ir {
namespace {

std::vector<std::string> allowed_choices(const ParameterText& p) {
    if (!p.supported.empty()) return p.supported;
    std::vector<std::string> keys;
    for (const auto& choice : p.choices) keys.push_back(choice.key);
    return keys;
}

[[noreturn]] void refuse(const ParameterDescription& p, const std::string& given,
                         const std::string& allowed) {
    throw UsageError("parameter '" + p.key + "': '" + given + "' is not allowed; give " + allowed);
}

std::string range_text(const ParameterDescription& p) {
    const std::string kind = p.type == ParameterType::integer ? "an integer" : "a number";
    const auto number = [](double v) { return to_string(Value{v}); };
    std::string text = kind;
    if (std::isfinite(p.hard.min) && std::isfinite(p.hard.max))
        text += " from " + number(p.hard.min) + " to " + number(p.hard.max);
    else if (std::isfinite(p.hard.min))
        text += " of at least " + number(p.hard.min);
    else if (std::isfinite(p.hard.max))
        text += " of at most " + number(p.hard.max);
    return p.unit.empty() ? text : text + " (" + p.unit + ")";
}

template <class Number>
std::optional<Number> parse_number(std::string_view text) {
    Number number{};
    const auto* end = text.data() + text.size();
    const auto result = std::from_chars(text.data(), end, number);
    if (result.ec != std::errc{} || result.ptr != end) return std::nullopt;
    return number;
}

}  // namespace

int ParameterDescription::choice_index(const std::string& choice_key) const {
    for (std::size_t i = 0; i < choices.size(); ++i)
        if (choices[i].key == choice_key) return static_cast<int>(i);
    refuse(*this, choice_key, "one of " + listed(allowed_choices(*this)));
}

Value ParameterDescription::checked(const Value& value) const {
    const std::string given = to_string(value);
    switch (type) {
        case ParameterType::toggle:
            if (!std::holds_alternative<bool>(value)) refuse(*this, given, "true or false");
            return value;
        case ParameterType::choice: {
            const auto* key_given = std::get_if<std::string>(&value);
            const auto allowed = allowed_choices(*this);
            if (!key_given || std::find(allowed.begin(), allowed.end(), *key_given) == allowed.end())
                refuse(*this, given, "one of " + listed(allowed));
            return value;
        }
        case ParameterType::integer: {
            std::int64_t number = 0;
            if (const auto* i = std::get_if<std::int64_t>(&value))
                number = *i;
            else if (const auto* d = std::get_if<double>(&value);
                     d && std::floor(*d) == *d && std::abs(*d) < 9e15)
                number = static_cast<std::int64_t>(*d);
            else
                refuse(*this, given, range_text(*this));
            if (!(number >= hard.min && number <= hard.max)) refuse(*this, given, range_text(*this));
            return number;
        }
        case ParameterType::number: {
            double number = 0;
            if (const auto* d = std::get_if<double>(&value))
                number = *d;
            else if (const auto* i = std::get_if<std::int64_t>(&value))
                number = static_cast<double>(*i);
            else
                refuse(*this, given, range_text(*this));
            if (!std::isfinite(number) || !(number >= hard.min && number <= hard.max))
                refuse(*this, given, range_text(*this));
            return number;
        }
    }
    return value;
}

Value ParameterDescription::parse(std::string_view text) const {
    switch (type) {
        case ParameterType::toggle:
            if (text == "true" || text == "on" || text == "1") return true;
            if (text == "false" || text == "off" || text == "0") return false;
            refuse(*this, std::string(text), "true or false");
        case ParameterType::integer:
            if (const auto number = parse_number<std::int64_t>(text)) return checked(*number);
            refuse(*this, std::string(text), range_text(*this));
        case ParameterType::number:
            if (const auto number = parse_number<double>(text)) return checked(*number);
            refuse(*this, std::string(text), range_text(*this));
        case ParameterType::choice:
            return checked(std::string(text));
    }
    return std::string(text);
}

Settings coarse(const std::vector<ParameterDescription>& parameters, Settings settings) {
    for (const auto& p : parameters) {
        if (!p.coarse) continue;
        auto& value = settings.at(p.key);
        const bool is_number = p.type == ParameterType::integer || p.type == ParameterType::number;
        const auto coarse = p.checked(*p.coarse);
        value = is_number ? std::min(p.checked(value), coarse) : coarse;
    }
    return settings;
}

const ParameterDescription* find(const std::vector<ParameterDescription>& parameters, std::string_view key) {
    for (const auto& p : parameters)
        if (p.key == key) return &p;
    return nullptr;
}

Settings defaults(const std::vector<ParameterDescription>& parameters) {
    Settings result;
    for (const auto& p : parameters) result[p.key] = p.default_value;
    return result;
}

const ParameterDescription& parameter_named(const std::vector<ParameterDescription>& parameters,
                                            const std::string& key) {
    if (const auto* parameter = find(parameters, key)) return *parameter;
    throw UsageError("unknown parameter '" + key + "'" +
                     known_are(key, words_of(parameters, &ParameterDescription::key)));
}

Settings completed(const std::vector<ParameterDescription>& parameters, const Settings& given) {
    Settings result = defaults(parameters);
    for (const auto& [key, value] : given) result[key] = parameter_named(parameters, key).checked(value);
    return result;
}

bool is_active(const ParameterDescription& parameter, const Settings& settings) {
    const auto& condition = parameter.active_when;
    if (condition.key.empty()) return true;
    const auto found = settings.find(condition.key);
    if (found == settings.end()) return false;
    for (const auto& value : condition.values)
        if (found->second == value) return true;
    return false;
}

}  // namespace ir
