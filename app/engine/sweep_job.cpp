#include "app/engine/sweep_job.h"

#include <algorithm>
#include <chrono>
#include <fstream>
#include <map>

#include "app/engine/pictures.h"
#include "projects/results.h"
#include "projects/scene_files.h"
#include "renderers/core/error.h"
#include "renderers/core/named_files.h"
#include "renderers/core/write_file.h"

namespace ir::engine {
namespace {

namespace fs = std::filesystem;

class SweepFiles {
  public:
    SweepFiles(const SweepJob& job, const SweepTable& table)
        : list_(job.list()), lines_(job.lines()), table_(table) {
        std::string text;
        for (const auto& row : table.rows)
            if (row.is_done()) text += row_line(row);
        write_file(lines_, text);
        stream_.open(lines_, std::ios::binary | std::ios::app);
        write_list();
    }

    /// A row of the table is complete.
    void put(const SweepRow& row) {
        stream_ << row_line(row) << std::flush;
        if (!stream_) throw Error(lines_.string() + ": cannot be written; is the disk full?");
        if (Clock::now() - written_ > std::chrono::seconds(1) + 20 * writing_) write_list();
    }
    void write_list() {
        const auto start = Clock::now();
        write_file(list_, table_json(table_));
        written_ = Clock::now();
        writing_ = written_ - start;
    }

  private:
    using Clock = std::chrono::steady_clock;
    const fs::path list_, lines_;
    const SweepTable& table_;
    std::ofstream stream_;
    Clock::time_point written_;
    Clock::duration writing_{0};
};

void render_rows(SweepRun& variations, const SweepJob& job, const std::vector<projects::SweepPoint>& points,
                 const SweepCallbacks& told, SweepTable& table, SweepFiles& files) {
    for (std::size_t i = 0; i < points.size(); ++i) {
        auto& row = table.rows[i];
        if (row.is_done()) continue;
        if (told.begun) told.begun(i, points[i]);
        bool was_refused = row.problem != SweepRow::not_rendered;
        const auto pictured = [&](const Execution& execution, const FrameReport& report) {
            if (told.seen) told.seen(execution, report);
            return job.has_pictures ? write_variation(job.out, row.id, execution, report, job.dumps)
                                    : std::string();
        };
        if (!was_refused) variations.render(points[i], row, pictured, was_refused);
        files.put(row);
        if (told.ended) told.ended(i, row, was_refused);
    }
}

}  // namespace

std::string write_variation(const fs::path& folder, const std::string& id, const Execution& execution,
                            const FrameReport& report, const std::vector<std::string>& dumps) {
    const auto stem = (folder / id).string();
    write_picture(stem + ".exr", execution, dumps);
    write_picture(stem + ".png", execution, {});
    write_file(stem + ".json", statistics_json(execution, report) + "\n");
    return id + ".exr";
}

void run_sweep(Machine& machine, const SweepJob& job, const std::vector<projects::SweepPoint>& points,
               const SweepCallbacks& told, SweepTable& table) {
    SweepOptions options;
    options.is_judged = job.is_judged;
    options.samples = job.samples;
    options.repeats = job.repeats;
    options.references = job.out / references_folder;
    options.frame = told.frame;
    options.note = told.note;
    SweepRun variations(machine, job.project, job.folder, options);
    std::vector<SweepRow> rows;
    for (const auto& point : points) rows.push_back(variations.planned(point));
    table = {job.sweep.id, job.sweep.experiment, sweep_plan(rows), job.shard, part_of(rows, job.shard)};
    const auto resumed =
        job.resumes ? resume_rows(table, job.out, job.repeats > 0, job.has_pictures) : std::size_t{0};
    if (told.planned) told.planned(table, resumed);
    SweepFiles files(job, table);
    try {
        render_rows(variations, job, part_of(points, job.shard), told, table, files);
    } catch (const Cancelled&) {
        files.write_list();
        throw;
    } catch (...) {  // the device is lost, the disk is full
        try {
            files.write_list();
        } catch (const Error&) {  // what went wrong first is told
        }
        throw;
    }
    files.write_list();
}

void run_sweep_request(const SweepRequest& request, const SweepCallbacks& callbacks) {
    const auto points = projects::sweep_points(request.job.project, request.job.sweep, registry());
    refuse_links_out(request.job.folder / "results", Links::all);
    real_file_system().create_directories(request.job.out);
    auto told = callbacks;
    told.frame.memory_budget = request.memory_budget;
    Machine machine(request.machine);
    SweepTable table;
    run_sweep(machine, request.job, points, told, table);
}

SweepSheet look_at_sweep(const SweepJob& job, const Registry& registry,
                         const std::function<bool()>& is_cancelled) {
    SweepSheet sheet;
    std::vector<SweepTable> lists;  // shards may have rendered what the whole one lacks
    try {
        for (const auto& file : sweep_lists(job.out)) lists.push_back(read_table(file));
    } catch (const Error& error) {
        sheet.problem = error.what();
    }
    const bool is_own = std::ranges::all_of(lists, [&](const SweepTable& list) {
        return list.sweep == job.sweep.id && list.experiment == job.sweep.experiment;
    });
    std::vector<projects::SweepPoint> points;
    try {
        if (is_own) points = projects::sweep_points(job.project, job.sweep, registry);
    } catch (const Error& error) {
        sheet.refused = error.what();
    }
    if (points.empty()) {
        sheet.is_foreign = !lists.empty();
        try {
            if (sheet.is_foreign) sheet.table = read_tables(job.out);
        } catch (const Error& error) {
            sheet.problem = error.what();
        }
        sheet.stale.resize(sheet.table.rows.size());
        return sheet;
    }
    std::map<std::string, SweepRow*> by_id;
    for (auto& list : lists)
        for (auto& row : list.rows)
            if (auto& known = by_id[row.id]; !known || (row.is_done() && !known->is_done())) known = &row;
    const auto now = projects::with_contents(job.project, projects::read_contents(job.project, job.folder));
    sheet.table = {job.sweep.id, job.sweep.experiment, {}, {}, {}};
    for (const auto& point : points) {
        if (is_cancelled()) return sheet;
        SweepRow row;
        row.id = point.experiment.id;
        row.coordinates = point.coordinates;
        row.key = projects::result_key(now, point.experiment, registry);
        bool is_stale = false;
        if (const auto found = by_id.find(row.id);
            found != by_id.end() && found->second->coordinates == row.coordinates) {
            is_stale = found->second->is_done() && found->second->key != row.key;
            row = std::move(*found->second);
        }
        sheet.stale.push_back(is_stale);
        sheet.table.rows.push_back(std::move(row));
    }
    return sheet;
}

}  // namespace ir::engine
