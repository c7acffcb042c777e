#include <algorithm>
#include <set>

#include "projects/analyses.h"
#include "projects/hash.h"
#include "projects/keep.h"
#include "projects/object_reader.h"
#include "projects/plots.h"
#include "projects/results.h"
#include "projects/sweep.h"
#include "projects/text.h"
#include "renderers/core/error.h"

namespace ir::projects {
namespace {

namespace fs = std::filesystem;

constexpr const char* results_name = "results";
constexpr const char* index_name = "index.json";
constexpr int index_schema = 1;

/// Whether a relative path stays below the folder that it starts in.
bool stays_inside(const std::string& path) {
    const fs::path given(path);
    if (path.empty() || given.is_absolute()) return false;
    const auto normal = given.lexically_normal();
    return normal != "." && *normal.begin() != "..";
}

ResultFile read_file(const Json& json, const std::string& index, const std::string& pointer) {
    ObjectReader reader(json, index, pointer);
    ResultFile file;
    file.role = reader.text("role");
    file.path = reader.required_text("path");
    if (!stays_inside(file.path)) reader.fail("path", "leaves results/; give a path below it");
    file.content_hash = reader.text("content_hash");
    file.extra = reader.rest();
    return file;
}

KeptResult read_result(const Json& json, const std::string& index, const std::string& pointer,
                       LastKept& last_kept) {
    ObjectReader reader(json, index, pointer);
    KeptResult result;
    result.key = reader.required_id("key");
    result.experiment = reader.text("experiment");
    result.state_key = reader.text("state_key");
    result.samples = reader.natural("samples", 0);
    reader.each("last_of", [&](const Json& experiment, const std::string& place) {
        if (!experiment.is_string()) throw InputError(index, place, "must be a text in quotes");
        last_kept[experiment] = result.key;
    });
    reader.each("files", [&](const Json& file, const std::string& place) {
        result.files.push_back(read_file(file, index, place));
    });
    if (const auto* provenance = reader.take("provenance")) {
        ObjectReader inner(*provenance, index, reader.pointer_to_member("provenance"));
        result.provenance.build = inner.text("build");
        result.provenance.driver = inner.text("driver");
        result.provenance.backend = inner.text("backend");
        result.provenance.processor = inner.text("processor");
        result.provenance.date = inner.text("date");
        result.provenance.extra = inner.rest();
    }
    if (const auto* inputs = reader.take("inputs")) result.inputs = *inputs;
    result.extra = reader.rest();
    return result;
}

void append(Json& json, const Json& extra) {
    for (auto it = extra.begin(); it != extra.end(); ++it)
        if (!json.contains(it.key())) json[it.key()] = *it;
}

Json to_json(const KeptResult& result, const Json& last_of) {
    Json json = Json::object({{"key", result.key}, {"experiment", result.experiment}});
    if (!last_of.empty()) json["last_of"] = last_of;
    if (!result.state_key.empty()) json["state_key"] = result.state_key;
    if (result.samples > 0) json["samples"] = result.samples;
    json["files"] = Json::array();
    for (const auto& file : result.files) {
        Json entry =
            Json::object({{"role", file.role}, {"path", file.path}, {"content_hash", file.content_hash}});
        append(entry, file.extra);
        json["files"].push_back(std::move(entry));
    }
    const auto& p = result.provenance;
    json["provenance"] =
        Json::object({{"build", p.build}, {"driver", p.driver}, {"backend", p.backend}, {"date", p.date}});
    if (!p.processor.empty()) json["provenance"]["processor"] = p.processor;
    append(json["provenance"], p.extra);
    json["inputs"] = result.inputs;
    append(json, result.extra);
    return json;
}

}  // namespace

ResultIndex ResultIndex::load(const fs::path& project_folder, FileSystem& files) {
    const auto file = project_folder / results_name / index_name;
    ResultIndex index;
    if (!files.exists(file)) return index;
    const std::string name = file.string();
    const Json json = parse_json(files.read(file, JsonLimits{}.bytes), name);
    ObjectReader reader(json, name, "");
    reader.integer("schema", index_schema, 1, index_schema);
    std::set<std::string> keys;
    reader.each("entries", [&](const Json& entry, const std::string& pointer) {
        index.entries_.push_back(read_result(entry, name, pointer, index.last_kept_));
        if (!keys.insert(index.entries_.back().key).second)
            throw InputError(name, pointer + "/key", "stands twice; remove one of the entries");
    });
    index.extra_ = reader.rest();
    return index;
}

void ResultIndex::save(const fs::path& project_folder, FileSystem& files) const {
    Json json = Json::object({{"schema", index_schema}, {"entries", Json::array()}});
    std::map<std::string, Json> last_of;
    for (const auto& [experiment, key] : last_kept_) last_of[key].push_back(experiment);
    for (const auto& entry : entries_) json["entries"].push_back(to_json(entry, last_of[entry.key]));
    append(json, extra_);
    files.create_directories(project_folder / results_name);
    write_atomically(files, project_folder / results_name / index_name, pretty_json(json));
}

const KeptResult* ResultIndex::find(const std::string& key) const {
    for (const auto& entry : entries_)
        if (entry.key == key) return &entry;
    return nullptr;
}

const KeptResult* ResultIndex::find_state(const std::string& state_key) const {
    const KeptResult* most = nullptr;
    for (const auto& entry : entries_)
        if (!state_key.empty() && entry.state_key == state_key && file_of(entry, state_role) &&
            (!most || entry.samples > most->samples))
            most = &entry;
    return most;
}

void ResultIndex::put(KeptResult result) {
    if (!is_valid_id(result.key)) throw UsageError("a result's key must be a hash");
    for (const auto& file : result.files)
        if (!stays_inside(file.path))
            throw UsageError("result file '" + printable(file.path) + "' must lie below results/");
    for (auto& entry : entries_) {
        if (entry.key != result.key) continue;
        entry = std::move(result);
        return;
    }
    entries_.push_back(std::move(result));
}

bool ResultIndex::erase(const std::string& key) {
    std::erase_if(last_kept_, [&](const auto& last) { return last.second == key; });
    return std::erase_if(entries_, [&](const KeptResult& entry) { return entry.key == key; }) > 0;
}

void ResultIndex::set_last_kept(const std::string& experiment, const std::string& key) {
    if (!find(key)) throw UsageError("no result is kept with this key");
    last_kept_[experiment] = key;
}

LastKept ResultIndex::last_kept() const {
    LastKept last, dates;
    for (const auto& entry : entries_) {
        auto& date = dates[entry.experiment];
        if (entry.provenance.date < date) continue;
        date = entry.provenance.date;
        last[entry.experiment] = entry.key;
    }
    for (const auto& [experiment, key] : last_kept_) last[experiment] = key;
    return last;
}

void ResultIndex::merge(const ResultIndex& newer) {
    for (const auto& entry : newer.entries_) put(entry);
    for (const auto& [experiment, key] : newer.last_kept()) last_kept_[experiment] = key;
}

bool tell_last_kept(Project& project, const LastKept& keys) {
    bool is_news = false;
    project.kept_ids.clear();
    for (const auto& [id, key] : keys) project.kept_ids.insert(id);
    for (auto& experiment : project.experiments) {
        const auto found = keys.find(experiment.id);
        const auto key = found == keys.end() ? std::string() : found->second;
        is_news = is_news || experiment.last_kept_key != key;
        experiment.last_kept_key = key;
    }
    return is_news;
}

std::set<std::string> files_of(const ResultIndex& index) {
    std::set<std::string> paths;
    for (const auto& entry : index.entries())
        for (const auto& file : entry.files)
            paths.insert(fs::path(file.path).lexically_normal().generic_string());
    return paths;
}

const ResultFile* file_of(const KeptResult& result, const std::string& role) {
    for (const auto& file : result.files)
        if (file.role == role) return &file;
    return nullptr;
}

std::string result_folder(const std::string& key) {
    return key.substr(0, 16);
}

std::vector<Message> check_results(const ResultIndex& index, const fs::path& project_folder) {
    std::vector<Message> messages;
    for (const auto& entry : index.entries()) {
        for (const auto& file : entry.files) {
            const auto path = project_folder / results_name / file.path;
            std::error_code ignored;
            const std::string where =
                "result of '" + printable(entry.experiment, 100) + "': " + printable(path.string(), 400);
            if (!fs::is_regular_file(path, ignored))
                messages.push_back({Severity::warning, "results", where + " is missing; render it again"});
            else if (!file.content_hash.empty() && hash_file(path) != file.content_hash)
                messages.push_back({Severity::warning, "results", where + " was changed; render it again"});
        }
    }
    return messages;
}

namespace {

/// What a sweep or an analysis of the project has a folder for.
bool is_of_item(const Project& project, const fs::path& path) {
    const auto is_inside = [&](const std::string& folder) {
        const auto inside = path.lexically_relative(folder);
        return !inside.empty() && *inside.begin() != "..";
    };
    return std::ranges::any_of(project.sweeps, is_inside, [](const Sweep& s) { return sweep_path(s.id); }) ||
           std::ranges::any_of(project.analyses, is_inside,
                               [](const Analysis& a) { return analysis_path(a.id); });
}

}  // namespace

Pruned prune_results(const Project& project, const Registry& registry, const fs::path& project_folder,
                     const CancelToken* cancel) {
    Pruned pruned;
    const auto results = project_folder / results_name;
    std::error_code ignored;
    if (!fs::is_directory(results, ignored)) return pruned;
    const ResultsGuard guard(project_folder);
    auto index = ResultIndex::load(project_folder);
    // Others may have kept results since the document was read.
    auto now = project;
    tell_last_kept(now, index.last_kept());
    std::set<std::string> keys;
    for (const auto& experiment : now.experiments) {
        keys.insert(experiment.last_kept_key);
        keys.insert(result_key(now, experiment, registry));
    }
    std::set<fs::path> named{index_name, results_guard_name};
    for (const auto& plot : project.plots) named.insert(study_path(plot.id));
    for (const auto& entry : std::vector<KeptResult>(index.entries())) {
        if (keys.count(entry.key) != 0) {
            for (const auto& file : entry.files) named.insert(fs::path(file.path).lexically_normal());
        } else {
            pruned.keys.push_back(entry.key);
            index.erase(entry.key);
        }
    }
    index.save(project_folder);

    std::vector<fs::path> folders, unnamed;
    for (const auto& entry : fs::recursive_directory_iterator(results)) {
        if (entry.is_directory() && !entry.is_symlink())
            folders.push_back(entry.path());
        else if (named.count(entry.path().lexically_relative(results)) == 0 &&
                 !is_of_item(project, entry.path().lexically_relative(results)))
            unnamed.push_back(entry.path());
    }
    for (const auto& file : unnamed) {
        if (cancel) cancel->check();
        pruned.files.push_back(file.lexically_relative(results).generic_string());
        if (std::error_code error; !fs::remove(file, error) && error)
            throw Error(file.string() + ": cannot be removed; check permissions");
    }
    // Deepest first; folders that still hold something stay.
    for (auto folder = folders.rbegin(); folder != folders.rend(); ++folder)
        if (fs::is_empty(*folder, ignored)) fs::remove(*folder, ignored);
    std::sort(pruned.files.begin(), pruned.files.end());
    return pruned;
}

}  // namespace ir::projects
