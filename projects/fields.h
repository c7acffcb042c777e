#pragma once

#include <algorithm>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "projects/object_reader.h"
#include "renderers/core/error.h"

/// Tables of fields: what file, window and command line know of the values of an item stands in them once.
namespace ir::projects {

/// What a number, or each component of a vector, may be.
struct Range {
    double min = -std::numeric_limits<double>::max(), max = std::numeric_limits<double>::max();
    bool is_above_min = false;  ///< `min` itself is not allowed
};

struct FieldText {
    enum class Writing { always, unless_default, required };  ///< required: a text that must not be empty

    std::string key;         ///< in the file and on the command line
    std::string label = {};  ///< in the window
    std::string unit = {};   ///< "m", "°", …; empty: none
    std::string doc = {};    ///< tooltip: what a person has to know, without the stop at its end
    Range range = {};
    Writing writing = Writing::always;
    std::vector<std::string> choices = {};  ///< of a bool: what the file has for false and true
};

/// A value of an item.
using Slot = std::variant<bool*, int*, std::uint64_t*, double*, std::string*, glm::ivec2*, glm::dvec2*,
                          glm::dvec3*, std::optional<int>*, std::optional<double>*,
                          std::optional<glm::ivec2>*, std::optional<glm::dvec2>*, std::optional<glm::dvec3>*,
                          std::optional<glm::dvec4>*, std::vector<std::string>*, std::vector<Json>*>;

/// Takes the member of this key; absent: the value stays. Throws InputError for a wrong type or range.
void read_value(ObjectReader& reader, const FieldText& text, const Slot& value);
/// Adds the member; leaves out what is absent and, where the text says so, what is as in `standard`.
void write_value(Json& json, const FieldText& text, const Slot& value, const Slot& standard);
/// "must be a number from 0 to 1", of numbers out of their range and required texts that are empty; empty:
/// all is well.
std::string problem_with(const FieldText& text, const Slot& value);
/// Its numbers; none of a text or of what is absent.
std::vector<double> numbers_of(const Slot& value);
/// Changes one of its numbers; others of a value that is absent are 0.
void set_number(const Slot& value, int index, double number);

template <class Item>
struct Field {
    std::variant<bool Item::*, int Item::*, std::uint64_t Item::*, double Item::*, std::string Item::*,
                 glm::ivec2 Item::*, glm::dvec2 Item::*, glm::dvec3 Item::*, std::optional<int> Item::*,
                 std::optional<double> Item::*, std::optional<glm::ivec2> Item::*,
                 std::optional<glm::dvec2> Item::*, std::optional<glm::dvec3> Item::*,
                 std::optional<glm::dvec4> Item::*, std::vector<std::string> Item::*,
                 std::vector<Json> Item::*>
        member;
    FieldText text;
    bool (*is_stored)(const Item&) = nullptr;  ///< whether the file has it; null: always
    bool (*counts)(const Item&) = nullptr;     ///< whether what the file has counts; null: always

    Slot slot(Item& item) const {
        return std::visit([&](auto place) { return Slot(&(item.*place)); }, member);
    }
    bool is_stored_in(const Item& item) const { return !is_stored || is_stored(item); }
    bool counts_in(const Item& item) const { return is_stored_in(item) && (!counts || counts(item)); }
};

template <class Item>
using Fields = std::vector<Field<Item>>;

/// Takes the members of a JSON object in the order of the table.
template <class Item>
void read_fields(ObjectReader& reader, Item& item, const Fields<Item>& fields) {
    for (const auto& field : fields)
        if (field.is_stored_in(item)) read_value(reader, field.text, field.slot(item));
}

/// Adds members in the order of the table.
template <class Item>
void write_fields(Json& json, Item item, const Fields<Item>& fields) {
    Item standard{};
    for (const auto& field : fields)
        if (field.is_stored_in(item)) write_value(json, field.text, field.slot(item), field.slot(standard));
}

/// Throws UsageError for the first wrong value; `where` begins the message.
template <class Item>
void validate_fields(Item item, const Fields<Item>& fields, const std::string& where) {
    for (const auto& field : fields) {
        if (!field.is_stored_in(item)) continue;
        if (const auto problem = problem_with(field.text, field.slot(item)); !problem.empty())
            throw UsageError(where + field.text.key + " " + problem);
    }
}

/// The field of a key, or null.
template <class Item>
const Field<Item>* find_field(const Fields<Item>& fields, const std::string& key) {
    const auto found =
        std::find_if(fields.begin(), fields.end(), [&](const auto& field) { return field.text.key == key; });
    return found == fields.end() ? nullptr : &*found;
}

/// The field of a key that is in the table.
template <class Item>
const Field<Item>& field_of(const Fields<Item>& fields, const std::string& key) {
    const auto* found = find_field(fields, key);
    if (!found) throw std::logic_error("no field " + key);
    return *found;
}

}  // namespace ir::projects
