#include "app/engine/keep_result.h"

#include "app/engine/version.h"
#include "projects/hash.h"
#include "projects/results.h"
#include "projects/scene_files.h"
#include "projects/text.h"
#include "renderers/core/error.h"

namespace ir::engine {

std::string keep_result(const projects::Project& project, const projects::Experiment& experiment,
                        const std::filesystem::path& folder, const Execution& execution,
                        const FrameReport& report) {
    // The picture is that of the files as they are, whatever the document recorded.
    const auto now = projects::with_contents(project, projects::read_contents(project, folder));
    projects::KeptResult result;
    result.inputs = projects::picture_inputs(now, experiment, registry());
    result.key = projects::result_key(now, experiment, registry());
    result.experiment = experiment.id;
    result.provenance = {version(), report.device, report.backend, projects::utc_now(), {}};
    const auto relative = projects::result_folder(result.key);
    const auto directory = folder / "results" / relative;
    auto& files = projects::real_file_system();
    files.create_directories(directory);
    write_exr(directory / "main.exr", execution.layers({}), execution.attributes());
    projects::write_atomically(files, directory / "statistics.json", statistics_json(report) + "\n");
    for (const auto& [role, name] :
         {std::pair{"main", "main.exr"}, std::pair{"statistics", "statistics.json"}})
        result.files.push_back({role, relative + "/" + name, projects::hash_file(directory / name), {}});
    auto index = projects::ResultIndex::load(folder);
    index.put(result);
    index.save(folder);
    return result.key;
}

}  // namespace ir::engine
