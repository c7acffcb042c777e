#include "projects/object_reader.h"

#include "projects/document.h"
#include "projects/text.h"
#include "renderers/core/error.h"

namespace ir::projects {
namespace {

constexpr std::size_t longest_pointer = 200;

std::string range_text(const std::string& kind, const std::string& min, const std::string& max) {
    return "must be " + kind + " from " + min + " to " + max;
}

}  // namespace

ObjectReader::ObjectReader(const Json& object, std::string file, std::string pointer)
    : object_(object), file_(std::move(file)), pointer_(std::move(pointer)) {
    if (!object.is_object())
        throw InputError(file_, printable(pointer_, longest_pointer), "must be an object {…}");
}

std::string ObjectReader::pointer_to_member(const std::string& key) const {
    return pointer_to(pointer_, key);
}

void ObjectReader::fail(const std::string& key, const std::string& problem) const {
    throw InputError(file_, printable(pointer_to_member(key), longest_pointer), problem);
}

const Json* ObjectReader::take(const std::string& key) {
    known_.insert(key);
    const auto found = object_.find(key);
    return found == object_.end() ? nullptr : &*found;
}

std::string ObjectReader::text(const std::string& key, std::string otherwise) {
    const auto* json = take(key);
    if (!json) return otherwise;
    if (!json->is_string()) fail(key, "must be a text in quotes");
    return json->get<std::string>();
}

std::string ObjectReader::required_text(const std::string& key) {
    const auto result = text(key);
    if (result.empty()) fail(key, "is missing or empty; give a text");
    return result;
}

std::string ObjectReader::required_id(const std::string& key) {
    const auto id = required_text(key);
    if (!is_valid_id(id))
        fail(key, "'" + printable(id, 60) +
                      "' is no id; use up to 100 letters, digits, '-', '_' and '.', not beginning with '.'");
    return id;
}

bool ObjectReader::flag(const std::string& key, bool otherwise) {
    const auto* json = take(key);
    if (!json) return otherwise;
    if (!json->is_boolean()) fail(key, "must be true or false");
    return json->get<bool>();
}

double ObjectReader::number(const std::string& key, double otherwise, double min, double max) {
    const auto* json = take(key);
    if (!json) return otherwise;
    if (!json->is_number()) fail(key, "must be a number");
    const double value = json->get<double>();
    if (!(value >= min && value <= max))
        fail(key, range_text("a number", ir::to_string(Value{min}), ir::to_string(Value{max})));
    return value;
}

std::int64_t ObjectReader::integer(const std::string& key, std::int64_t otherwise, std::int64_t min,
                                   std::int64_t max) {
    const auto* json = take(key);
    if (!json) return otherwise;
    const bool fits =
        json->is_number_integer() &&
        (!json->is_number_unsigned() ||
         json->get<std::uint64_t>() <= static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max()));
    if (!fits || json->get<std::int64_t>() < min || json->get<std::int64_t>() > max)
        fail(key, range_text("an integer", std::to_string(min), std::to_string(max)));
    return json->get<std::int64_t>();
}

std::uint64_t ObjectReader::natural(const std::string& key, std::uint64_t otherwise) {
    const auto* json = take(key);
    if (!json) return otherwise;
    const bool fits =
        json->is_number_unsigned() || (json->is_number_integer() && json->get<std::int64_t>() >= 0);
    if (!fits) fail(key, "must be an integer of at least 0");
    return json->get<std::uint64_t>();
}

void ObjectReader::numbers(const std::string& key, double* out, std::size_t count) {
    const auto* json = take(key);
    bool good = json && json->is_array() && json->size() == count;
    for (std::size_t i = 0; good && i < count; ++i) {
        good = (*json)[i].is_number();
        if (good) out[i] = (*json)[i].get<double>();
    }
    if (!good) fail(key, "must be an array of " + std::to_string(count) + " numbers");
}

glm::ivec2 ObjectReader::size(const std::string& key, glm::ivec2 otherwise, std::int64_t min,
                              std::int64_t max) {
    const auto* json = take(key);
    if (!json) return otherwise;
    const auto is_side = [&](const Json& side) {
        return side.is_number_integer() && side.get<double>() >= double(min) &&
               side.get<double>() <= double(max);
    };
    if (!json->is_array() || json->size() != 2 || !is_side((*json)[0]) || !is_side((*json)[1]))
        fail(key, range_text("[width, height], each an integer", std::to_string(min), std::to_string(max)));
    return glm::ivec2((*json)[0].get<int>(), (*json)[1].get<int>());
}

void ObjectReader::each(const std::string& key,
                        const std::function<void(const Json&, const std::string&)>& read) {
    const auto* json = take(key);
    if (!json) return;
    if (!json->is_array()) fail(key, "must be an array […]");
    for (std::size_t i = 0; i < json->size(); ++i) read((*json)[i], pointer_to(pointer_to_member(key), i));
}

Json ObjectReader::rest() const {
    Json result = Json::object();
    for (auto it = object_.begin(); it != object_.end(); ++it)
        if (known_.count(it.key()) == 0) result[it.key()] = *it;
    return result;
}

}  // namespace ir::projects
