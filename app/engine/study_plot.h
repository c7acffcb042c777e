#pragma once

#include <string>

#include "app/engine/error_study.h"
#include "projects/document.h"
#include "renderers/core/method.h"
#include "renderers/plot/plot_data.h"

namespace ir::engine {

/// How a study is drawn: what of it the document does not say.
struct PlotLook {
    std::string over;  ///< what the study ran over, which the plot may have left since
    bool log_x = true, log_y = true;
};

/// A study as a plot, and why an axis of it cannot be logarithmic.
struct DrawnStudy {
    PlotData data;
    std::string why_no_log_x, why_no_log_y;
};

DrawnStudy draw_study(const projects::Project& project, const Registry& registry,
                      const projects::ErrorPlot& plot, ErrorStudy study, const PlotLook& look);

/// Of a point in its study: experiment and value.
std::string point_id(const ErrorPoint& point);
const ErrorPoint* find_point(const ErrorStudy& study, const std::string& id);

/// A value as people write it: "256", "tangent-plane", "640×480".
std::string value_text(const projects::Json& value);

/// "RMSE", "PSNR (dB)": for axes and headings.
std::string metric_heading(const std::string& name);

}  // namespace ir::engine
