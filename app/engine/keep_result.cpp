#include "app/engine/keep_result.h"

#include <chrono>
#include <ctime>
#include <fstream>

#include "app/engine/version.h"
#include "projects/hash.h"
#include "projects/results.h"
#include "renderers/core/error.h"

namespace ir::engine {
namespace {

std::string utc_now() {
    const auto now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
    char text[32];
    std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", std::gmtime(&now));
    return text;
}

}  // namespace

std::string keep_result(const projects::Project& project, const projects::Experiment& experiment,
                        const std::filesystem::path& folder, const Execution& execution,
                        const FrameReport& report) {
    projects::KeptResult result;
    result.inputs = projects::picture_inputs(project, experiment, registry());
    result.key = projects::result_key(project, experiment, registry());
    result.experiment = experiment.id;
    result.provenance = {version(), report.device, report.backend, utc_now(), {}};
    const auto relative = projects::result_folder(result.key);
    const auto directory = folder / "results" / relative;
    std::error_code error;
    std::filesystem::create_directories(directory, error);
    if (error) throw Error(directory.string() + ": cannot be created (" + error.message() + ")");
    write_exr(directory / "main.exr", execution.layers({}), execution.attributes());
    std::ofstream(directory / "statistics.json") << statistics_json(report) << "\n";
    for (const auto& [role, name] :
         {std::pair{"main", "main.exr"}, std::pair{"statistics", "statistics.json"}})
        result.files.push_back({role, relative + "/" + name, projects::hash_file(directory / name), {}});
    auto index = projects::ResultIndex::load(folder);
    index.put(result);
    index.save(folder);
    return result.key;
}

}  // namespace ir::engine
