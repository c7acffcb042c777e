#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "app/cli/command.h"
#include "app/engine/told_by.h"
#include "renderers/core/error.h"

namespace ir::cli {
namespace {

using Json = nlohmann::ordered_json;

/// Throws InputError where the file says nothing.
std::map<std::string, Json> told_by(const std::string& file) {
    auto told = engine::told_by(read_exr_attributes(file), file);
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
