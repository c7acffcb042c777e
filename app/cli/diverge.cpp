// `interreflect-cli diverge`: the first buffer that two machines make differently.
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>

#include "app/cli/command.h"
#include "app/cli/experiment_flags.h"
#include "app/cli/progress_line.h"
#include "app/cli/run_frames.h"
#include "app/cli/text_table.h"
#include "app/engine/divergence.h"
#include "app/engine/from_project.h"
#include "renderers/core/error.h"

namespace ir::cli {
namespace {

using Json = nlohmann::ordered_json;
using engine::BufferDivergence, engine::Divergence;

struct DivergeFlags {
    MachineFlags machine;
    ExperimentFlags experiment;
    engine::SameWithin same;
    std::string method, scene = "builtin:cornell", a = "gl", b = "host";
    bool all = false, json = false, quiet = false;
};

/// "host", "osmesa+gl": backend and processor in place of those of the other options.
engine::MachineOptions side_of(const MachineFlags& flags, const std::string& option,
                               const std::string& text) {
    try {
        return engine::machine_called(text, machine_options(flags));
    } catch (const UsageError& error) {
        throw UsageError(option + " " + error.what());
    }
}

std::string short_number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    return text;
}

std::string buffers_text(std::size_t count, const std::string& one, const std::string& many) {
    return std::to_string(count) + (count == 1 ? " buffer " + one : " buffers " + many);
}

/// Buffers that are the same to the bit are counted, as most are.
void print(const Divergence& found, bool all) {
    std::cout << "A: " << found.a << "\nB: " << found.b << "\n";
    std::size_t same = 0, missing = 0;
    std::vector<std::vector<std::string>> rows{
        {"buffer", "written by", "values", "differ", "by at most", ""}};
    for (const auto& each : found.buffers) {
        const bool has_numbers = each.values > 0;
        same += each.is_same() ? 1 : 0;
        missing += has_numbers || each.diverges || each.problem.empty() ? 0 : 1;
        if (each.is_same() && !all) continue;
        const auto said = each.diverges && each.problem.empty() ? std::string("diverges") : each.problem;
        rows.push_back({each.key, each.pass, has_numbers ? std::to_string(each.values) : "",
                        has_numbers ? std::to_string(each.differing) : "",
                        has_numbers ? short_number(each.largest) : "", said});
    }
    print_table(std::cout, rows, {2, 3, 4});
    if (same > 0) std::cout << buffers_text(same, "is", "are") << " the same to the bit\n";
    if (missing > 0)
        std::cout << buffers_text(missing, "is", "are")
                  << " of one machine alone and compared with nothing\n";
    if (const auto* first = found.first())
        std::cout << "the first that diverges is " << first->key << ", which pass '" << first->pass
                  << "' writes\n";
    else
        std::cout << "no buffer that both have diverges\n";
}

Json to_json(const Divergence& found) {
    Json json{{"a", found.a}, {"b", found.b}, {"first", nullptr}, {"buffers", Json::array()}};
    if (const auto* first = found.first()) json["first"] = first->key;
    for (const auto& each : found.buffers) {
        Json one{{"key", each.key}, {"pass", each.pass}};
        one["diverges"] = each.diverges;
        if (!each.problem.empty()) one["problem"] = each.problem;
        if (each.values > 0)
            one.update({{"values", each.values},
                        {"differing", each.differing},
                        {"largest", std::isfinite(each.largest) ? Json(each.largest) : Json()}});
        json["buffers"].push_back(std::move(one));
    }
    return json;
}

int diverge(const DivergeFlags& flags) {
    const auto a = side_of(flags.machine, "--a", flags.a), b = side_of(flags.machine, "--b", flags.b);
    auto project = engine::project_of(flags.scene, flags.method);
    apply(flags.experiment, project, project.experiments.front());
    auto options = frame_options(flags.machine);
    ProgressLine line(!flags.quiet, 2);
    options.progress = line.callback();
    const auto found = under_progress(line, "", [&] {
        return engine::find_divergence(engine::from_single(project), a, b, options, flags.same,
                                       [&](const std::string& name) { line.begin(name, 1); });
    });
    if (flags.json)
        std::cout << to_json(found).dump(2) << "\n";
    else
        print(found, flags.all);
    return found.first() ? limit_exceeded : done;
}

}  // namespace

void add_diverge(CLI::App& app, Run& run) {
    auto flags = std::make_shared<DivergeFlags>();
    auto* command = app.add_subcommand(
        "diverge", "Render on two processors or drivers and name the first buffer that differs");
    command->add_option("METHOD", flags->method, method_doc)->required();
    command->add_option("--scene", flags->scene, "A .gltf or .glb file, or builtin:NAME")
        ->capture_default_str();
    command->add_option("--a", flags->a, projects::machine_words)->capture_default_str();
    command->add_option("--b", flags->b, "The other one")->capture_default_str();
    command
        ->add_option("--tolerance", flags->same.relative,
                     "Relative difference up to which numbers are the same")
        ->check(within(0, 1))
        ->capture_default_str();
    command
        ->add_option("--absolute", flags->same.absolute,
                     "Difference up to which numbers are the same, whatever their size")
        ->check(within(0, 1e9))
        ->capture_default_str();
    command
        ->add_option("--share", flags->same.share,
                     "Part of a buffer's values that may differ by more: edges that rays meet or miss")
        ->check(within(0, 1))
        ->capture_default_str();
    command->add_flag("--all", flags->all, "List the buffers that are the same to the bit, too");
    add_experiment_flags(*command, flags->experiment);
    add_json_flag(*command, flags->json);
    add_quiet_flag(*command, flags->quiet);
    add_machine_flags(*command, flags->machine);
    command->callback([flags, &run] { run = [flags] { return diverge(*flags); }; });
}

}  // namespace ir::cli
