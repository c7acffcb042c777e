#include <iostream>
#include <nlohmann/json.hpp>

#include "app/cli/command.h"
#include "app/engine/execution.h"
#include "app/engine/version.h"
#include "renderers/core/describe.h"
#include "renderers/core/error.h"
#include "renderers/core/resources_path.h"
#include "renderers/gl/program.h"

namespace ir::cli {
namespace {

using Json = nlohmann::ordered_json;

int print(const Json& json, bool as_json) {
    if (as_json) {
        std::cout << json.dump(2) << "\n";
        return done;
    }
    for (const auto& [key, value] : json.items())
        std::cout << key << ": " << (value.is_string() ? value.get<std::string>() : value.dump()) << "\n";
    return done;
}

int print_info(const std::string& backend, bool as_json) {
    const auto context =
        backend.empty() ? gl::Context::create_best() : gl::Context::create(gl::parse_backend(backend));
    const auto& info = context->info();
    Json json{{"version", engine::version()},
              {"commit", engine::commit()},
              {"build", engine::build()},
              {"backend", gl::to_string(info.backend)},
              {"platform", info.platform},
              {"device", info.renderer},
              {"vendor", info.vendor},
              {"opengl", info.version},
              {"glsl", info.glsl_version},
              {"software", info.software},
              {"max_storage_buffer_bytes", info.max_storage_buffer_bytes},
              {"max_texture_size", info.max_texture_size},
              {"max_texture_layers", info.max_texture_layers},
              {"max_compute_invocations", info.max_compute_invocations},
              {"max_compute_shared_bytes", info.max_compute_shared_bytes},
              {"max_storage_buffer_bindings", info.max_storage_buffer_bindings},
              {"data", data_directory().string()}};
    return print(json, as_json);
}

int print_list(bool as_json) {
    Json json = Json::array();
    for (const auto* method : engine::registry().methods()) {
        if (as_json)
            json.push_back({{"id", method->id}, {"title", method->title}, {"version", method->version}});
        else
            std::cout << method->id << "  " << method->title << "\n";
    }
    if (as_json) std::cout << json.dump(2) << "\n";
    return done;
}

}  // namespace

void add_info(CLI::App& app, Run& run) {
    struct Flags {
        std::string backend;
        bool json = false;
    };
    auto flags = std::make_shared<Flags>();
    auto* command = app.add_subcommand("info", "What this build and machine can do");
    command->add_option("--backend", flags->backend, "egl or osmesa");
    add_json_flag(*command, flags->json);
    command->callback([flags, &run] { run = [flags] { return print_info(flags->backend, flags->json); }; });
}

void add_list(CLI::App& app, Run& run) {
    auto json = std::make_shared<bool>(false);
    auto* command = app.add_subcommand("list", "All methods, one line each");
    command->add_flag("--json", *json, "Print one JSON array");
    command->callback([json, &run] { run = [json] { return print_list(*json); }; });
}

void add_describe(CLI::App& app, Run& run) {
    struct Flags {
        std::string method, key;
        bool json = false, markdown = false, glsl = false;
    };
    auto flags = std::make_shared<Flags>();
    auto* command = app.add_subcommand("describe", "A method's parameters and outputs");
    command->add_option("METHOD", flags->method, method_doc)->required();
    auto* key =
        command->add_option("KEY", flags->key, "Key of one parameter, output or selector: only this one");
    auto* formats = command->add_option_group("format");
    formats->add_flag("--json", flags->json, "As JSON");
    formats->add_flag("--markdown", flags->markdown, "As a page of the manual (default)");
    formats->add_flag("--glsl", flags->glsl, "As the block that its shaders see")->excludes(key);
    formats->require_option(0, 1);
    command->callback([flags, &run] {
        run = [flags] {
            const auto& method = engine::registry().at(flags->method);
            const auto& key = flags->key;
            if (flags->json)
                std::cout << (key.empty() ? describe_json(method) : describe_json(method, key)) << "\n";
            else if (flags->glsl)
                std::cout << gl::parameter_glsl(method.parameters, defaults(method.parameters));
            else
                std::cout << (key.empty() ? describe_markdown(method) : describe_markdown(method, key));
            return static_cast<int>(done);
        };
    });
}

}  // namespace ir::cli
