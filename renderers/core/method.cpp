#include "renderers/core/method.h"

#include <algorithm>

#include "renderers/core/error.h"
#include "renderers/core/words.h"

namespace ir {

namespace {

/// What depends on a parameter that has no effect is not there either.
bool is_met(const MethodDescription& method, const Condition& condition, const Settings& settings) {
    const auto* parameter = find(method.parameters, condition.key);
    if (!parameter) return true;
    const auto given = settings.find(condition.key);
    const auto& value = given == settings.end() ? parameter->default_value : given->second;
    return std::find(condition.values.begin(), condition.values.end(), value) != condition.values.end() &&
           is_met(method, parameter->active_when, settings);
}

}  // namespace

bool is_active(const MethodDescription& method, const OutputDescription& output, const Settings& settings) {
    return is_met(method, output.active_when, settings);
}

const OutputDescription* main_output(const MethodDescription& method, const Settings& settings) {
    for (const auto& output : method.outputs)
        if (is_active(method, output, settings)) return &output;
    return nullptr;
}

const MethodDescription* Registry::reference() const {
    for (const auto* method : methods_)
        if (method->is_reference) return method;
    return nullptr;
}

const MethodDescription* Registry::find(const std::string& id) const {
    for (const auto* method : methods_)
        if (method->id == id) return method;
    return nullptr;
}

const MethodDescription& Registry::at(const std::string& id) const {
    if (const auto* method = find(id)) return *method;
    throw UsageError("unknown method '" + id + "'" +
                     known_are(id, words_of(methods_, &MethodDescription::id)));
}

}  // namespace ir
