#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "app/engine/number_text.h"
#include "app/engine/study_plot.h"
#include "app/engine/sweep_table.h"
#include "app/report/describe.h"
#include "app/report/make_report.h"
#include "renderers/core/error.h"
#include "renderers/core/words.h"
#include "renderers/image/metrics.h"
#include "renderers/plot/plot_scale.h"

namespace ir::report {
namespace {

namespace fs = std::filesystem;
using engine::SweepRow, engine::SweepTable, engine::value_text;

/// "directions = 64, seed = 2"
std::string name_of(const SweepRow& row) {
    std::string name;
    for (const auto& [key, value] : row.coordinates.items())
        name += (name.empty() ? "" : ", ") + key + " = " + value_text(value);
    return name.empty() ? row.id : name;
}

double time_of(const SweepRow& row) {
    return row.warm_ms.value_or(row.cold_ms);
}

/// The one list of a folder, or those of its shards after one another.
SweepTable read_tables(const fs::path& folder) {
    const auto lists = engine::sweep_lists(folder);
    if (lists.empty())
        throw InputError(folder.string(), "",
                         "has no list of a sweep (sweep.json); `sweep PROJECT NAME --out` writes one");
    for (const auto& list : lists)
        if (list.stem() == engine::table_name({})) return engine::read_table(list);
    auto table = engine::read_table(lists.front());
    for (std::size_t i = 1; i < lists.size(); ++i) {
        const auto next = engine::read_table(lists[i]);
        if (next.plan != table.plan)
            throw InputError(lists[i].string(), "",
                             "is of another sweep than " + lists.front().filename().string());
        table.rows.insert(table.rows.end(), next.rows.begin(), next.rows.end());
    }
    return table;
}

class SweepReport {
  public:
    SweepReport(const fs::path& folder, std::size_t most, const Work& work)
        : folder_(folder), most_(most), work_(work), table_(read_tables(folder)) {
        for (const auto& row : table_.rows)
            for (const auto& [key, value] : row.coordinates.items())
                if (std::find(axes_.begin(), axes_.end(), key) == axes_.end()) axes_.push_back(key);
    }

    Report make() {
        report_.title = "Sweep " + table_.sweep;
        report_.kind = "Sweep";
        report_.notes = std::to_string(table_.rows.size()) + " variations of " + table_.experiment +
                        " over " + listed(axes_) + ".";
        add_pictures();
        add_plots();
        report_.tables.push_back(variations());
        for (const auto& row : table_.rows)
            if (!row.is_done()) report_.lacks.push_back(name_of(row) + ": " + row.problem);
        report_.settings = settings_of(report_.galleries);
        report_.provenance = provenance_of(report_.galleries);
        return std::move(report_);
    }

  private:
    /// By size; ground truths stand last.
    void add_pictures() {
        std::map<std::array<int, 3>, Gallery> by_size;  // width, height, channels
        std::vector<Judged> judged;
        std::size_t there = 0, taken = 0;
        for (const auto& row : table_.rows) {
            if (row.image.empty()) continue;
            if (++there > most_) continue;
            work_.tell("Reading " + row.id, 0.5 * double(there) / double(table_.rows.size()));
            try {
                if (!is_own(row.image)) throw InputError(row.image, "", "is no picture of a sweep");
                auto picture = read_picture(name_of(row), folder_ / row.image);
                picture.caption = caption_of(row);
                const auto& image = picture.side.image;
                const std::array size{image.width, image.height, image.channels};
                auto& gallery = by_size[size];
                judged.push_back({&gallery, gallery.pictures.size(), row.reference});
                gallery.pictures.push_back(std::move(picture));
                ++taken;
            } catch (const InputError&) {
                report_.lacks.push_back("The picture of " + name_of(row) + " cannot be read.");
            }
        }
        if (there > most_)
            report_.lacks.push_back(std::to_string(taken) + " of " + std::to_string(there) +
                                    " pictures are shown; --pictures N takes more.");
        if (there == 0)
            report_.lacks.push_back(
                "There are no pictures: sweeps that are measured keep them with --keep alone.");
        add_references(judged);
        for (auto& [size, gallery] : by_size) {
            gallery.title =
                by_size.size() == 1 ? "Pictures" : std::to_string(size[0]) + " × " + std::to_string(size[1]);
            gallery.shown = shown_range(gallery.pictures);
            report_.galleries.push_back(std::move(gallery));
        }
    }

    /// What a list may name: the page takes along no other file of this computer.
    static bool is_own(const fs::path& image) { return image.is_relative() && image.extension() == ".exr"; }

    /// A picture in its gallery, and the key of its ground truth; empty: it has none.
    struct Judged {
        Gallery* gallery;
        std::size_t place;
        std::string reference;
    };

    void add_references(const std::vector<Judged>& judged) {
        std::map<std::string, std::size_t> known;  ///< places in their galleries, by key
        for (const auto& [gallery, place, key] : judged) {
            const auto file = folder_ / "references" / (key + ".exr");
            std::error_code ignored;
            if (key.empty() || fs::path(key).has_parent_path() || !fs::is_regular_file(file, ignored))
                continue;
            if (!known.count(key)) {
                const auto number = known.size() + 1;
                try {
                    auto picture =
                        read_picture(number == 1 ? "Reference" : "Reference " + std::to_string(number), file);
                    picture.caption = "Ground truth";
                    gallery->pictures.push_back(std::move(picture));
                } catch (const InputError&) {
                    report_.lacks.push_back("The ground truth " + key + " cannot be read.");
                    continue;
                }
                known[key] = gallery->pictures.size() - 1;
            }
            gallery->pairs.push_back({.a = place, .b = known[key], .is_offered = false});
        }
    }

    static std::string caption_of(const SweepRow& row) {
        std::string caption = plot_number(time_of(row)) + " ms";
        if (const auto error = row.errors.find("rmse"); error != row.errors.end())
            caption += ", RMSE " + plot_number(error->second);
        return caption;
    }

    std::vector<std::string> measured_metrics() const {
        std::vector<std::string> names;
        for (const auto& name : metric_names())
            for (const auto& row : table_.rows)
                if (row.errors.count(name)) {
                    names.push_back(name);
                    break;
                }
        return names;
    }

    /// Error over time, and over each axis of numbers.
    void add_plots() {
        const auto names = measured_metrics();
        const auto metric = std::find(names.begin(), names.end(), "rmse") != names.end() ? "rmse" : "";
        if (!*metric) return;
        report_.plots.push_back({drawn("", metric), "", ""});
        for (const auto& axis : axes_) {
            std::set<std::string> values;
            bool is_number = true;
            for (const auto& row : table_.rows) {
                const auto& value = row.coordinates.value(axis, projects::Json());
                values.insert(value.dump());
                is_number = is_number && value.is_number();
            }
            if (is_number && values.size() > 1) report_.plots.push_back({drawn(axis, metric), "", ""});
        }
    }

    /// One series for each combination of the other axes; `over` is empty for the time.
    PlotData drawn(const std::string& over, const std::string& metric) const {
        PlotData data;
        data.title = engine::metric_heading(metric) + (over.empty() ? " over time" : " over " + over);
        data.y.title = engine::metric_heading(metric);
        data.x.title = over.empty() ? "Time of rendering (ms)" : over;
        std::vector<engine::ErrorPoint> points;
        for (const auto& row : table_.rows) {
            const auto error = row.errors.find(metric);
            if (!row.is_done() || error == row.errors.end()) continue;
            engine::ErrorPoint point;
            point.experiment = row.id;
            point.ms = time_of(row);
            point.errors = row.errors;
            points.push_back(point);
        }
        engine::mark_front(points, metric);
        bool has_log_x = true, has_log_y = true;
        std::map<std::string, std::size_t> series;
        for (const auto& row : table_.rows) {
            const auto point = std::find_if(points.begin(), points.end(),
                                            [&](const auto& each) { return each.experiment == row.id; });
            if (point == points.end()) continue;
            PlotPoint at;
            at.id = row.id;
            at.x = over.empty() ? point->ms : row.coordinates.at(over).get<double>();
            at.y = point->errors.at(metric);
            at.ring = over.empty() && point->on_front;
            at.label = name_of(row) + "\n" + plot_number(point->ms) + " ms\n" +
                       engine::metric_heading(metric) + " " + plot_number(at.y);
            has_log_x = has_log_x && at.x > 0;
            has_log_y = has_log_y && at.y >= 0;
            const auto name = other_axes(row, over.empty() && !axes_.empty() ? axes_.back() : over);
            const auto [found, is_new] = series.emplace(name, data.series.size());
            if (is_new) data.series.push_back({name.empty() ? table_.experiment : name, {}});
            data.series[found->second].points.push_back(std::move(at));
        }
        data.x.log = has_log_x;
        data.y.log = has_log_y;
        data.ring_name = "front: no other is faster and better";
        data.join_rings = over.empty();
        return data;
    }

    std::string other_axes(const SweepRow& row, const std::string& axis) const {
        SweepRow others = row;
        others.coordinates.erase(axis);
        return others.coordinates.empty() ? "" : name_of(others);
    }

    Table variations() const {
        Table table{"Variations", {{"Variation"}}, {}, {}};
        const auto names = measured_metrics();
        for (const auto& axis : axes_) table.headings.push_back({axis});
        table.headings.push_back({"Cold (ms)", {}, false, "The first run, which makes buffers and programs"});
        table.headings.push_back({"Warm (ms)", {}, false, "The median of later runs"});
        for (const auto& name : names)
            table.headings.push_back({engine::metric_heading(name), {}, false, metric(name).doc});
        const auto number = [](double value) { return Cell{plot_number(value), value}; };
        for (const auto& row : table_.rows) {
            std::vector<Cell> cells{{row.id}};
            for (const auto& axis : axes_)
                cells.push_back({value_text(row.coordinates.value(axis, projects::Json()))});
            cells.push_back(row.is_done() ? number(row.cold_ms) : Cell{"—"});
            cells.push_back(row.warm_ms ? number(*row.warm_ms) : Cell{"—"});
            for (const auto& name : names)
                cells.push_back(row.errors.count(name) ? number(row.errors.at(name)) : Cell{"—"});
            table.rows.push_back(std::move(cells));
        }
        return table;
    }

    const fs::path folder_;
    const std::size_t most_;
    const Work& work_;
    const SweepTable table_;
    std::vector<std::string> axes_;
    Report report_;
};

}  // namespace

Report report_of_sweep(const fs::path& folder, std::size_t pictures, const Work& work) {
    return SweepReport(folder, pictures, work).make();
}

}  // namespace ir::report
