#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/engine/division.h"
#include "app/engine/execution.h"
#include "projects/document.h"

namespace ir::engine {

/// The parts of a kept picture that is divided among tasks: states of Experiment::shard in the project's
/// results/parts, until all are there and one task joins them. Any number of processes may work on them.
class PictureParts {
  public:
    /// `count` parts of the picture that the experiment has with its files as they are.
    PictureParts(const projects::Project& project, const projects::Experiment& experiment,
                 std::filesystem::path folder, int count);

    /// Whether the project keeps the whole picture already, with so many samples.
    bool is_kept(std::uint64_t samples) const;
    /// Makes the execution, which is that of a part, go on from what there is of it. Returns one line for
    /// what could not be used.
    std::vector<std::string> resume(Execution& execution) const;
    /// Writes the state of such an execution. Throws Error.
    void keep(const Execution& execution) const;
    /// "part 2 of 4 is not there", …; empty: all parts have as many samples.
    std::vector<std::string> missing(std::uint64_t samples) const;
    /// The state that one machine would have, to be restored by `whole`, an execution without a shard. Throws
    /// Error where parts are missing, damaged or do not belong together.
    StoredState joined(const Execution& whole) const;
    /// Once the whole is kept.
    void remove() const { parts_.remove(); }

  private:
    PictureParts(Division::Place place, int count);

    const std::string key_;  ///< state_key()
    const Division parts_;
};

/// Into how many parts the picture is divided that has some in results/parts (Division::count_at()).
int parts_of_picture(const projects::Project& project, const projects::Experiment& experiment,
                     const std::filesystem::path& folder);

}  // namespace ir::engine
