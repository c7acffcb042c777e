#include <algorithm>
#include <charconv>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>

#include "app/cli/complain.h"
#include "app/cli/load_project.h"
#include "app/cli/output_files.h"
#include "app/cli/render_project.h"
#include "app/cli/run_frames.h"
#include "projects/sweep.h"
#include "projects/text.h"
#include "renderers/core/error.h"
#include "renderers/core/write_file.h"

namespace ir::cli {
namespace {

using Json = nlohmann::ordered_json;

struct SweepFlags {
    ProjectRender job;
    std::string name, shard;
    bool quiet = false;
};

const projects::Sweep& chosen_sweep(const projects::Project& project, const std::string& name) {
    if (const auto* sweep = find_item(project.sweeps, name)) return *sweep;
    for (const auto& sweep : project.sweeps)
        if (sweep.name == name) return sweep;
    throw UsageError("no sweep '" + name + "' in the project" +
                     known_are(name, words_of(project.sweeps, &projects::Sweep::id)));
}

struct Shard {
    int index = 1, count = 1;
};

Shard parse_shard(const std::string& text) {
    Shard shard;
    if (text.empty()) return shard;
    const auto* end = text.data() + text.size();
    const auto first = std::from_chars(text.data(), end, shard.index);
    const bool has_count = first.ec == std::errc{} && first.ptr != end && *first.ptr == '/';
    const auto second = has_count ? std::from_chars(first.ptr + 1, end, shard.count) : first;
    if (!has_count || second.ec != std::errc{} || second.ptr != end || shard.index < 1 ||
        shard.index > shard.count)
        throw UsageError("--shard '" + text + "': give I/N with I from 1 to N, as in 1/4");
    return shard;
}

/// "sweep.json", or "sweep-2-of-4.json", so that shards may share a folder.
std::string list_name(const Shard& shard) {
    if (shard.count == 1) return "sweep.json";
    return "sweep-" + std::to_string(shard.index) + "-of-" + std::to_string(shard.count) + ".json";
}

Json entry_of(const projects::SweepPoint& point) {
    return {{"id", point.experiment.id}, {"coordinates", point.coordinates}};
}

/// Renders one point; what went wrong stands in its entry.
Json render_point(const SweepFlags& flags, engine::Machine& machine, const projects::LoadedProject& loaded,
                  const projects::SweepPoint& point, ProgressLine& line, int& status) {
    auto entry = entry_of(point);
    try {
        const auto statistics =
            render_one(flags.job, machine, loaded.project, point.experiment, loaded.folder, line);
        entry["image"] = point.experiment.id + ".exr";
        entry["wall_ms"] = Json::parse(statistics).at("wall_ms");
    } catch (const Error& error) {
        line.clear();
        complain(point.experiment.id + ": " + error.what());
        entry["problem"] = projects::printable(error.what(), 4096);
        status = std::max(status, status_of(error));
    }
    return entry;
}

/// The file that says what became of each variation. It is there from the beginning, so that it tells what is
/// not rendered yet however the sweep ends.
class SweepList {
  public:
    SweepList(std::filesystem::path file, Json head, const std::vector<projects::SweepPoint>& points)
        : file_(std::move(file)), list_(std::move(head)) {
        list_["points"] = Json::array();
        for (const auto& point : points) {
            auto entry = entry_of(point);
            entry["problem"] = "not rendered yet";
            list_["points"].push_back(std::move(entry));
        }
        write();
    }

    const std::filesystem::path& file() const { return file_; }
    std::string text() const { return list_.dump(2) + "\n"; }
    /// How many were rendered.
    std::size_t done() const { return done_; }

    void put(std::size_t point, Json entry) {
        done_ += entry.contains("image") ? 1 : 0;
        list_["points"][point] = std::move(entry);
        if (Clock::now() - written_ > std::chrono::seconds(1)) write();
    }
    void write() {
        write_file(file_, text());
        written_ = Clock::now();
    }

  private:
    using Clock = std::chrono::steady_clock;
    std::filesystem::path file_;
    Json list_;
    Clock::time_point written_;
    std::size_t done_ = 0;
};

int run_sweep(const SweepFlags& flags) {
    const auto shard = parse_shard(flags.shard);
    const auto loaded = load_project(flags.job.project);
    const auto& sweep = chosen_sweep(loaded.project, flags.name);
    std::vector<projects::SweepPoint> points;
    try {
        points = projects::sweep_points(loaded.project, sweep, engine::registry());
    } catch (const UsageError& error) {  // the project says it, not the command line
        throw InputError(flags.job.project, "", error.what());
    }
    points = projects::shard(points, shard.index, shard.count);
    OutputFiles files;
    files.reads(loaded);
    files.writes("--out", (std::filesystem::path(flags.job.out) / list_name(shard)).string());
    files.writes("--json", flags.job.json);
    make_out_folder(flags.job.out);
    engine::Machine machine(machine_options(flags.job.machine));
    SweepList list(std::filesystem::path(flags.job.out) / list_name(shard),
                   {{"sweep", sweep.id},
                    {"experiment", sweep.experiment},
                    {"shard", shard.index},
                    {"shards", shard.count}},
                   points);
    int status = done;
    double frames = 0;
    for (const auto& point : points) frames += frames_of(point.experiment);
    ProgressLine line(flags.job.show_progress, frames);
    try {
        for (std::size_t i = 0; i < points.size(); ++i)
            list.put(i, render_point(flags, machine, loaded, points[i], line, status));
    } catch (const Cancelled&) {
        list.write();
        std::cerr << "interreflect-cli: rendered " << list.done() << " of " << points.size()
                  << " variations; " << list.file().string() << " lists which\n";
        throw;
    }
    list.write();
    if (flags.job.json == "-")
        std::cout << list.text();
    else if (!flags.job.json.empty())
        write_file(flags.job.json, list.text());
    return status;
}

}  // namespace

void add_sweep(CLI::App& app, Run& run) {
    auto flags = std::make_shared<SweepFlags>();
    auto& job = flags->job;
    auto* command = app.add_subcommand("sweep", "Render all variations of a project's sweep");
    command->add_option("PROJECT", job.project, "Project folder")->required();
    command->add_option("NAME", flags->name, "Id or name of the sweep")->required();
    command->add_option("--out", job.out, "Folder for ID-0001.exr, … and the list sweep.json")->required();
    command->add_option("--shard", flags->shard, "I/N: only every N-th variation, beginning with the I-th");
    command->add_option("--dump", job.dumps, "Pattern of buffers to write as layers, such as 'gbuffer.*'");
    command->add_option("--json", job.json, "File for the list, too; - or nothing: standard output")
        ->expected(0, 1)
        ->default_str("-");
    add_quiet_flag(*command, flags->quiet);
    add_machine_flags(*command, job.machine);
    command->callback([flags, command, &run] {
        if (command->count("--json") && flags->job.json.empty()) flags->job.json = "-";
        flags->job.show_progress = !flags->quiet;
        run = [flags] { return run_sweep(*flags); };
    });
}

}  // namespace ir::cli
