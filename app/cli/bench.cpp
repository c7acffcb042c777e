#include <iostream>

#include "app/cli/command.h"
#include "app/cli/run_frames.h"
#include "app/engine/benchmarks.h"
#include "renderers/core/error.h"

namespace ir::cli {

void add_bench(CLI::App& app, Run& run) {
    struct Flags {
        MachineFlags machine;
        std::string name, scene;
        int repeats = 5;
        bool json = false;
    };
    auto flags = std::make_shared<Flags>();
    auto* command = app.add_subcommand("bench", "Benchmarks; without NAME the list of them");
    command->add_option("NAME", flags->name, "Which to run");
    command->add_option("--scene", flags->scene, "Scene instead of the benchmark's own");
    command->add_option("--repeats", flags->repeats, "Runs of which the median counts")
        ->check(CLI::Range(1, 1000));
    command->add_flag("--json", flags->json, "Print one JSON object");
    add_machine_flags(*command, flags->machine);
    command->callback([flags, &run] {
        run = [flags] {
            if (flags->name.empty()) {
                std::cout << engine::benchmark_list(flags->json);
                return static_cast<int>(done);
            }
            engine::Machine machine(machine_options(flags->machine));
            std::cout << engine::run_benchmark(machine, flags->name,
                                               {flags->scene, flags->repeats, flags->json});
            return static_cast<int>(done);
        };
    });
}

}  // namespace ir::cli
