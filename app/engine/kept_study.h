#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "app/engine/error_study.h"
#include "projects/document.h"
#include "projects/json.h"
#include "projects/scene_files.h"

namespace ir::engine {

/// picture_inputs of an experiment, or the content of a foreign image; says so where the id names neither.
projects::Json inputs_of_picture(const projects::Project& project, const std::string& id);

/// Everything that the numbers of a plot depend on: what is varied, and picture_inputs of the reference and
/// of all experiments, or the content of a foreign image. Metric, axis, names and notes do not count: all
/// metrics are measured. Reads no file.
projects::Json study_inputs(const projects::Project& project, const projects::ErrorPlot& plot);
/// hash_json of study_inputs.
std::string study_key(const projects::Project& project, const projects::ErrorPlot& plot);

/// results/plots/ID.json
struct KeptStudy {
    std::string key;                                   ///< study_key at the time
    std::string build, date;                           ///< provenance; the device is the study's
    projects::Json inputs = projects::Json::object();  ///< study_inputs at the time: says later what changed
    ErrorStudy study;
};

std::filesystem::path study_file(const std::filesystem::path& folder, const std::string& plot);

/// Writes the study of a plot into the project's results, whole or not at all, by the plot's id or by another
/// name. Throws Error.
void keep_study(const projects::Project& project, const projects::ErrorPlot& plot,
                const std::filesystem::path& folder, const ErrorStudy& study, const std::string& name = {});

/// Nothing where none is kept. Throws InputError with one line for a damaged file.
std::optional<KeptStudy> load_study(const std::filesystem::path& folder, const std::string& plot);

/// Whether the plot would be another one now. With `contents` (OpenProject::contents()) a file that changed
/// on disk counts. Reads no file.
bool is_stale(const KeptStudy& kept, const projects::Project& project, const projects::ErrorPlot& plot,
              const projects::ContentHashes& contents = {});

}  // namespace ir::engine
