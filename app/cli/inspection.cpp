#include "app/cli/inspection.h"

#include <algorithm>
#include <charconv>
#include <optional>

#include "app/engine/execution.h"
#include "renderers/core/error.h"
#include "renderers/core/words.h"

namespace ir::cli {
namespace {

/// A whole number from 0 on; nothing for anything else.
std::optional<int> parse_index(std::string_view text) {
    int number = 0;
    const auto result = std::from_chars(text.data(), text.data() + text.size(), number);
    if (result.ec != std::errc{} || result.ptr != text.data() + text.size() || number < 0) return {};
    return number;
}

void parse_pick(const std::string& text, Inspection& inspection) {
    const auto comma = text.find(',');
    const auto x = parse_index(text.substr(0, comma));
    const auto y = comma == std::string::npos ? std::nullopt : parse_index(text.substr(comma + 1));
    if (!x || !y) throw UsageError("--pick '" + text + "' is not a pixel x,y; 0,0 is at the top left");
    inspection.x = *x;
    inspection.y = *y;
}

std::string known_selectors(const MethodDescription& method) {
    const auto keys = words_of(method.selectors, &SelectorDescription::key);
    return keys.empty() ? "it has none" : "it has " + listed(keys);
}

void parse_choose(const std::string& text, const MethodDescription& method, const Settings& settings,
                  Inspection& inspection) {
    const auto equals = text.find('=');
    if (equals == std::string::npos)
        throw UsageError("--choose '" + text + "' is not of the form selector=item or selector=all");
    const auto key = text.substr(0, equals), item = text.substr(equals + 1);
    const auto selector = std::find_if(method.selectors.begin(), method.selectors.end(),
                                       [&](const auto& known) { return known.key == key; });
    if (selector == method.selectors.end())
        throw UsageError("--choose '" + text + "': method '" + method.id + "' has no selector '" + key +
                         "'; " + known_selectors(method));
    const auto count = count_of(*selector, settings);
    const auto index = parse_index(item);
    if (item != "all" && (!index || *index >= count))
        throw UsageError("--choose '" + text + "': give 0 to " + std::to_string(count - 1) + " or all" +
                         (selector->parameter.empty()
                              ? ""
                              : "; the parameter " + selector->parameter + " is " + std::to_string(count)));
    inspection.chosen[key] = index.value_or(Inspection::all);
}

}  // namespace

Inspection parse_inspection(const InspectionFlags& flags, const engine::Experiment& experiment) {
    Inspection inspection;
    if (!flags.pick.empty()) parse_pick(flags.pick, inspection);
    const auto& method = engine::registry().at(experiment.method);
    if (flags.chooses.empty()) return inspection;
    const auto settings = completed(method.parameters, experiment.settings);
    for (const auto& text : flags.chooses) parse_choose(text, method, settings, inspection);
    return inspection;
}

std::vector<Message> inspection_warnings(const Inspection& inspection, const engine::Experiment& experiment) {
    if (inspection.x < experiment.width && inspection.y < experiment.height) return {};
    const auto pair = [](int a, const char* between, int b) {
        return std::to_string(a) + between + std::to_string(b);
    };
    return {{Severity::warning,
             "render",
             "--pick " + pair(inspection.x, ",", inspection.y) + " lies outside the picture of " +
                 pair(experiment.width, "x", experiment.height) + " pixels: no pixel is explained",
             {}}};
}

}  // namespace ir::cli
