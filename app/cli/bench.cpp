#include <iostream>

#include "app/cli/command.h"
#include "app/cli/run_frames.h"
#include "app/engine/benchmarks.h"
#include "projects/light_spec.h"
#include "renderers/core/error.h"

namespace ir::cli {

void add_bench(CLI::App& app, Run& run) {
    struct Flags {
        MachineFlags machine;
        std::string name, scene, eye, target;
        int repeats = 5;
        bool json = false;
    };
    auto flags = std::make_shared<Flags>();
    auto* command = app.add_subcommand("bench", "Benchmarks; without NAME the list of them");
    command->add_option("NAME", flags->name, "Which to run");
    command->add_option("--scene", flags->scene, "Scene instead of the benchmark's own");
    command->add_option("--eye", flags->eye, "Camera position x,y,z in metres");
    command->add_option("--target", flags->target, "Point that the camera looks at, x,y,z");
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
            std::optional<scene::Camera> camera;
            if (!flags->eye.empty() || !flags->target.empty()) {
                camera.emplace();
                camera->eye = projects::parse_vec3(flags->eye, "--eye");
                camera->target = projects::parse_vec3(flags->target, "--target");
            }
            engine::Machine machine(machine_options(flags->machine));
            std::cout << engine::run_benchmark(machine, flags->name,
                                               {flags->scene, camera, flags->repeats, flags->json});
            return static_cast<int>(done);
        };
    });
}

}  // namespace ir::cli
