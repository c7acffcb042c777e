#include "app/engine/analysis/analysis.h"

#include "app/engine/analysis/analysis_run.h"
#include "app/engine/number_text.h"
#include "renderers/core/error.h"
#include "renderers/core/words.h"

namespace ir::engine {

AnalysisResult run_analysis(Machine& machine, const projects::Project& project,
                            const projects::Analysis& analysis, const std::filesystem::path& folder,
                            const AnalysisCallbacks& callbacks) {
    if (const auto why_not = projects::why_not_analysed(project, analysis, registry()); !why_not.empty())
        throw UsageError("analysis '" + analysis.id + "': " + why_not);
    using Answer = AnalysisResult (*)(AnalysisRun&);
    static const std::map<std::string, Answer> answers{
        {"disagreement", disagreement}, {"sensitivity", sensitivity}, {"attribution", attribution},
        {"waterfall", waterfall},       {"divergence", divergence},   {"frames", last_frames}};
    AnalysisRun run(machine, project, analysis, folder, callbacks);
    auto result = answers.at(analysis.kind)(run);
    result.valid = run.valid();
    if (result.device.empty()) result.device = machine.context().info().renderer;
    return result;
}

std::string analysis_csv(const PlotData& data) {
    std::string text;
    for (const auto& heading : data.headings) text += (text.empty() ? "" : ",") + csv_field(heading);
    text += "\n";
    for (const auto& [point, series] : data.in_reading_order()) {
        std::string line;
        for (const auto& cell : point->cells)
            line += (&cell == &point->cells.front() ? "" : ",") +
                    (cell.number ? csv_number(*cell.number) : csv_field(cell.text));
        text += line + "\n";
    }
    return text;
}

}  // namespace ir::engine
