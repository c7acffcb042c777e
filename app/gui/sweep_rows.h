#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "app/engine/sweep_job.h"
#include "app/engine/sweep_plot.h"
#include "widgets/sweeps/sweep_panel.h"

/// The results of a sweep as its panel shows them.
namespace ir::gui {

/// Of a table: what varies, and the numbers that rows have.
struct SweepColumns {
    std::vector<std::string> axes;
    std::vector<engine::SweepQuantity> quantities;
    bool operator==(const SweepColumns&) const = default;
};
SweepColumns sweep_columns(const engine::SweepTable& table);

/// Without lines.
widgets::SweepRows sweep_headings(const SweepColumns& columns);
/// `folder`: of the lists. `is_running`: the row is being rendered.
widgets::SweepLine sweep_line(const engine::SweepSheet& sheet, const SweepColumns& columns, std::size_t row,
                              const std::filesystem::path& folder, bool is_running);

struct SweepPlotChoice {
    std::string plot, quantity;  ///< ids; others than there are stand for the usual ones
};
/// What can be drawn, and the choice.
void fill_sweep_plot(widgets::SweepFields& fields, const engine::SweepTable& table,
                     const SweepColumns& columns, const SweepPlotChoice& choice);
/// As the fields have been filled.
void draw_sweep_plot(widgets::SweepFields& fields, const engine::SweepTable& table);

}  // namespace ir::gui
