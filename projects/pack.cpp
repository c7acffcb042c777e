#include "projects/pack.h"

#include <algorithm>
#include <optional>

#include "projects/analyses.h"
#include "projects/archive.h"
#include "projects/gltf_references.h"
#include "projects/plots.h"
#include "projects/results.h"
#include "projects/scene_files.h"
#include "projects/store.h"
#include "projects/text.h"
#include "renderers/core/changed_shaders.h"
#include "renderers/core/error.h"
#include "renderers/core/named_files.h"
#include "renderers/core/new_files.h"
#include "renderers/core/write_file.h"

namespace ir::projects {
namespace {

namespace fs = std::filesystem;

/// The deepest folder that holds all files.
fs::path common_folder(const std::vector<fs::path>& files) {
    fs::path common = files.front().parent_path();
    for (const auto& file : files) {
        while (common.has_relative_path()) {
            const auto inside = file.lexically_relative(common);
            if (!inside.empty() && *inside.begin() != "..") break;
            common = common.parent_path();
        }
    }
    return common;
}

/// What no packer writes: somebody's unsaved changes and lock.
bool is_left_out(const std::string& name) {
    return name == ".lock" || name.rfind(std::string(project_file_name) + ".", 0) == 0;
}

/// A packed project holds all that it names. Throws InputError for one that does not.
void require_whole(const fs::path& packed, const fs::path& folder) {
    if (are_outside_files_allowed()) return;
    const Registry no_methods({});
    const auto outside = files_outside(load_project(folder, no_methods).project, folder);
    if (!outside.empty())
        throw InputError(packed.string(), printable(outside.front().string(), 400),
                         "is named by the project and lies outside of its folder; if you trust who packed "
                         "it, allow it by --allow-outside");
}

/// Nobody here has allowed yet what a project of somebody else changes in shaders.
void withdraw_shaders(const fs::path& folder) {
    if (are_changed_shaders_allowed()) return;
    auto& files = real_file_system();
    const auto file = folder / project_file_name;
    auto json = parse_json(files.read(file, JsonLimits{}.bytes), file.string());
    const auto changes_shaders = [](const Json& experiment) {
        return experiment.is_object() && experiment.contains("shaders");
    };
    const auto experiments = json.find("experiments");
    if (experiments == json.end() || std::none_of(experiments->begin(), experiments->end(), changes_shaders))
        return;
    json["shaders_allowed"] = false;
    write_atomically(files, file, pretty_json(json));
}

/// Makes the folders of files in an archive.
class NewFolders {
  public:
    NewFolders(fs::path packed, fs::path root) : packed_(std::move(packed)), root_(std::move(root)) {
        real_file_system().create_directories(root_);
    }
    /// `inside`: relative to the root.
    void make(const fs::path& inside) {
        if (inside == last_) return;
        auto folder = root_;
        int depth = 0;
        std::error_code ignored;
        for (const auto& part : inside) {
            const bool is_there = fs::exists(folder /= part, ignored);
            made_ += !is_there;
            if (++depth > max_packed_depth || made_ > max_packed_files)
                throw InputError(packed_.string(), printable(inside.string()),
                                 "has more folders than a project; ask for another copy");
            if (!is_there) real_file_system().create_directories(folder);
        }
        last_ = inside;
    }

  private:
    const fs::path packed_, root_;
    fs::path last_;
    int made_ = 0;
};

class Packer {
  public:
    Packer(const LoadedProject& loaded, ArchiveWriter& archive)
        : folder_(loaded.folder),
          project_(loaded.project),
          root_(fs::absolute(loaded.folder).lexically_normal().stem().string() + folder_suffix + "/"),
          archive_(archive) {}

    std::vector<Message> run() {
        refuse_links_out(folder_ / "results", Links::all);
        tell_files_from_outside();
        for_each_file(project_, [&](std::string& source, const std::string&) { add_source(source); });
        archive_.add_text(root_ + project_file_name, write_project(project_));
        add_results();
        add_studies();
        return std::move(messages_);
    }

  private:
    /// A document of somebody else may name what its reader would not send back.
    void tell_files_from_outside() {
        std::vector<std::string> names;
        for (const auto& file : files_outside(project_, folder_)) names.push_back(file.string());
        if (!names.empty())
            messages_.push_back(
                {Severity::note, "project",
                 "files from outside of the project's folder are packed: " + printable(listed(names), 400)});
    }

    void miss(const std::string& source) {
        messages_.push_back(
            {Severity::warning, "project", "'" + printable(source) + "' is missing and was not packed"});
    }

    /// Every source gets a folder of its own, in which its files keep their places relative to each other. So
    /// does one that is missing: what is packed names nothing outside.
    void add_source(std::string& source) {
        if (is_builtin(source)) return;
        const auto file = resolve(source, folder_);
        const auto home = "files/" + std::to_string(++sources_) + "/";
        std::error_code ignored;
        if (!fs::is_regular_file(file, ignored)) {
            miss(source);
            source = home + file.filename().generic_string();
            return;
        }
        const auto files = files_of(file);
        const auto base = common_folder(files);
        for (const auto& one : files) {
            if (fs::is_regular_file(one, ignored))
                archive_.add_file(root_ + home + one.lexically_relative(base).generic_string(), one);
            else
                miss(one.lexically_relative(base).generic_string());
        }
        for (const auto& path : gltf_references(file).refused)
            messages_.push_back({Severity::warning, "project",
                                 "'" + printable(path) + "' lies outside of the folder of '" +
                                     printable(source) + "' and was not packed; put it there"});
        source = home + file.lexically_relative(base).generic_string();
    }

    /// Those that there are: a plot or an analysis need not have been carried out.
    void add_studies() {
        const auto add = [this](const std::string& path) {
            const auto name = "results/" + path;
            std::error_code ignored;
            if (fs::is_regular_file(folder_ / name, ignored)) archive_.add_file(root_ + name, folder_ / name);
        };
        for (const auto& plot : project_.plots) add(study_path(plot.id));
        for (const auto& analysis : project_.analyses)
            for (const std::string file : {analysis_file, analysis_pictures})
                add(analysis_path(analysis.id) + "/" + file);
    }

    void add_results() {
        const auto index = ResultIndex::load(folder_);
        if (index.entries().empty()) return;
        archive_.add_file(root_ + "results/index.json", folder_ / "results/index.json");
        std::vector<std::string> done;
        for (const auto& entry : index.entries()) {
            for (const auto& file : entry.files) {
                const auto name = "results/" + fs::path(file.path).lexically_normal().generic_string();
                if (std::find(done.begin(), done.end(), name) != done.end()) continue;
                done.push_back(name);
                std::error_code ignored;
                if (fs::is_regular_file(folder_ / name, ignored))
                    archive_.add_file(root_ + name, folder_ / name);
                else
                    miss(name);
            }
        }
    }

    const fs::path& folder_;
    Project project_;
    std::string root_;
    ArchiveWriter& archive_;
    int sources_ = 0;
    std::vector<Message> messages_;
};

}  // namespace

std::vector<Message> pack_project(const fs::path& given, const fs::path& file, const Registry& registry,
                                  const CancelToken* cancel) {
    const auto loaded = load_project(given, registry);
    if (is_own_file(loaded, file))
        throw UsageError("--pack '" + file.string() + "' is a file of the project; choose another file");
    std::vector<Message> messages;
    write_file(file, [&](std::ostream& out) {
        ArchiveWriter archive(out, cancel);
        messages = Packer(loaded, archive).run();
        archive.finish();
    });
    return messages;
}

fs::path unpack_project(const fs::path& file, const fs::path& parent, const CancelToken* cancel) {
    std::optional<fs::path> root, begun;
    std::optional<NewFolders> folders;
    std::error_code ignored;
    std::vector<fs::path> missing;  // folders that are made, the innermost first
    for (auto each = fs::absolute(parent); !fs::exists(each, ignored); each = each.parent_path())
        missing.push_back(each);
    auto& files = real_file_system();
    try {
        const auto extract = [&](const std::string& name, const CopyContent& copy) {
            const auto path = fs::path(name).lexically_normal();
            const auto top = parent / *path.begin();
            if (!root) {
                if (fs::path(*path.begin()).extension() != folder_suffix)
                    throw InputError(file.string(), printable(name),
                                     "is not inside a NAME.interreflect folder");
                if (fs::exists(top, ignored))
                    throw Error(top.string() + ": exists already; unpack elsewhere or rename it");
                root = top;
                begun = temporary_beside(files, top);
                folders.emplace(file, *begun);
            }
            if (top != *root || path == *path.begin())
                throw InputError(file.string(), printable(name), "is outside the project's folder");
            const auto inside = path.lexically_relative(*path.begin());
            if (is_left_out(inside.string())) return true;
            folders->make(inside.parent_path());
            files.remove(*begun / inside);  // the later one of two counts
            write_new_file(*begun / inside, copy);
            return true;
        };
        read_archive(file, extract, cancel);
        if (!root) throw InputError(file.string(), "", "is empty; ask for another copy");
        if (!fs::is_regular_file(*begun / project_file_name, ignored))
            throw InputError(file.string(), "", "holds no project.json; ask for another copy");
        require_whole(file, *begun);
        withdraw_shaders(*begun);
        sync_disk_of(*begun);
        files.rename(*begun, *root);
        files.sync_directory(root->parent_path());
    } catch (...) {
        if (begun) fs::remove_all(*begun, ignored);
        for (const auto& each : missing) fs::remove(each, ignored);  // where they are empty
        throw;
    }
    return *root;
}

}  // namespace ir::projects
