#include "app/engine/sweep_table.h"

#include <algorithm>
#include <regex>
#include <set>

#include "app/engine/division.h"
#include "app/engine/measure.h"
#include "app/engine/number_text.h"
#include "projects/hash.h"
#include "renderers/core/error.h"
#include "renderers/core/file_system.h"
#include "renderers/core/named_files.h"
#include "renderers/image/metrics.h"

namespace ir::engine {
namespace {

namespace fs = std::filesystem;
using projects::Json;
using projects::ObjectReader;

constexpr std::size_t max_table_bytes = std::size_t{1} << 30;
constexpr int max_shards = 1'000'000;

Json row_json(const SweepRow& row) {
    Json json{{"id", row.id}, {"coordinates", row.coordinates}, {"key", row.key}};
    if (!row.reference.empty()) json["reference"] = row.reference;
    if (!row.is_done()) {
        json["problem"] = row.problem;
        return json;
    }
    if (!row.image.empty()) json["image"] = row.image;
    json["cold_ms"] = row.cold_ms;
    if (row.warm_ms) json["warm_ms"] = *row.warm_ms;
    if (!row.reference.empty()) {
        put_errors(json, row.errors, row.pixels);
        json["reference_noise"] = number_json(row.reference_noise);
        json["pixels"] = row.pixels;
        json["skipped"] = row.skipped;
    }
    json["memory_bytes"] = row.memory_bytes;
    json["counters"] = Json::object();
    for (const auto& [key, value] : row.counters) json["counters"][key] = number_json(value);
    json["device"] = row.device;
    json["build"] = row.build;
    return json;
}

std::map<std::string, double> read_counters(ObjectReader& reader) {
    std::map<std::string, double> counters;
    const auto* json = reader.take("counters");
    if (!json) return counters;
    if (!json->is_object()) reader.fail("counters", "must be an object of numbers");
    for (auto it = json->begin(); it != json->end(); ++it)
        counters[it.key()] = number_from(*it, "", reader, "counters");
    return counters;
}

SweepRow read_row(const Json& json, const std::string& file, const std::string& pointer) {
    ObjectReader reader(json, file, pointer);
    SweepRow row;
    row.id = reader.required_text("id");
    if (const auto* coordinates = reader.take("coordinates")) row.coordinates = *coordinates;
    if (!row.coordinates.is_object()) reader.fail("coordinates", "must be an object");
    row.key = reader.text("key");
    row.reference = reader.text("reference");
    row.problem = reader.text("problem");
    row.image = reader.text("image");
    row.cold_ms = reader.number("cold_ms", 0, 0);
    if (reader.has("warm_ms")) row.warm_ms = reader.number("warm_ms", 0, 0);
    row.errors = read_errors(reader);
    row.reference_noise = reader.number("reference_noise", 0, 0);
    row.pixels = reader.natural("pixels", 0);
    row.skipped = reader.natural("skipped", 0);
    row.memory_bytes = reader.natural("memory_bytes", 0);
    row.counters = read_counters(reader);
    row.device = reader.text("device");
    row.build = reader.text("build");
    return row;
}

/// As table_name() calls them; statistics of an experiment "sweep" are none.
bool is_list(const fs::path& file) {
    static const std::regex name("sweep(-[0-9]+-of-[0-9]+)?\\.json");
    return std::regex_match(file.filename().string(), name);
}

bool same_sweep(const SweepTable& a, const SweepTable& b) {
    return a.sweep == b.sweep && a.experiment == b.experiment;
}

/// A file that a list in `folder` names, or nothing. Lists of shards are merged beside their folders.
fs::path reachable(const fs::path& file, const fs::path& folder) {
    const auto here = folder.empty() ? fs::path(".") : folder;
    const bool is_beside = lies_within(file, here) || lies_within(file, here / "..");
    return is_beside || are_outside_files_allowed() ? file : fs::path();
}

/// A shard, or a whole sweep.
struct SweepPart {
    fs::path file;
    SweepTable table;
};
using SweepParts = std::map<int, SweepPart>;  ///< by the shard's index

/// Files of pictures become relative to `out_folder`.
std::vector<SweepPart> parts_in(const fs::path& folder, const fs::path& out_folder) {
    if (!fs::is_directory(folder)) throw InputError(folder.string(), "", "is no folder");
    std::vector<SweepPart> parts;
    for (const auto& file : sweep_lists(folder)) {
        SweepPart part{file, read_table(file)};
        for (auto& row : part.table.rows)
            if (!row.image.empty())
                row.image = fs::proximate(fs::absolute(folder / row.image), fs::absolute(out_folder))
                                .generic_string();
        parts.push_back(std::move(part));
    }
    // Beside shards a whole is what was merged from them before.
    const auto is_whole = [](const SweepPart& part) { return part.table.shard.count == 1; };
    if (!std::all_of(parts.begin(), parts.end(), is_whole)) std::erase_if(parts, is_whole);
    return parts;
}

void require_same_sweep(const SweepPart& part, const SweepPart& first) {
    const auto refused = [&](const std::string& why) {
        throw InputError(part.file.string(), "",
                         "is no shard of the same sweep as " + first.file.string() + ": " + why);
    };
    if (!same_sweep(part.table, first.table))
        refused("they are of sweep '" + part.table.sweep + "' and '" + first.table.sweep +
                "'; name the folders of one sweep");
    if (part.table.shard.count != first.table.shard.count)
        refused("it is one of " + std::to_string(part.table.shard.count) + ", the other one of " +
                std::to_string(first.table.shard.count) + "; name the folders of one division");
    if (part.table.plan != first.table.plan)
        refused("the project or --reference was another; run one of them again");
}

/// In the sweep's order: shards take turns.
SweepTable joined(SweepParts& parts) {
    const auto& first = parts.begin()->second;
    const auto count = static_cast<std::size_t>(first.table.shard.count);
    std::size_t total = 0;
    for (int index = 1; index <= int(count); ++index) {
        const auto part = parts.find(index);
        if (part == parts.end())
            throw InputError(first.file.string(), "",
                             "shard " + std::to_string(index) + " of " + std::to_string(count) +
                                 " is in none of the folders; run it, or name its folder");
        total += part->second.table.rows.size();
    }
    SweepTable table{first.table.sweep, first.table.experiment, first.table.plan};
    for (std::size_t i = 0; i < total; ++i) {
        auto& [file, part] = parts.at(static_cast<int>(i % count) + 1);
        if (i / count >= part.rows.size())
            throw InputError(file.string(), "/points",
                             "has " + std::to_string(part.rows.size()) + " of " + std::to_string(total) +
                                 " variations, too few for its shard; run it again");
        table.rows.push_back(std::move(part.rows[i / count]));
    }
    return table;
}

}  // namespace

std::vector<fs::path> sweep_lists(const fs::path& folder) {
    std::vector<fs::path> lists;
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder, ignored))
        if (is_list(entry.path()) && entry.is_regular_file(ignored)) lists.push_back(entry.path());
    std::sort(lists.begin(), lists.end());
    return lists;
}

std::string table_name(const Shard& shard) {
    return shard.count == 1 ? "sweep" : part_name("sweep", shard.index, shard.count);
}

fs::path picture_of(const SweepRow& row, const fs::path& folder) {
    const fs::path image = row.image;
    return image.is_relative() && image.extension() == ".exr" ? reachable(folder / image, folder)
                                                              : fs::path();
}

fs::path reference_of(const SweepRow& row, const fs::path& folder) {
    if (row.reference.empty() || fs::path(row.reference).has_parent_path()) return {};
    return reachable(folder / references_folder / (row.reference + ".exr"), folder);
}

std::string sweep_plan(const std::vector<SweepRow>& rows) {
    Json keys = Json::array();
    for (const auto& row : rows) keys.push_back({row.key, row.reference});
    return projects::hash_json(keys);
}

std::string table_json(const SweepTable& table) {
    Json json{{"schema_version", 1},  // projects/schemas/sweep.schema.json
              {"sweep", table.sweep},       {"experiment", table.experiment}, {"plan", table.plan},
              {"shard", table.shard.index}, {"shards", table.shard.count}};
    json["points"] = Json::array();
    for (const auto& row : table.rows) json["points"].push_back(row_json(row));
    return json.dump(2) + "\n";
}

SweepTable read_table(const fs::path& file) {
    const auto json = projects::parse_json(real_file_system().read(file, max_table_bytes), file.string(),
                                           {.bytes = max_table_bytes});
    ObjectReader reader(json, file.string(), "");
    SweepTable table;
    table.sweep = reader.required_text("sweep");
    table.experiment = reader.required_text("experiment");
    table.plan = reader.text("plan");
    table.shard.count = int(reader.integer("shards", 1, 1, max_shards));
    table.shard.index = int(reader.integer("shard", 1, 1, table.shard.count));
    reader.each("points", [&](const Json& point, const std::string& pointer) {
        table.rows.push_back(read_row(point, file.string(), pointer));
    });
    return table;
}

SweepTable read_tables(const fs::path& folder) {
    const auto lists = sweep_lists(folder);
    if (lists.empty())
        throw InputError(folder.string(), "",
                         "has no list of a sweep (sweep.json); `sweep PROJECT NAME --out` writes one");
    for (const auto& list : lists)
        if (list.stem() == table_name({})) return read_table(list);
    auto table = read_table(lists.front());
    for (std::size_t i = 1; i < lists.size(); ++i) {
        const auto next = read_table(lists[i]);
        if (next.plan != table.plan)
            throw InputError(lists[i].string(), "",
                             "is of another sweep than " + lists.front().filename().string());
        table.rows.insert(table.rows.end(), next.rows.begin(), next.rows.end());
    }
    return table;
}

std::string table_csv(const SweepTable& table) {
    std::vector<std::string> coordinates, metrics;
    std::set<std::string> counters;
    const auto add = [](std::vector<std::string>& words, const std::string& word) {
        if (std::find(words.begin(), words.end(), word) == words.end()) words.push_back(word);
    };
    for (const auto& row : table.rows) {
        for (auto it = row.coordinates.begin(); it != row.coordinates.end(); ++it) add(coordinates, it.key());
        for (const auto& [key, value] : row.counters) counters.insert(key);
    }
    for (const auto& name : metric_names())
        if (std::any_of(table.rows.begin(), table.rows.end(),
                        [&](const auto& row) { return row.errors.count(name) != 0; }))
            metrics.push_back(name);
    std::string text = "id";
    for (const auto& key : coordinates) text += "," + csv_field(key);
    text += ",cold_ms,warm_ms";
    for (const auto& metric : metrics) text += "," + csv_field(metric);
    text += ",reference_noise,pixels,skipped,memory_bytes";
    for (const auto& key : counters) text += "," + csv_field(key);
    text += ",device,build,key,reference,image,problem\r\n";
    for (const auto& row : table.rows) {
        const auto put = [&](const std::map<std::string, double>& values, const std::string& key) {
            const auto found = values.find(key);
            text += "," + (found == values.end() ? "" : csv_number(found->second));
        };
        const bool is_judged = row.is_done() && !row.reference.empty();
        text += csv_field(row.id);
        for (const auto& key : coordinates)
            text += "," + (row.coordinates.contains(key) ? csv_value(row.coordinates[key]) : "");
        text += "," + (row.is_done() ? csv_number(row.cold_ms) : "");
        text += "," + (row.warm_ms ? csv_number(*row.warm_ms) : "");
        for (const auto& metric : metrics) put(row.errors, metric);
        text += "," + (is_judged ? csv_number(row.reference_noise) : "");
        for (const auto count : {row.pixels, row.skipped})
            text += "," + (is_judged ? std::to_string(count) : "");
        text += "," + (row.is_done() ? std::to_string(row.memory_bytes) : "");
        for (const auto& key : counters) put(row.counters, key);
        for (const auto& word : {row.device, row.build, row.key, row.reference, row.image, row.problem})
            text += "," + csv_field(word);
        text += "\r\n";
    }
    return text;
}

std::string row_line(const SweepRow& row) {
    return row_json(row).dump() + "\n";
}

std::vector<SweepRow> read_row_lines(const fs::path& file) {
    const auto text = real_file_system().read(file, max_table_bytes);
    std::vector<SweepRow> rows;
    std::size_t begin = 0;
    for (int number = 1;; ++number) {
        const auto end = text.find('\n', begin);
        if (end == std::string::npos) return rows;
        const auto place = file.string() + ": line " + std::to_string(number);
        const auto json = projects::parse_json(std::string_view(text).substr(begin, end - begin), place);
        rows.push_back(read_row(json, place, ""));
        begin = end + 1;
    }
}

std::size_t resume_rows(SweepTable& table, const fs::path& folder, bool is_timed, bool has_picture) {
    std::map<std::string, SweepRow> by_id;  // the last of each counts
    const auto take = [&by_id](std::vector<SweepRow> rows) {
        for (auto& row : rows)
            if (row.is_done()) by_id[row.id] = std::move(row);
    };
    const auto take_lines = [&take](const fs::path& file) {
        if (real_file_system().exists(file)) take(read_row_lines(file));
    };
    for (const auto& file : sweep_lists(folder)) {
        const auto other = read_table(file);
        if (!same_sweep(table, other))
            throw InputError(file.string(), "",
                             "is of sweep '" + other.sweep + "' of experiment '" + other.experiment +
                                 "', which sweep '" + table.sweep +
                                 "' cannot go on from; give another --out, or leave out --resume");
        take(other.rows);
        take_lines(fs::path(file).replace_extension(".jsonl"));
    }
    take_lines(folder / (table_name(table.shard) + ".jsonl"));
    std::size_t count = 0;
    for (auto& row : table.rows) {
        const auto found = by_id.find(row.id);
        if (found == by_id.end() || row.problem != SweepRow::not_rendered) continue;
        auto& before = found->second;
        std::error_code ignored;
        const bool is_whole =
            !has_picture || (!before.image.empty() && fs::is_regular_file(folder / before.image, ignored));
        if (before.key != row.key || (!row.reference.empty() && before.reference != row.reference) ||
            before.coordinates != row.coordinates || (is_timed && !before.warm_ms) || !is_whole)
            continue;
        row = std::move(before);
        ++count;
    }
    return count;
}

SweepTable merged_tables(const std::vector<fs::path>& folders, const fs::path& out_folder) {
    SweepParts parts;
    for (const auto& folder : folders) {
        const auto before = parts.size();
        for (auto& part : parts_in(folder, out_folder)) {
            if (!parts.empty()) require_same_sweep(part, parts.begin()->second);
            const auto file = part.file.string();
            const auto index = part.table.shard.index;
            const auto [place, is_new] = parts.emplace(index, std::move(part));
            if (!is_new)
                throw InputError(file, "",
                                 "is the same shard as " + place->second.file.string() +
                                     "; name the folder of one of them");
        }
        if (parts.size() == before)
            throw InputError(folder.string(), "", "has no list of a sweep, such as sweep-1-of-4.json");
    }
    return joined(parts);
}

}  // namespace ir::engine
