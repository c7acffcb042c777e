#include "projects/keep.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <set>

#include "projects/store.h"
#include "renderers/core/error.h"
#include "renderers/core/file_system.h"
#include "renderers/core/named_files.h"

namespace ir::projects {
namespace {

namespace fs = std::filesystem;

/// Takes from older results what the new one has more of.
void supersede(ResultIndex& index, const KeptResult& result, const std::set<std::string>& in_use) {
    if (result.state_key.empty()) return;
    const bool has_state = file_of(result, state_role) != nullptr;
    for (auto entry : std::vector<KeptResult>(index.entries())) {
        const bool is_older =
            entry.key != result.key && entry.state_key == result.state_key && entry.samples < result.samples;
        if (!is_older) continue;
        if (in_use.count(entry.key) == 0) {
            index.erase(entry.key);
        } else if (has_state) {
            std::erase_if(entry.files, [](const ResultFile& file) { return file.role == state_role; });
            index.put(std::move(entry));
        }
    }
}

/// Key of the experiment's last result once this one is kept. A process that was faster may have kept more.
std::string last_with(const ResultIndex& index, const KeptResult& result,
                      const std::set<std::string>& in_use) {
    const auto* last = index.find(index.last_kept()[result.experiment]);
    const bool has_more = last && !result.state_key.empty() && last->state_key == result.state_key &&
                          last->samples > result.samples;
    return has_more && in_use.count(result.key) == 0 ? last->key : result.key;
}

}  // namespace

std::set<std::string> keys_in_use(const ResultIndex& index, const std::string& kept,
                                  const fs::path& project_folder, const Registry& registry) {
    std::set<std::string> keys;
    for (const auto& [experiment, key] : index.last_kept())
        if (experiment != kept) keys.insert(key);
    try {
        const auto saved = load_project(project_folder, registry).project;
        const auto now = with_contents(saved, read_contents(saved, project_folder));
        for (const auto& experiment : now.experiments) keys.insert(result_key(now, experiment, registry));
    } catch (const InputError&) {
        // Damaged or not there: it asks for nothing that could be told.
    }
    return keys;
}

void keep(const fs::path& project_folder, KeptResult result, const std::set<std::string>& in_use,
          const ResultsGuard& guard, FileSystem& files) {
    if (guard.is_guarding()) remove_left_overs(project_folder / "results", true);
    auto index = ResultIndex::load(project_folder, files);
    const auto before = files_of(index);
    const auto experiment = result.experiment, last = last_with(index, result, in_use);
    supersede(index, result, in_use);
    index.put(std::move(result));
    index.set_last_kept(experiment, last);
    index.save(project_folder, files);
    const auto after = files_of(index);
    for (const auto& path : before)
        if (after.count(path) == 0) files.remove(project_folder / "results" / path);
}

ResultsGuard::ResultsGuard(const std::filesystem::path& project_folder) {
    const auto results = project_folder / "results";
    real_file_system().create_directories(results);
    refuse_links_out(results, Links::to_folders);
    const auto file = results / results_guard_name;
    constexpr int flags = O_CLOEXEC | O_NOFOLLOW;
    descriptor_ = ::open(file.c_str(), O_RDWR | O_CREAT | flags, 0666);
    // Somebody else's, in a folder that several people write: that is enough to lock it.
    if (descriptor_ < 0 && errno == EACCES &&
        ::faccessat(AT_FDCWD, results.c_str(), W_OK | X_OK, AT_EACCESS) == 0)
        descriptor_ = ::open(file.c_str(), O_RDONLY | flags);
    if (descriptor_ < 0) throw Error(results.string() + ": cannot be written: " + std::strerror(errno));
    int status;
    while ((status = ::flock(descriptor_, LOCK_EX)) != 0 && errno == EINTR) {
    }
    is_guarding_ = status == 0;
}

ResultsGuard::~ResultsGuard() {
    ::close(descriptor_);
}

Pruned delete_results(const fs::path& project_folder, const std::vector<std::string>& keys,
                      FileSystem& files) {
    Pruned deleted;
    const ResultsGuard guard(project_folder);
    auto index = ResultIndex::load(project_folder, files);
    const auto before = files_of(index);
    for (const auto& key : keys)
        if (index.erase(key)) deleted.keys.push_back(key);
    if (deleted.keys.empty()) return deleted;
    index.save(project_folder, files);
    const auto after = files_of(index);
    const auto results = project_folder / "results";
    for (const auto& path : before) {
        if (after.count(path) != 0) continue;
        files.remove(results / path);
        deleted.files.push_back(path);
        std::error_code ignored;
        const auto folder = (results / path).parent_path();
        if (folder != results && fs::is_empty(folder, ignored)) fs::remove(folder, ignored);
    }
    return deleted;
}

}  // namespace ir::projects
