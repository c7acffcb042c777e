#pragma once

#include <QString>
#include <vector>

#include "projects/document.h"
#include "renderers/core/method.h"
#include "widgets/document/edit_maker.h"
#include "widgets/parameters/option.h"

/// What can be chosen of a plot, wherever it is edited.
namespace ir::widgets {

/// Frames, the seed, and the parameters of the experiments' methods, as these call them.
std::vector<Option> plot_key_options(const projects::Project& project, const projects::ErrorPlot& plot,
                                     const Registry& registry);
std::vector<Option> metric_options();

/// The plot's values as people type them, and what they stand for while there are none.
QString plot_values_text(const projects::ErrorPlot& plot);
QString plot_values_hint(const projects::ErrorPlot& plot);

/// Values as typed, for the key that the plot has.
EditMaker set_plot_values(const std::string& plot, const std::string& text);
/// Another key. The old one's values mean nothing there: it begins with what the first experiment has.
EditMaker set_plot_key(const std::string& plot, const std::string& key);
EditMaker set_plot_metric(const std::string& plot, const std::string& metric);
EditMaker set_plot_axis(const std::string& plot, bool against_time);

}  // namespace ir::widgets
