#pragma once

#include <algorithm>
#include <vector>

#include "renderers/core/method.h"

namespace ir::test {

/// A value with which the condition does not hold: the default where that is one.
inline Value other_value(const MethodDescription& method, const Condition& condition) {
    const auto& parameter = *find(method.parameters, condition.key);
    std::vector<Value> values{parameter.default_value};
    for (const auto& choice : parameter.choices) values.emplace_back(choice.key);
    if (parameter.type == ParameterType::toggle) values.insert(values.end(), {true, false});
    return *std::ranges::find_if(
        values, [&](const Value& value) { return std::ranges::count(condition.values, value) == 0; });
}

/// Settings, none of them a default, that change which light a method has: each combination of the conditions
/// under which it misses some, met and not met. The first are the defaults.
inline std::vector<Settings> light_variants(const MethodDescription& method) {
    std::vector<Settings> result{{}};
    for (const auto& missing : method.missing_light) {
        std::vector<Settings> combined{{}};
        for (const auto& condition : missing.active_when) {
            const auto without = combined;
            combined.clear();
            for (const auto& value : {condition.values.front(), other_value(method, condition)})
                for (auto settings : without) {
                    if (value != find(method.parameters, condition.key)->default_value)
                        settings[condition.key] = value;
                    combined.push_back(std::move(settings));
                }
        }
        for (auto& settings : combined)
            if (std::ranges::count(result, settings) == 0) result.push_back(std::move(settings));
    }
    return result;
}

}  // namespace ir::test
