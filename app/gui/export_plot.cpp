#include "app/gui/export_plot.h"

#include <QString>
#include <iostream>

#include "app/engine/interruption.h"
#include "app/engine/kept_study.h"
#include "app/engine/study_plot.h"
#include "app/gui/exports.h"
#include "app/gui/known_projects.h"
#include "projects/scene_files.h"
#include "projects/store.h"
#include "renderers/core/error.h"
#include "renderers/core/words.h"
#include "renderers/core/write_file.h"
#include "widgets/plot/plot_painter.h"

namespace ir::gui {
namespace {

bool ends_with(const std::string& file, const char* suffix) {
    return QString::fromStdString(file).endsWith(QLatin1String(suffix), Qt::CaseInsensitive);
}

const projects::ErrorPlot& plot_of(const projects::Project& project, const std::string& id) {
    if (const auto* plot = projects::find_item(project.plots, id)) return *plot;
    throw UsageError("--plot '" + id + "': the project has no such plot" +
                     known_are(id, words_of(project.plots, &projects::ErrorPlot::id)));
}

engine::ErrorStudy numbers_of(const projects::LoadedProject& loaded, const projects::ErrorPlot& plot,
                              const PlotExport& job) {
    const auto& [project, folder] = std::tie(loaded.project, loaded.folder);
    const auto kept = engine::load_study(folder, plot.id);
    if (kept && !engine::is_stale(*kept, project, plot, projects::read_contents(project, folder)))
        return kept->study;
    engine::Machine machine(job.machine);
    engine::StudyCallbacks callbacks;
    callbacks.cancel = &engine::interruption();
    callbacks.memory_budget = job.memory_budget;
    auto study = engine::run_error_study(machine, project, plot, folder, callbacks);
    if (Samples::contains(folder)) return study;  // nothing is written where the program is installed
    try {
        engine::keep_study(project, plot, folder, study);
    } catch (const Error& error) {
        std::cerr << "interreflect: note: the numbers were not kept: " << error.what() << "\n";
    }
    return study;
}

}  // namespace

void check_plot_file(const std::string& file) {
    if (!ends_with(file, ".png") && !ends_with(file, ".csv"))
        throw UsageError("--export '" + file + "': the name must end with .png or .csv");
}

void export_plot(const PlotExport& job) {
    const auto loaded = projects::load_project(job.project, engine::registry());
    const auto& plot = plot_of(loaded.project, job.plot);
    auto study = numbers_of(loaded, plot, job);
    engine::mark_front(study.points, plot.metric);
    if (ends_with(job.file, ".csv")) return write_file(job.file, engine::study_csv(study));
    const auto drawn =
        engine::draw_study(loaded.project, engine::registry(), plot, study, {plot.over, true, true});
    const auto& style = job.dark ? PlotStyle::screen() : PlotStyle::paper();
    write_picture(QString::fromStdString(job.file),
                  widgets::plot_picture(drawn.data, job.size, job.scale, style));
}

}  // namespace ir::gui
