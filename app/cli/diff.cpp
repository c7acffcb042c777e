#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "app/cli/command.h"
#include "app/engine/pictures.h"
#include "projects/json.h"
#include "renderers/core/error.h"

namespace ir::cli {
namespace {

using Json = nlohmann::ordered_json;

/// All that a file says of its picture, by place.
std::map<std::string, Json> told_by(const std::string& file) {
    std::map<std::string, Json> told;
    for (const auto& [key, value] : read_exr_attributes(file)) {
        if (!key.starts_with(engine::attribute_prefix)) continue;
        if (key != engine::recipe_attribute) {
            told[key.substr(engine::attribute_prefix.size())] = value;
            continue;
        }
        const auto recipe = projects::parse_json(value, file);
        // The other lists repeat what attributes tell one by one.
        for (const char* list : {"scenes", "lights", "motion"})
            if (const auto found = recipe.find(list); found != recipe.end()) {
                const auto leaves = found->flatten();
                for (const auto& [place, leaf] : leaves.items()) told[list + place] = leaf;
            }
    }
    if (told.empty()) throw InputError(file, "", "does not say how it was rendered");
    return told;
}

Json differences(const std::map<std::string, Json>& a, const std::map<std::string, Json>& b) {
    std::set<std::string> keys;
    for (const auto* side : {&a, &b})
        for (const auto& [key, value] : *side) keys.insert(key);
    const auto value = [](const auto& side, const std::string& key) {
        const auto found = side.find(key);
        return found == side.end() ? Json() : found->second;
    };
    Json list = Json::array();
    for (const auto& key : keys)
        if (const auto x = value(a, key), y = value(b, key); x != y)
            list.push_back({{"what", key}, {"a", x}, {"b", y}});
    return list;
}

int print_diff(const std::string& a, const std::string& b, bool as_json) {
    const auto list = differences(told_by(a), told_by(b));
    if (as_json) {
        std::cout << list.dump(2) << "\n";
        return done;
    }
    const auto text = [](const Json& value) {
        if (value.is_null()) return std::string("absent");
        return value.is_string() ? value.get<std::string>() : value.dump();
    };
    for (const auto& each : list)
        std::cout << each["what"].get<std::string>() << ": " << text(each["a"]) << " | " << text(each["b"])
                  << "\n";
    if (list.empty()) std::cout << "nothing differs\n";
    return done;
}

}  // namespace

void add_diff(CLI::App& app, Run& run) {
    struct Flags {
        std::string a, b;
        bool json = false;
    };
    auto flags = std::make_shared<Flags>();
    auto* command = app.add_subcommand("diff", "In which settings two pictures differ");
    command->add_option("A", flags->a, "EXR file")->required();
    command->add_option("B", flags->b, "EXR file")->required();
    command->add_flag("--json", flags->json, "Print one JSON array");
    command->callback(
        [flags, &run] { run = [flags] { return print_diff(flags->a, flags->b, flags->json); }; });
}

}  // namespace ir::cli
