#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "projects/document.h"
#include "projects/scene_files.h"
#include "renderers/core/file_system.h"
#include "renderers/core/method.h"
#include "renderers/core/progress.h"
#include "renderers/core/report.h"

namespace ir::projects {

/// Everything that the picture of an experiment depends on, as JSON: content of the scene, camera, lights and
/// parts at its time, and how they move where its frames are of several moments; lights, environment, method
/// and version, all effective values, changes of shaders, size, seed, frames, time. Ids, names, notes and
/// paths of files whose hash is known do not count.
Json picture_inputs(const Project& project, const Experiment& experiment, const Registry& registry);
/// What of these a picture of one moment sees, at `time` (seconds): scene, camera, lights, environment, size.
Json moment_inputs(const Project& project, const Experiment& experiment, double time);
/// hash_json of picture_inputs.
std::string result_key(const Project& project, const Experiment& experiment, const Registry& registry);

/// What a stored state (graph::History) depends on: picture_inputs without `frames` and without the values of
/// parameters that accumulate. Experiments with equal state keys are one picture at several numbers of
/// samples (samples.h).
Json state_inputs(const Project& project, const Experiment& experiment, const Registry& registry);
std::string state_key(const Project& project, const Experiment& experiment, const Registry& registry);

enum class ResultState { none, current, stale };
/// By the experiment's last kept key.
ResultState result_state(const Project& project, const Experiment& experiment, const Registry& registry);
/// Whether a result was kept and something that the picture depends on changed since. With `contents`
/// (OpenProject::contents()) a scene file that changed on disk counts, accepted or not. Reads no file: cheap
/// enough for every edit.
bool is_stale(const Project& project, const Experiment& experiment, const Registry& registry,
              const ContentHashes& contents = {});
/// Ids of all such experiments, in their order.
std::vector<std::string> stale_experiments(const Project& project, const Registry& registry,
                                           const ContentHashes& contents = {});

/// Keys of picture_inputs that differ: "values.samples: 16 → 64". For --verify and the stale badge.
std::vector<std::string> differences(const Json& inputs_before, const Json& inputs_now);

struct Provenance {
    std::string build, driver, backend, date;  ///< date: "2024-05-01T12:00:00Z"
    Json extra = Json::object();
    std::string processor = {};  ///< "gl" or "host"; empty in results that older versions kept
    bool operator==(const Provenance&) const = default;
};

struct ResultFile {
    std::string role;          ///< "main", "statistics", "state" or an output's key
    std::string path;          ///< relative to results/, '/' as separator
    std::string content_hash;  ///< hash_file
    Json extra = Json::object();
    bool operator==(const ResultFile&) const = default;
};

struct KeptResult {
    std::string key;
    std::string experiment;     ///< id at the time
    std::string state_key;      ///< state_key() at the time; empty: its method does not accumulate
    std::uint64_t samples = 0;  ///< in its picture (samples.h); may be more than `key` asks for; 0: unknown
    std::vector<ResultFile> files;
    Provenance provenance;
    Json inputs = Json::object();  ///< picture_inputs at the time: says later what changed
    Json extra = Json::object();
    bool operator==(const KeptResult&) const = default;
};

/// Key of the result that was kept last, by the experiment's id.
using LastKept = std::map<std::string, std::string>;
/// Tells a document (Experiment::last_kept_key, Project::kept_ids). Returns whether that was news of an
/// experiment.
bool tell_last_kept(Project& project, const LastKept& keys);

/// results/index.json. It alone says what was kept, so that whoever keeps a result writes nothing else.
class ResultIndex {
  public:
    /// An absent index is empty. Throws InputError for a damaged one and for paths that leave results/.
    static ResultIndex load(const std::filesystem::path& project_folder,
                            FileSystem& files = real_file_system());
    void save(const std::filesystem::path& project_folder, FileSystem& files = real_file_system()) const;

    const std::vector<KeptResult>& entries() const { return entries_; }
    const KeptResult* find(const std::string& key) const;
    /// Of the results with this state key and a file with role "state", to be continued, the one with the
    /// most samples; null where there is none.
    const KeptResult* find_state(const std::string& state_key) const;
    void put(KeptResult result);  ///< replaces an entry with the same key
    bool erase(const std::string& key);
    /// The entry with this key is the experiment's last: several experiments may have the same picture.
    void set_last_kept(const std::string& experiment, const std::string& key);
    /// For experiments that nothing was said of, the newest by date.
    LastKept last_kept() const;
    /// Entries and last results of `newer` count where both have them.
    void merge(const ResultIndex& newer);

    bool operator==(const ResultIndex&) const = default;

  private:
    std::vector<KeptResult> entries_;
    LastKept last_kept_;  ///< keys of entries
    Json extra_ = Json::object();
};

/// Paths of the files that an index lists, relative to results/, normalised.
std::set<std::string> files_of(const ResultIndex& index);

/// Of a result by its role; null where it has none.
const ResultFile* file_of(const KeptResult& result, const std::string& role);
inline constexpr const char* main_role = "main";
inline constexpr const char* statistics_role = "statistics";
inline constexpr const char* state_role = "state";

/// Folder for the files of a result, relative to results/: made of the key.
std::string result_folder(const std::string& key);
/// What the index says and the disk does not hold (missing, changed).
std::vector<Message> check_results(const ResultIndex& index, const std::filesystem::path& project_folder);

struct Pruned {
    std::vector<std::string> keys, files;  ///< entries dropped; files removed, relative to results/
};
/// Drops entries that are neither the present nor the last kept result of an experiment, and files in
/// results/ that no remaining entry, plot, sweep or analysis of the project names. Saves the index first;
/// files that are there when it throws Cancelled go the next time.
Pruned prune_results(const Project& project, const Registry& registry,
                     const std::filesystem::path& project_folder, const CancelToken* cancel = nullptr);

}  // namespace ir::projects
