#include "app/engine/keep_result.h"

#include <algorithm>

#include "app/engine/pictures.h"
#include "app/engine/version.h"
#include "projects/hash.h"
#include "projects/keep.h"
#include "projects/samples.h"
#include "projects/scene_files.h"
#include "projects/text.h"
#include "renderers/core/error.h"

namespace ir::engine {
namespace {

namespace fs = std::filesystem;
using projects::KeptResult;

/// What a picture is, whatever was asked for.
KeptResult describe(const projects::Project& now, const projects::Experiment& experiment,
                    const Execution& execution, const FrameReport& report) {
    const auto samples = execution.samples();
    const auto requested = projects::sample_count(experiment, registry());
    const auto rendered =
        samples == requested ? experiment : projects::with_sample_count(experiment, samples, registry());
    KeptResult result;
    result.inputs = projects::picture_inputs(now, rendered, registry());
    result.key = projects::result_key(now, samples < requested ? rendered : experiment, registry());
    result.experiment = experiment.id;
    result.provenance = {version_and_commit(), report.device, report.backend, projects::utc_now(), {},
                         report.processor};
    // Where the scene moves, more frames are a later picture, not a better one.
    if (projects::accumulates(execution.method()) && !execution.scene().is_animated()) {
        result.state_key = projects::state_key(now, experiment, registry());
        result.samples = samples;
    }
    if (!execution.origins().empty())
        result.provenance.extra["resumed_from"] =
            projects::parse_json(to_json_text(execution.origins()), "origins");
    return result;
}

/// The kept result whose picture this is, restored and not extended; null where it is new.
const KeptResult* same_picture(const projects::ResultIndex& index, const KeptResult& result,
                               const Execution& execution) {
    if (execution.is_extended() || execution.origins().empty()) return nullptr;
    const auto* kept = index.find_state(result.state_key);
    return kept && kept->samples == result.samples ? kept : nullptr;
}

bool is_intact(const projects::ResultFile& file, const fs::path& results) {
    std::error_code ignored;
    return fs::is_regular_file(results / file.path, ignored) &&
           (file.content_hash.empty() || projects::hash_file(results / file.path) == file.content_hash);
}

/// Whether a state with as many samples is kept and can be read.
bool has_larger_state(const projects::ResultIndex& index, const KeptResult& result, const fs::path& results) {
    const auto* kept = index.find_state(result.state_key);
    return kept && kept->key != result.key && kept->samples >= result.samples &&
           is_intact(*projects::file_of(*kept, projects::state_role), results);
}

void add_file(KeptResult& result, const char* role, const fs::path& results, const std::string& path) {
    result.files.push_back({role, path, projects::hash_file(results / path), {}});
}

void write_files(KeptResult& result, const Execution& execution, const FrameReport& report,
                 const fs::path& results, bool with_state) {
    auto& files = real_file_system();
    const auto relative = projects::result_folder(result.key);
    files.create_directories(results / relative);
    const auto& variance = execution.method().variance;
    const auto attributes = engine::attributes(execution);
    write_exr(files, results / relative / "main.exr",
              layers(execution, variance.empty() ? std::vector<std::string>() : std::vector{variance}),
              attributes);
    add_file(result, projects::main_role, results, relative + "/main.exr");
    write_atomically(files, results / relative / "statistics.json",
                     statistics_json(execution, report) + "\n");
    add_file(result, projects::statistics_role, results, relative + "/statistics.json");
    const auto state = with_state ? execution.state() : std::nullopt;
    if (!state) return;
    store(results / relative / "state.exr", *state, attributes);
    add_file(result, projects::state_role, results, relative + "/state.exr");
}

}  // namespace

std::string keep_result(const projects::Project& project, const projects::Experiment& experiment,
                        const fs::path& folder, const Execution& execution, const FrameReport& report) {
    // The picture is that of the files as they are, whatever the document recorded.
    const auto now = projects::with_contents(project, projects::read_contents(project, folder));
    auto result = describe(now, experiment, execution, report);
    const auto results = folder / "results";
    const projects::ResultsGuard guard(folder);
    const auto index = projects::ResultIndex::load(folder);
    if (const auto* kept = same_picture(index, result, execution)) {
        const bool is_same = kept->key == result.key;
        if (is_same && index.last_kept()[experiment.id] == result.key) return result.key;
        result.provenance = kept->provenance;
        for (const auto& file : kept->files)
            if (is_same || file.role != projects::state_role) result.files.push_back(file);
    } else {
        write_files(result, execution, report, results, !has_larger_state(index, result, results));
    }
    const auto key = result.key;
    auto in_use = projects::keys_in_use(index, experiment.id, folder, registry());
    in_use.insert(projects::result_key(now, experiment, registry()));
    projects::keep(folder, std::move(result), in_use, guard);
    return key;
}

std::vector<std::string> resume_kept(Execution& execution, const projects::Project& project,
                                     const projects::Experiment& experiment, const fs::path& folder) {
    std::vector<std::string> problems;
    if (!projects::accumulates(execution.method())) return problems;
    const auto now = projects::with_contents(project, projects::read_contents(project, folder));
    const auto key = projects::state_key(now, experiment, registry());
    auto entries = projects::ResultIndex::load(folder).entries();
    std::erase_if(entries, [&](const KeptResult& entry) {
        return entry.state_key != key || !projects::file_of(entry, projects::state_role);
    });
    std::stable_sort(entries.begin(), entries.end(),
                     [](const auto& a, const auto& b) { return a.samples > b.samples; });
    for (const auto& entry : entries) {
        const auto file = folder / "results" / projects::file_of(entry, projects::state_role)->path;
        try {
            execution.restore(load_state(file));
            break;
        } catch (const Error& error) {
            problems.push_back(std::string("a kept state is not continued: ") + error.what());
        }
    }
    return problems;
}

}  // namespace ir::engine
