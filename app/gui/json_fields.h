#pragma once

#include <algorithm>
#include <string>
#include <type_traits>

#include "projects/json.h"

namespace ir::gui {

/// A member of an object, or the fallback where it is missing or of another type: session.json is free text,
/// and nothing of value is in it.
template <class T>
T field_or(const projects::Json& object, const char* key, T fallback) {
    if (!object.is_object()) return fallback;
    const auto found = object.find(key);
    if (found == object.end()) return fallback;
    if constexpr (std::is_same_v<T, bool>)
        return found->is_boolean() ? found->template get<bool>() : fallback;
    else if constexpr (std::is_same_v<T, std::string>)
        return found->is_string() ? found->template get<std::string>() : fallback;
    else if constexpr (std::is_integral_v<T>)  // far-off numbers are brought near before they are converted
        return found->is_number() ? T(std::clamp(found->template get<double>(), -1e9, 1e9)) : fallback;
    else
        return found->is_number() ? found->template get<T>() : fallback;
}

/// A member that is an object or an array; null where it is missing.
inline const projects::Json& member_or_null(const projects::Json& object, const char* key) {
    static const projects::Json none;
    if (!object.is_object()) return none;
    const auto found = object.find(key);
    return found == object.end() ? none : *found;
}

}  // namespace ir::gui
