#include <algorithm>
#include <array>
#include <map>

#include "app/engine/number_text.h"
#include "app/engine/study_plot.h"
#include "app/engine/sweep_plot.h"
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

class SweepReport {
  public:
    SweepReport(const fs::path& folder, std::size_t most, const Work& work)
        : folder_(folder),
          most_(most),
          work_(work),
          table_(engine::read_tables(folder)),
          axes_(engine::axes_of(table_)) {}

    Report make() {
        report_.title = "Sweep " + table_.sweep;
        report_.kind = "Sweep";
        report_.notes = std::to_string(table_.rows.size()) + " variations of " + table_.experiment +
                        " over " + listed(axes_) + ".";
        add_pictures();
        add_plots();
        report_.tables.push_back(variations());
        for (const auto& row : table_.rows)
            if (!row.is_done()) report_.lacks.push_back(engine::name_of(row) + ": " + row.problem);
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
                const auto file = engine::picture_of(row, folder_);
                if (file.empty()) {
                    report_.lacks.push_back("The picture of " + engine::name_of(row) +
                                            " lies outside of the folders beside its list; --allow-outside "
                                            "reads it.");
                    continue;
                }
                auto picture = read_picture(engine::name_of(row), file);
                picture.caption = caption_of(row);
                const auto& image = picture.side.image;
                const std::array size{image.width, image.height, image.channels};
                auto& gallery = by_size[size];
                judged.push_back({&gallery, gallery.pictures.size(), engine::reference_of(row, folder_)});
                gallery.pictures.push_back(std::move(picture));
                ++taken;
            } catch (const InputError&) {
                report_.lacks.push_back("The picture of " + engine::name_of(row) + " cannot be read.");
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

    /// A picture in its gallery, and the file of its ground truth; empty: it has none.
    struct Judged {
        Gallery* gallery;
        std::size_t place;
        fs::path reference;
    };

    void add_references(const std::vector<Judged>& judged) {
        std::map<fs::path, std::size_t> known;  ///< places in their galleries
        for (const auto& [gallery, place, file] : judged) {
            std::error_code ignored;
            if (!fs::is_regular_file(file, ignored)) continue;
            if (!known.count(file)) {
                const auto number = known.size() + 1;
                try {
                    auto picture =
                        read_picture(number == 1 ? "Reference" : "Reference " + std::to_string(number), file);
                    picture.caption = "Ground truth";
                    gallery->pictures.push_back(std::move(picture));
                } catch (const InputError&) {
                    report_.lacks.push_back("The ground truth " + file.stem().string() + " cannot be read.");
                    continue;
                }
                known[file] = gallery->pictures.size() - 1;
            }
            gallery->pairs.push_back({.a = place, .b = known[file], .is_offered = false});
        }
    }

    static std::string caption_of(const SweepRow& row) {
        std::string caption = plot_number(engine::time_of(row)) + " ms";
        if (const auto error = row.errors.find("rmse"); error != row.errors.end())
            caption += ", RMSE " + plot_number(error->second);
        return caption;
    }

    /// Error over time, over each axis of numbers, and over the first two axes.
    void add_plots() {
        const auto names = engine::measured_metrics(table_);
        const std::string metric = "rmse";
        if (std::find(names.begin(), names.end(), metric) == names.end()) return;
        report_.plots.push_back({engine::sweep_plot(table_, "", metric), "", ""});
        for (const auto& axis : engine::number_axes_of(table_))
            report_.plots.push_back({engine::sweep_plot(table_, axis, metric), "", ""});
        if (axes_.size() > 1)
            report_.plots.push_back({engine::sweep_heat(table_, axes_[0], axes_[1], metric), "", ""});
    }

    Table variations() const {
        Table table{"Variations", {{"Variation"}}, {}, {}};
        const auto names = engine::measured_metrics(table_);
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
    const std::vector<std::string> axes_;
    Report report_;
};

}  // namespace

Report report_of_sweep(const fs::path& folder, std::size_t pictures, const Work& work) {
    return SweepReport(folder, pictures, work).make();
}

}  // namespace ir::report
