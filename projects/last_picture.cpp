#include "projects/last_picture.h"

#include <algorithm>
#include <fstream>

#include "projects/archive.h"
#include "projects/results.h"
#include "projects/store.h"
#include "renderers/core/error.h"

namespace ir::projects {
namespace {

namespace fs = std::filesystem;

/// Relative to results/; empty: none is kept.
std::string last_picture(const ResultIndex& index) {
    std::string path, date;
    for (const auto& entry : index.entries()) {
        const auto* main = file_of(entry, main_role);
        if (!main || entry.provenance.date < date) continue;
        path = fs::path(main->path).lexically_normal().generic_string();
        date = entry.provenance.date;
    }
    return path;
}

/// The list of results stands before them.
bool copy_from_archive(const fs::path& archive, const fs::path& file) {
    std::string wanted;
    bool is_there = false;
    read_archive(archive, [&](const std::string& name, const CopyContent& copy) {
        const auto inside = name.substr(std::min(name.size(), name.find('/') + 1));
        const auto pour = [&](const fs::path& to) {
            fs::create_directories(to.parent_path());
            std::ofstream out(to, std::ios::binary);
            copy(out);
            if (!out.flush()) throw Error(to.string() + ": cannot be written");
        };
        if (inside == "results/index.json") {
            const fs::path folder = file.string() + ".list";
            pour(folder / inside);
            const auto picture = last_picture(ResultIndex::load(folder));
            if (!picture.empty()) wanted = "results/" + picture;
            fs::remove_all(folder);
        } else if (!wanted.empty() && inside == wanted) {
            pour(file);
            is_there = true;
        }
    });
    return is_there;
}

}  // namespace

bool copy_last_picture(const fs::path& project, const fs::path& file) {
    std::error_code ignored;
    if (fs::is_regular_file(project, ignored) && project.filename() != project_file_name)
        return copy_from_archive(project, file);
    const auto folder = project_folder(project);
    const auto picture = last_picture(ResultIndex::load(folder));
    if (picture.empty()) return false;
    copy_atomically(real_file_system(), folder / "results" / picture, file);
    return true;
}

}  // namespace ir::projects
