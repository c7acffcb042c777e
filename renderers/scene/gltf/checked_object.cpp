#include "renderers/scene/gltf/checked_object.h"

#include <cfloat>
#include <cmath>

#include "renderers/core/error.h"

namespace ir::scene::gltf {

std::string element(const std::string& array, std::size_t index) {
    return array + "[" + std::to_string(index) + "]";
}

CheckedObject::CheckedObject(const std::string& file, std::string place, const Json& object)
    : file_(file), place_(std::move(place)), object_(object) {
    if (!object_.is_object())
        throw InputError(file_, place_.empty() ? "document" : place_, "must be a JSON object");
}

void CheckedObject::fail(const std::string& key, const std::string& problem) const {
    throw InputError(file_, place(key), problem);
}

const Json* CheckedObject::find(const char* key) const {
    const auto found = object_.find(key);
    return found == object_.end() ? nullptr : &*found;
}

std::int64_t CheckedObject::whole(const Json& value, const std::string& key, std::int64_t low,
                                  std::int64_t high) const {
    // Writers in languages without integers give 1.0, which glTF 2.0 allows.
    if (!value.is_number() || std::trunc(value.get<double>()) != value.get<double>())
        fail(key, "must be a whole number");
    const double wide = value.get<double>();
    if (wide < static_cast<double>(low) || wide > static_cast<double>(high))
        fail(key, "must lie in " + std::to_string(low) + "..." + std::to_string(high));
    return static_cast<std::int64_t>(wide);
}

double CheckedObject::finite(const Json& value, const std::string& key) const {
    if (!value.is_number()) fail(key, "must be a number");
    const double result = value.get<double>();
    if (!(std::abs(result) <= FLT_MAX)) fail(key, "must be a number within the range of a float");
    return result;
}

std::optional<std::int64_t> CheckedObject::integer(const char* key, std::int64_t low, std::int64_t high) {
    const auto* value = find(key);
    if (!value) return {};
    const auto checked = whole(*value, key, low, high);
    result[key] = checked;
    return checked;
}

std::optional<int> CheckedObject::index(const char* key, std::size_t count, const char* what) {
    const auto* value = find(key);
    if (!value) return {};
    const auto checked = static_cast<int>(whole(*value, key, 0, INT32_MAX));
    if (static_cast<std::size_t>(checked) >= count)
        fail(key, "refers to " + element(what, checked) + ", but there are " + std::to_string(count));
    result[key] = checked;
    return checked;
}

std::optional<double> CheckedObject::number(const char* key) {
    const auto* value = find(key);
    if (!value) return {};
    const auto checked = finite(*value, key);
    result[key] = checked;
    return checked;
}

std::optional<std::vector<double>> CheckedObject::numbers(const char* key, std::size_t count) {
    const auto* values = array(key);
    if (!values) return {};
    if (values->size() != count) fail(key, "must have " + std::to_string(count) + " numbers");
    std::vector<double> checked;
    for (const auto& value : *values) checked.push_back(finite(value, key));
    result[key] = checked;
    return checked;
}

std::optional<std::vector<int>> CheckedObject::indices(const char* key, std::size_t count, const char* what) {
    const auto* values = array(key);
    if (!values) return {};
    std::vector<int> checked;
    for (const auto& value : *values) {
        const auto i = whole(value, key, 0, INT32_MAX);
        if (static_cast<std::size_t>(i) >= count)
            fail(key, "refers to " + element(what, i) + ", but there are " + std::to_string(count));
        checked.push_back(static_cast<int>(i));
    }
    result[key] = checked;
    return checked;
}

std::optional<std::string> CheckedObject::text(const char* key) {
    const auto* value = find(key);
    if (!value) return {};
    if (!value->is_string()) fail(key, "must be a string");
    result[key] = *value;
    return value->get<std::string>();
}

std::optional<bool> CheckedObject::boolean(const char* key) {
    const auto* value = find(key);
    if (!value) return {};
    if (!value->is_boolean()) fail(key, "must be true or false");
    result[key] = *value;
    return value->get<bool>();
}

const Json* CheckedObject::object(const char* key) const {
    const auto* value = find(key);
    if (value && !value->is_object()) fail(key, "must be a JSON object");
    return value;
}

const Json* CheckedObject::array(const char* key) const {
    const auto* value = find(key);
    if (value && !value->is_array()) fail(key, "must be a JSON array");
    return value;
}

const Json* CheckedObject::extension(const char* name) const {
    const auto* extensions = object("extensions");
    if (!extensions) return nullptr;
    const auto found = extensions->find(name);
    if (found == extensions->end()) return nullptr;
    if (!found->is_object()) fail(std::string("extensions.") + name, "must be a JSON object");
    return &*found;
}

const Json& CheckedObject::required_object(const char* key) const {
    const auto* value = object(key);
    if (!value) fail(key, "is missing; export the file again");
    return *value;
}

}  // namespace ir::scene::gltf
