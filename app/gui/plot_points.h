#pragma once

#include <string>

#include "app/engine/error_study.h"
#include "projects/document.h"
#include "renderers/core/method.h"
#include "widgets/plot/plot_data.h"

namespace ir::gui {

/// How a study is drawn: what of it the document does not say.
struct PlotLook {
    std::string over;  ///< what the study ran over, which the plot may have left since
    bool log_x = true, log_y = true;
};

/// A study as a plot, and why an axis of it cannot be logarithmic.
struct DrawnStudy {
    widgets::PlotData data;
    QString why_no_log_x, why_no_log_y;
};

DrawnStudy draw_study(const projects::Project& project, const Registry& registry,
                      const projects::ErrorPlot& plot, engine::ErrorStudy study, const PlotLook& look);

/// Of a point in its study: experiment and value.
QString point_id(const engine::ErrorPoint& point);
const engine::ErrorPoint* find_point(const engine::ErrorStudy& study, const QString& id);

/// A value as people write it: "256", "tangent-plane".
QString value_text(const projects::Json& value);

}  // namespace ir::gui
