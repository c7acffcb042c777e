#pragma once

#include <functional>
#include <optional>

#include "app/engine/analysis/analysis.h"
#include "projects/scene_files.h"

namespace ir::engine {

/// Everything that an answer depends on: the question, and what each picture depends on. Reads no file.
projects::Json analysis_inputs(const projects::Project& project, const projects::Analysis& analysis);

/// An answer as a project keeps it, in results/analyses/ID.
struct KeptAnalysis {
    std::string key;          ///< hash_json of analysis_inputs at the time
    std::string build, date;  ///< provenance; the device is the result's
    std::string kind;
    AnalysisResult result;
};

std::filesystem::path analysis_folder(const std::filesystem::path& project, const std::string& analysis);

/// Writes the answer into a folder, which is made where it is missing: the pictures, then the file that names
/// them. Throws Error.
void write_analysis(const projects::Project& project, const projects::Analysis& analysis,
                    const std::filesystem::path& folder, const AnalysisResult& result,
                    const std::filesystem::path& out);
/// The same into the project's results, whose guard it takes.
void keep_analysis(const projects::Project& project, const projects::Analysis& analysis,
                   const std::filesystem::path& folder, const AnalysisResult& result);

/// Nothing where none is there; without `has_pictures` their pixels stay in the file. Throws InputError with
/// one line for a damaged file.
std::optional<KeptAnalysis> load_analysis(const std::filesystem::path& out, bool has_pictures = true);

/// Whether the answer would be another one now. With `contents` (OpenProject::contents()) a file that changed
/// on disk counts. Reads no file.
bool is_stale(const KeptAnalysis& kept, const projects::Project& project, const projects::Analysis& analysis,
              const projects::ContentHashes& contents = {});

/// An analysis that a machine of its own carries out.
struct AnalysisRequest {
    projects::Project project;
    projects::Analysis analysis;
    std::filesystem::path folder;  ///< of the project
    MachineOptions machine = {};
    std::uint64_t memory_budget = 0;  ///< bytes; 0: none
    bool keeps = false;               ///< in the project's results
};
using AnalysisRunner = std::function<AnalysisResult(const AnalysisRequest&, const AnalysisCallbacks&)>;
/// Throws as run_analysis() and keep_analysis().
AnalysisResult run_analysis_request(const AnalysisRequest& request, const AnalysisCallbacks& callbacks);

}  // namespace ir::engine
