#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/engine/division.h"
#include "app/engine/error_study.h"
#include "renderers/core/shard.h"

namespace ir::engine {

/// The parts of a kept study whose points are divided among tasks: in the project's results/plots/parts,
/// until all are there and one task joins them.
class StudyParts {
  public:
    /// The project, with its plot, outlives this.
    StudyParts(const projects::Project& project, const projects::ErrorPlot& plot,
               const std::filesystem::path& folder, int count);

    /// Which runs of this plot the shard has. Plots begin with others, by a hash of their id, so that shards
    /// are about equally busy where a project has many plots of few points.
    Shard runs_of(const Shard& shard) const;
    /// Writes what run_error_study() gave for runs_of(). Throws Error.
    void keep(const ErrorStudy& study, const Shard& shard) const;
    /// "part 2 of 4 is not there", …; empty: all are there, and the project is as it was.
    std::vector<std::string> missing() const;
    /// The study that one machine would have. Nothing where one of the parts is missing.
    std::optional<ErrorStudy> joined(Machine& machine) const;
    /// Once the whole is kept.
    void remove() const { parts_.remove(); }

  private:
    std::optional<ErrorStudy> part(int index) const;

    const projects::Project& project_;
    const projects::ErrorPlot& plot_;
    const Division parts_;
    int first_;  ///< index of the shard that has the first run, from 0 on
};

/// Into how many parts the plot is divided that has some (Division::count_at()).
int parts_of_plot(const std::filesystem::path& folder, const std::string& plot);

}  // namespace ir::engine
