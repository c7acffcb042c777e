#pragma once

#include <QSize>
#include <string>

#include "app/engine/execution.h"

namespace ir::gui {

/// A plot of a project, to be written without a window.
struct PlotExport {
    std::string project, plot, file;  ///< .png or .csv
    engine::MachineOptions machine;   ///< that carries it out where its numbers are not kept
    std::uint64_t memory_budget = 0;  ///< bytes; 0: none
    QSize size{800, 500};
    int scale = 1;  ///< pixels of the picture for one of `size`
    bool dark = false;
};

/// Throws UsageError unless the file's name ends with .png or .csv.
void check_plot_file(const std::string& file);

/// Reads the kept numbers where they are current; otherwise carries the plot out and keeps it. Needs a
/// QApplication. Throws Error, InputError, UsageError with one line.
void export_plot(const PlotExport& job);

}  // namespace ir::gui
