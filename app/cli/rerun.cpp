#include <cmath>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <set>

#include "app/cli/command.h"
#include "app/cli/experiment_flags.h"
#include "app/cli/output_files.h"
#include "app/cli/progress_line.h"
#include "app/cli/run_frames.h"
#include "app/engine/from_project.h"
#include "app/engine/number_text.h"
#include "app/engine/pictures.h"
#include "app/engine/run_frames.h"
#include "app/engine/version.h"
#include "projects/check.h"
#include "projects/document_json.h"
#include "projects/scene_files.h"
#include "projects/text.h"
#include "renderers/core/error.h"
#include "renderers/core/words.h"
#include "renderers/image/metrics.h"

namespace ir::cli {
namespace {

using Json = nlohmann::ordered_json;

struct RerunFlags {
    MachineFlags machine;
    ExperimentFlags changes;
    std::string file, scene, environment, out;
    bool json = false, quiet = false, is_exact = false;
};

/// A picture's file and the project in it.
struct Original {
    Image picture;
    ImageAttributes attributes;
    std::vector<std::string> dumps;  ///< keys of its other layers
    projects::Project project;
    projects::Experiment& experiment() { return project.experiments.front(); }
    std::string attribute(const std::string& name) const {
        const auto found = attributes.find(engine::attribute_prefix + name);
        return found == attributes.end() ? std::string() : found->second;
    }
};

/// "ldm.depth" of the layer "ldm.depth.level1.layer3".
std::string key_of_layer(std::string name) {
    for (const char* part : {".layer", ".level"}) {
        const auto at = name.rfind(part);
        const auto number = at == std::string::npos ? at : at + std::string_view(part).size();
        if (number < name.size() && name.find_first_not_of("0123456789", number) == std::string::npos)
            name.resize(at);
    }
    return name;
}

Original read_original(const std::string& file) {
    Original original;
    std::set<std::string> dumps;
    for (auto& layer : read_exr(file, &original.attributes)) {
        if (layer.name.empty())
            original.picture = std::move(layer.image);
        else
            dumps.insert(key_of_layer(layer.name));
    }
    original.dumps.assign(dumps.begin(), dumps.end());
    const auto recipe = original.attributes.find(engine::recipe_attribute);
    if (recipe == original.attributes.end())
        throw InputError(file, "",
                         "does not say how it was rendered; that is in .exr files that `render` writes since "
                         "version 0.2");
    original.project = projects::read_project(recipe->second, file, engine::registry()).project;
    if (original.project.experiments.size() != 1)
        throw InputError(file, engine::recipe_attribute, "must hold one experiment");
    // A picture may come from anybody; what --shader-diff changes does not.
    original.project.shaders_allowed = original.experiment().shaders.empty();
    return original;
}

/// The scene's file where it lies today.
void move_files(const RerunFlags& flags, Original& original) {
    if (!flags.scene.empty()) {
        auto* scene = find_item(original.project.scenes, original.experiment().scene);
        if (!scene || scene->parts.size() != 1)
            throw UsageError("--scene cannot be used: the scene of " + flags.file + " has several files");
        scene->parts.front().source = flags.scene;
    }
    if (!flags.environment.empty()) {
        auto* lights = find_item(original.project.lights, original.experiment().lights);
        if (!lights || lights->environment.kind != projects::Environment::Kind::map)
            throw UsageError("--env cannot be used: " + flags.file + " has no environment map");
        lights->environment.source = flags.environment;
    }
    projects::for_each_file(original.project, [&](const std::string& source, const std::string&) {
        if (!projects::is_builtin(source) && !std::filesystem::exists(source))
            throw InputError(flags.file, "",
                             "was rendered from " + source +
                                 ", which is not there; --scene and --env say where it is now");
    });
}

/// In what today's run is not that of the file, though nobody asked for it.
Json differences(const Original& original, const ImageAttributes& now) {
    Json list = Json::array();
    for (const char* what : {"version", "commit", "build", "method_version", "scene_hash", "lighting",
                             "backend", "device", "processor", "shader_folder"}) {
        const auto then = original.attribute(what);
        const auto found = now.find(engine::attribute_prefix + what);
        const auto today = found == now.end() ? std::string() : found->second;
        if (then != today) list.push_back({{"what", what}, {"then", then}, {"now", today}});
    }
    return list;
}

struct Distance {
    std::size_t pixels = 0, differ = 0;
    double largest = 0;  ///< infinite where only one of two values is a number
};

/// Of all channels. Values that are no numbers are equal where both are.
Distance distance(const Image& a, const Image& b) {
    Distance result;
    result.pixels = std::size_t(a.width) * std::size_t(a.height);
    for (std::size_t pixel = 0; pixel < result.pixels; ++pixel) {
        bool is_equal = true;
        for (int c = 0; c < a.channels; ++c) {
            const auto i = pixel * std::size_t(a.channels) + std::size_t(c);
            const float x = a.pixels[i], y = b.pixels[i];
            if (x == y || (std::isnan(x) && std::isnan(y))) continue;
            is_equal = false;
            const double d = std::abs(double(x) - double(y));
            result.largest = std::max(result.largest, std::isnan(d) ? HUGE_VAL : d);
        }
        result.differ += !is_equal;
    }
    return result;
}

int rerun(const RerunFlags& flags) {
    auto original = read_original(flags.file);
    OutputFiles files;
    files.reads("FILE", flags.file);
    files.reads("--scene", flags.scene);
    files.reads("--env", flags.environment);
    files.writes("--out", flags.out);
    const auto dumps =
        std::filesystem::path(flags.out).extension() == ".png" ? std::vector<std::string>() : original.dumps;
    if (!flags.out.empty()) require_picture(flags.out, dumps);
    move_files(flags, original);
    apply(flags.changes, original.project, original.experiment());
    if (!projects::why_shaders_wait(original.project, original.experiment()).empty())
        throw InputError(
            flags.file, "",
            "was rendered with changed shaders (" +
                projects::printable(
                    listed(words_of(original.experiment().shaders, &ShaderChanges::value_type::first)), 300) +
                "), and a picture may come from anybody; give --allow-shaders if it is yours, or "
                "if you trust who made it");
    engine::Machine machine(machine_options(flags.machine));
    engine::Execution execution(machine, engine::from_project(original.project, original.experiment(), {}));
    auto options = frame_options(flags.machine, dumps);
    ProgressLine line(!flags.quiet, 1);
    line.begin({}, 1);
    options.progress = line.callback();
    const auto report =
        under_progress(line, flags.out, [&] { return engine::run_frames(execution, options); });
    if (!flags.out.empty()) engine::write_picture(flags.out, execution, dumps);
    print_messages(execution, report);

    const auto layers = engine::layers(execution, {});
    const auto& picture = layers.front().image;  // as files have it
    const bool is_comparable = picture.width == original.picture.width &&
                               picture.height == original.picture.height &&
                               picture.channels == original.picture.channels;
    Json json{{"file", flags.file}, {"different", differences(original, engine::attributes(execution))}};
    const auto apart = is_comparable ? distance(picture, original.picture) : Distance{};
    const double rmse =
        is_comparable ? compute_metrics(picture, original.picture, {"rmse"}).values.at("rmse") : 0;
    if (is_comparable) {
        json["pixels"] = apart.pixels;
        json["pixels_that_differ"] = apart.differ;
        json["largest_difference"] = engine::number_json(apart.largest);
        json["rmse"] = engine::number_json(rmse);
    }
    if (flags.json) {
        std::cout << json.dump(2) << "\n";
    } else {
        for (const auto& each : json["different"])
            std::cout << "different " << each["what"].get<std::string>() << ": "
                      << each["then"].get<std::string>() << ", now " << each["now"].get<std::string>()
                      << "\n";
        if (!is_comparable)
            std::cout << "the pictures have different sizes\n";
        else if (apart.differ == 0)
            std::cout << "all " << apart.pixels << " pixels are the same, bit for bit\n";
        else
            std::cout << apart.differ << " of " << apart.pixels << " pixels differ, by " << apart.largest
                      << " at most, RMSE " << rmse << "\n";
    }
    return flags.is_exact && (!is_comparable || apart.differ > 0) ? limit_exceeded : done;
}

}  // namespace

void add_rerun(CLI::App& app, Run& run) {
    auto flags = std::make_shared<RerunFlags>();
    auto* command = app.add_subcommand(
        "rerun", "Render a picture again by what its file says, and measure how far apart they are");
    command->add_option("FILE", flags->file, "EXR file of `render`, `sweep` or the window")->required();
    command->add_option("--scene", flags->scene, "Where the scene's file is now");
    command->add_option("--env", flags->environment, "Where the environment map is now");
    add_experiment_flags(*command, flags->changes);
    command->add_option("--out", flags->out,
                        "File.exr with the layers that FILE has, or .png (default: nothing is written)");
    command->add_flag("--exact", flags->is_exact, "Exit with status 4 unless all pixels are the same");
    add_json_flag(*command, flags->json);
    add_quiet_flag(*command, flags->quiet);
    add_machine_flags(*command, flags->machine);
    command->callback([flags, &run] { run = [flags] { return rerun(*flags); }; });
}

}  // namespace ir::cli
