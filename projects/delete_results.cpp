#include "projects/delete_results.h"

#include <algorithm>
#include <set>

#include "projects/results_guard.h"

namespace ir::projects {

namespace fs = std::filesystem;

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
