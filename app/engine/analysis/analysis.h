#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/engine/execution.h"
#include "projects/analyses.h"
#include "renderers/core/category.h"
#include "renderers/core/output.h"
#include "renderers/plot/plot_data.h"

/// Questions about experiments that renderings answer, each by a chart of bars with a table, and pictures.
namespace ir::engine {

/// How views show the buffer that a picture is of.
struct PicturedBuffer {
    Semantic semantic = Semantic::generic;
    std::string unit = {}, colour_map = {};
};

/// A picture that an analysis makes: one number a pixel, or a buffer.
struct AnalysisPicture {
    /// A layer's name. Points of the chart that are about it have the id KEY or KEY:….
    std::string key;
    std::string label, doc;
    bool has_sign = false;                  ///< numbers may be below 0
    std::vector<Category> categories = {};  ///< where numbers are names
    Image image = {};
    std::optional<PicturedBuffer> buffer = {};  ///< of which this is the picture; all are shown alike
};

/// What an analysis found.
struct AnalysisResult {
    PlotData data;  ///< bars; the cells of their points are the table
    std::vector<AnalysisPicture> pictures = {};
    Image valid = {};  ///< of all pictures, one channel: above 0.5 where pixels were compared
    std::string device = {};
};

struct AnalysisCallbacks {
    const CancelToken* cancel = nullptr;
    ProgressCallback progress = {};   ///< of all that is to be rendered
    std::uint64_t memory_budget = 0;  ///< bytes of one execution; 0: none
};

/// Renders what the answer takes, one picture after another; kept results that are current are read instead.
/// Render thread only. Throws Cancelled, Error, InputError, UsageError with one line.
AnalysisResult run_analysis(Machine& machine, const projects::Project& project,
                            const projects::Analysis& analysis, const std::filesystem::path& folder,
                            const AnalysisCallbacks& callbacks = {});

/// The table: headings, then a line for each point. [RFC 4180]
std::string analysis_csv(const PlotData& data);

}  // namespace ir::engine
