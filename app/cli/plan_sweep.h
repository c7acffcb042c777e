#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "app/cli/command.h"
#include "app/engine/sweep_run.h"
#include "projects/store.h"

namespace ir::cli {

/// A sweep whose cost is to be told. `options` are those that it would run with.
struct SweepPlan {
    const MachineFlags& machine;
    const projects::LoadedProject& loaded;
    std::vector<projects::SweepPoint> points;
    engine::SweepOptions options;
    bool has_pictures = false;
    std::vector<std::string> dumps = {};
    std::size_t probes = 0;  ///< variations to measure; 0: as many as are enough
    bool as_json = false, is_quiet = false;
};

/// Measures some variations and prints what all take: seconds, bytes on disk, memory. Nothing of them is
/// kept.
int plan_sweep(SweepPlan plan);

}  // namespace ir::cli
