#include "projects/fields.h"

#include <cmath>

#include "projects/text.h"
#include "renderers/core/value.h"

namespace ir::projects {
namespace {

template <class T>
constexpr bool is_optional = requires(T value) {
    value.reset();
};
template <class T>
constexpr bool is_vector = requires(T value) {
    T::length();
};

template <class T>
constexpr bool is_number = std::is_arithmetic_v<T> && !std::is_same_v<T, bool>;
template <class T>
constexpr bool is_whole = is_number<T>&& std::is_integral_v<T>;

/// Of vectors and optional numbers what they are made of.
template <class T>
struct NumberOf {
    using Type = T;
};
template <class T>
struct NumberOf<std::optional<T>> : NumberOf<T> {};
template <glm::length_t n, class T>
struct NumberOf<glm::vec<n, T>> : NumberOf<T> {};

template <class T>
requires is_number<T> std::vector<double> components(T number) {
    return {static_cast<double>(number)};
}
template <glm::length_t n, class T>
std::vector<double> components(const glm::vec<n, T>& vector) {
    return {&vector[0], &vector[0] + n};
}
template <class T>
std::vector<double> components(const std::optional<T>& value) {
    return value ? components(*value) : std::vector<double>();
}
template <class T>
requires(!is_number<T>) std::vector<double> components(const T&) {
    return {};
}

template <class T>
Json json_of(const FieldText& text, const T& value) {
    if constexpr (is_optional<T>)
        return json_of(text, *value);
    else if constexpr (is_vector<T>)
        return Json(std::vector(&value[0], &value[0] + T::length()));
    else if constexpr (std::is_same_v<T, bool>)
        return text.choices.empty() ? Json(value) : Json(text.choices.at(value ? 1 : 0));
    else
        return Json(value);
}

template <class T>
requires is_number<T>
void put(T& value, int, double number) {
    value = static_cast<T>(number);
}
template <glm::length_t n, class T>
void put(glm::vec<n, T>& value, int index, double number) {
    value[index] = static_cast<T>(number);
}
template <class T>
void put(std::optional<T>& value, int index, double number) {
    put(value ? *value : value.emplace(0), index, number);
}
template <class T>
requires(!is_number<T>) void put(T&, int, double) {
    throw std::logic_error("no number");
}

void take(ObjectReader& reader, const FieldText& text, bool& value) {
    if (text.choices.empty()) {
        value = reader.flag(text.key, value);
        return;
    }
    const auto name = reader.text(text.key, text.choices.at(value ? 1 : 0));
    const auto found = std::find(text.choices.begin(), text.choices.end(), name);
    if (found == text.choices.end())
        reader.fail(text.key, "must be " + text.choices[0] + " or " + text.choices[1] + ", not '" +
                                  printable(name, 60) + "'");
    value = found != text.choices.begin();
}

std::int64_t whole(double number) {
    return static_cast<std::int64_t>(
        std::clamp<double>(number, std::numeric_limits<int>::min(), std::numeric_limits<int>::max()));
}

void take(ObjectReader& reader, const FieldText& text, int& value) {
    value = static_cast<int>(reader.integer(text.key, value, whole(text.range.min), whole(text.range.max)));
}

void take(ObjectReader& reader, const FieldText& text, std::uint64_t& value) {
    value = reader.natural(text.key, value);
}

void take(ObjectReader& reader, const FieldText& text, glm::ivec2& value) {
    value = reader.size(text.key, value, whole(text.range.min), whole(text.range.max));
}

void take(ObjectReader& reader, const FieldText& text, double& value) {
    value = reader.number(text.key, value);
}

void take(ObjectReader& reader, const FieldText& text, std::string& value) {
    value = reader.text(text.key, value);
}

template <glm::length_t n>
void take(ObjectReader& reader, const FieldText& text, glm::vec<n, double>& value) {
    if (!reader.has(text.key)) return;
    reader.numbers(text.key, &value[0], n);
}

template <class T>
void take(ObjectReader& reader, const FieldText& text, std::optional<T>& value) {
    if (reader.has(text.key)) take(reader, text, value.emplace(0));
}

void take(ObjectReader& reader, const FieldText& text, std::vector<std::string>& value) {
    reader.each(text.key, [&](const Json& json, const std::string& pointer) {
        if (!json.is_string()) throw InputError(reader.file(), pointer, "must be a text in quotes");
        value.push_back(json.get<std::string>());
    });
}

void take(ObjectReader& reader, const FieldText& text, std::vector<Json>& value) {
    reader.each(text.key, [&](const Json& json, const std::string&) { value.push_back(json); });
}

bool contains(const Range& range, double number) {
    return std::isfinite(number) && number >= range.min && number <= range.max &&
           !(range.is_above_min && number == range.min);
}

/// "must be a number from 0 to 90 °", "must be 3 numbers of at least 0", "must be 2 integers from 1 to 64"
std::string demand(const FieldText& text, std::size_t count, bool are_whole) {
    const auto& range = text.range;
    const Range all;
    const auto text_of = [&](double number) {
        return ir::to_string(are_whole ? Value{whole(number)} : Value{number});
    };
    const std::string kind = are_whole ? "integer" : "number";
    std::string words = count != 1  ? "must be " + std::to_string(count) + " " + kind + "s"
                        : are_whole ? "must be an integer"
                                    : "must be a number";
    const bool has_min = range.min > all.min, has_max = range.max < all.max;
    if (!has_min && !has_max) return words + (count == 1 ? " that is finite" : " that are finite");
    if (has_min && has_max && !range.is_above_min)
        words += " from " + text_of(range.min) + " to " + text_of(range.max);
    else {
        if (has_min) words += (range.is_above_min ? " above " : " of at least ") + text_of(range.min);
        if (has_max) words += (has_min ? " and at most " : " of at most ") + text_of(range.max);
    }
    return text.unit.empty() ? words : words + " " + text.unit;
}

}  // namespace

std::vector<double> numbers_of(const Slot& value) {
    return std::visit([](const auto* place) { return components(*place); }, value);
}

void set_number(const Slot& value, int index, double number) {
    std::visit([&](auto* place) { put(*place, index, number); }, value);
}

std::string problem_with(const FieldText& text, const Slot& value) {
    const auto* const* words = std::get_if<std::string*>(&value);
    if (words && text.writing == FieldText::Writing::required && (*words)->empty())
        return "is missing or empty; give a text";
    const auto numbers = numbers_of(value);
    for (const double number : numbers)
        if (!contains(text.range, number)) {
            const bool are_whole = std::visit(
                [](const auto* place) {
                    return is_whole<typename NumberOf<std::decay_t<decltype(*place)>>::Type>;
                },
                value);
            return demand(text, numbers.size(), are_whole);
        }
    return {};
}

void read_value(ObjectReader& reader, const FieldText& text, const Slot& value) {
    std::visit([&](auto* place) { take(reader, text, *place); }, value);
    if (const auto problem = problem_with(text, value); !problem.empty()) reader.fail(text.key, problem);
}

void write_value(Json& json, const FieldText& text, const Slot& value, const Slot& standard) {
    std::visit(
        [&](const auto* place) {
            using T = std::decay_t<decltype(*place)>;
            if constexpr (is_optional<T>)
                if (!*place) return;
            if (text.writing == FieldText::Writing::unless_default && *place == *std::get<T*>(standard))
                return;
            json[text.key] = json_of(text, *place);
        },
        value);
}

}  // namespace ir::projects
