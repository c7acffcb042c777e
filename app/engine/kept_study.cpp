#include "app/engine/kept_study.h"

#include "app/engine/version.h"
#include "projects/hash.h"
#include "projects/keep.h"
#include "projects/object_reader.h"
#include "projects/plots.h"
#include "projects/results.h"
#include "projects/text.h"
#include "renderers/core/error.h"
#include "renderers/core/file_system.h"

namespace ir::engine {
namespace {

using projects::Json;

constexpr int study_schema = 1;
constexpr std::size_t max_bytes = 16u << 20;

}  // namespace

Json inputs_of_picture(const projects::Project& project, const std::string& id) {
    if (const auto* image = find_item(project.images, id))
        return Json::object(
            {{"image", image->content_hash.empty() ? "source " + image->source : image->content_hash}});
    const auto* experiment = find_item(project.experiments, id);
    return experiment ? projects::picture_inputs(project, *experiment, registry()) : Json("missing " + id);
}

Json study_inputs(const projects::Project& project, const projects::ErrorPlot& plot) {
    Json inputs = Json::object({{"over", plot.over}, {"values", plot.values}});
    inputs["reference"] = inputs_of_picture(project, plot.reference);
    inputs["experiments"] = Json::object();
    for (const auto& id : plot.experiments) {
        auto own = inputs_of_picture(project, id);
        // Every point brings its own.
        if (own.is_object() && !plot.values.empty()) {
            own.erase(plot.over);
            if (own.contains("values")) own["values"].erase(plot.over);
        }
        inputs["experiments"][id] = std::move(own);
    }
    return inputs;
}

std::string study_key(const projects::Project& project, const projects::ErrorPlot& plot) {
    return projects::hash_json(study_inputs(project, plot));
}

std::filesystem::path study_file(const std::filesystem::path& folder, const std::string& plot) {
    return folder / "results" / projects::study_path(plot);
}

void keep_study(const projects::Project& project, const projects::ErrorPlot& plot,
                const std::filesystem::path& folder, const ErrorStudy& study, const std::string& name) {
    // The pictures were those of the files as they are, whatever the document recorded.
    const auto now = projects::with_contents(project, projects::read_contents(project, folder));
    Json json{{"schema", study_schema},
              {"key", study_key(now, plot)},
              {"build", version_and_commit()},
              {"date", projects::utc_now()},
              {"inputs", study_inputs(now, plot)}};
    json["study"] = projects::parse_json(study_json(study), plot.id);
    const auto file = study_file(folder, name.empty() ? plot.id : name);
    const projects::ResultsGuard guard(folder);
    auto& files = real_file_system();
    files.create_directories(file.parent_path());
    write_atomically(files, file, projects::pretty_json(json));
}

std::optional<KeptStudy> load_study(const std::filesystem::path& folder, const std::string& plot) {
    const auto file = study_file(folder, plot);
    auto& files = real_file_system();
    std::string text;
    try {
        text = files.read(file, max_bytes);
    } catch (const Error&) {
        if (files.exists(file)) throw;
        return {};  // or no more: a part that was joined meanwhile
    }
    const Json json = projects::parse_json(text, file.string());
    projects::ObjectReader reader(json, file.string(), "");
    KeptStudy kept;
    reader.integer("schema", study_schema, 1, study_schema);
    kept.key = reader.text("key");
    kept.build = reader.text("build");
    kept.date = reader.text("date");
    if (const auto* inputs = reader.take("inputs")) kept.inputs = *inputs;
    const auto* study = reader.take("study");
    if (!study) reader.fail("study", "is missing; run the plot again");
    kept.study = study_from_json(projects::pretty_json(*study), file.string());
    return kept;
}

bool is_stale(const KeptStudy& kept, const projects::Project& project, const projects::ErrorPlot& plot,
              const projects::ContentHashes& contents) {
    return kept.key != study_key(projects::with_contents(project, contents), plot);
}

}  // namespace ir::engine
