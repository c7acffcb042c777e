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

// A small archive may hold what unpacks to more than a disk has.
constexpr std::streamsize max_list_bytes = 16 << 20, max_picture_bytes = 1 << 30;

/// A file that takes so many bytes and no more.
class LimitedFile : public std::filebuf {
  public:
    explicit LimitedFile(std::streamsize most) : left_(most) {}

  protected:
    std::streamsize xsputn(const char* data, std::streamsize count) override {
        if (count > left_) return 0;
        left_ -= count;
        return std::filebuf::xsputn(data, count);
    }

  private:
    std::streamsize left_;
};

void pour(const CopyContent& copy, const fs::path& to, std::streamsize most) {
    fs::create_directories(to.parent_path());
    LimitedFile file(most);
    std::ostream out(file.open(to, std::ios::out | std::ios::binary) ? &file : nullptr);
    copy(out);
    if (!out.flush())
        throw Error(to.string() + ": cannot be written, or has more than " + std::to_string(most >> 20) +
                    " MiB");
}

/// The list of results stands before them.
bool copy_from_archive(const fs::path& archive, const fs::path& file) {
    std::string wanted;
    bool is_there = false;
    read_archive(archive, [&](const std::string& name, const CopyContent& copy) {
        const auto inside = name.substr(std::min(name.size(), name.find('/') + 1));
        if (wanted.empty() && inside == "results/index.json") {
            const fs::path folder = file.string() + ".list";
            pour(copy, folder / inside, max_list_bytes);
            const auto picture = last_picture(ResultIndex::load(folder));
            fs::remove_all(folder);
            if (picture.empty()) return false;  // no need to go on
            wanted = "results/" + picture;
        } else if (!wanted.empty() && inside == wanted) {
            pour(copy, file, max_picture_bytes);
            is_there = true;
        }
        return !is_there;
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
