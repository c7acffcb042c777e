#include <filesystem>
#include <iostream>

#include "app/cli/command.h"
#include "app/engine/execution.h"
#include "projects/schema.h"
#include "renderers/core/file_system.h"
#include "renderers/core/resources_path.h"

namespace ir::cli {
namespace {

/// That of projects is made of tables; the others are files, as their writers have no tables.
const std::vector<std::string> names{"project", "statistics", "sweep", "compare", "scene"};

int print_schema(const std::string& name) {
    constexpr std::size_t max_bytes = 1 << 20;
    if (name == names.front())
        std::cout << projects::project_schema(engine::registry()).dump(2) << "\n";
    else
        std::cout << real_file_system().read(data_directory() / "schemas" / (name + ".schema.json"),
                                             max_bytes);
    return done;
}

}  // namespace

void add_schema(CLI::App& app, Run& run) {
    auto name = std::make_shared<std::string>();
    auto* command = app.add_subcommand("schema", "JSON Schema of what is read and written");
    command->add_option("NAME", *name, "project, statistics (of render), sweep, compare or scene")
        ->required()
        ->check(CLI::IsMember(names));
    command->callback([name, &run] { run = [name] { return print_schema(*name); }; });
}

}  // namespace ir::cli
