#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "projects/sweep.h"
#include "renderers/core/shard.h"

namespace ir::engine {

/// What became of one variation of a sweep.
struct SweepRow {
    static constexpr const char* not_rendered = "not rendered yet";
    std::string id;  ///< of the experiment: its number in the sweep is in it
    projects::Json coordinates = projects::Json::object();  ///< projects::SweepPoint
    std::string key;        ///< projects::result_key() of the files as they are
    std::string reference;  ///< the same of the ground truth that it is judged by; empty: by none
    std::string problem = not_rendered;  ///< not empty: one line why the rest says nothing
    std::string image;                   ///< EXR file, relative to the table's folder; empty: not kept
    double cold_ms = 0;                  ///< of the first run, all frames: buffers and programs are made
    std::optional<double> warm_ms = {};  ///< of later runs, the median
    std::map<std::string, double> errors = {};  ///< by metric
    double reference_noise = 0;                 ///< RMSE that the ground truth has left itself; 0: unknown
    std::size_t pixels = 0, skipped = 0;        ///< that were compared, and that were not
    std::uint64_t memory_bytes = 0;
    std::map<std::string, double> counters = {};  ///< FrameReport::counters
    std::string device = {}, build = {};
    bool is_done() const { return problem.empty(); }
    bool has_failed() const { return !is_done() && problem != not_rendered; }
};

/// The rows of one sweep, or of a shard of it, in the sweep's order.
struct SweepTable {
    std::string sweep, experiment;  ///< ids
    std::string plan;               ///< hash of the keys of all variations, those of other shards included
    Shard shard = {};
    std::vector<SweepRow> rows = {};
};

/// "sweep", or "sweep-2-of-4", so that shards may share a folder: without extension.
std::string table_name(const Shard& shard);
/// The lists of sweeps and shards that lie in a folder itself, such as sweep-2-of-4.json.
std::vector<std::filesystem::path> sweep_lists(const std::filesystem::path& folder);
/// Beside the lists: ground truths, as KEY.exr.
inline constexpr const char* references_folder = "references";
/// The files of a row's picture and of its ground truth; `folder` is that of its list. Empty where it has
/// none, and where the list, which anybody may have written, names what a sweep does not write.
std::filesystem::path picture_of(const SweepRow& row, const std::filesystem::path& folder);
std::filesystem::path reference_of(const SweepRow& row, const std::filesystem::path& folder);
/// Of all rows, those of other shards included.
std::string sweep_plan(const std::vector<SweepRow>& rows);

std::string table_json(const SweepTable& table);
/// Throws InputError with one line.
SweepTable read_table(const std::filesystem::path& file);
/// The one list of a folder, or those of its shards after one another. Throws InputError with one line.
SweepTable read_tables(const std::filesystem::path& folder);
/// A heading, then one line a row, with a column for each coordinate, metric and counter. [RFC 4180]
std::string table_csv(const SweepTable& table);

/// One line of JSON, with its end.
std::string row_line(const SweepRow& row);
/// All rows of a file of such lines; a last line without its end was being written when the program was
/// killed, and does not count. Throws InputError with one line.
std::vector<SweepRow> read_row_lines(const std::filesystem::path& file);

/// Puts rows of earlier runs, whatever their shard, which lie in `folder` as NAME.json and NAME.jsonl, in the
/// place of those of `table` that wait and are the same variation, judged alike and timed where `is_timed`,
/// with their picture where `has_picture`. Nothing where there is no earlier run. Returns how many. Throws
/// InputError where a list in the folder is of another sweep.
std::size_t resume_rows(SweepTable& table, const std::filesystem::path& folder, bool is_timed,
                        bool has_picture);

/// The table that one machine would have written, from those of all shards, which lie in `folders`; files of
/// pictures are relative to `out_folder`. Throws InputError where they do not belong together, and where one
/// is missing or is there twice.
SweepTable merged_tables(const std::vector<std::filesystem::path>& folders,
                         const std::filesystem::path& out_folder);

}  // namespace ir::engine
