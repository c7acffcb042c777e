#pragma once

#include <string>
#include <vector>

#include "app/engine/experiment.h"
#include "renderers/core/inspection.h"
#include "renderers/core/report.h"

namespace ir::cli {

/// What --pick and --choose say.
struct InspectionFlags {
    std::string pick;                  ///< "x,y"; empty: no pixel
    std::vector<std::string> chooses;  ///< "selector=item" or "selector=all"
};

/// Throws UsageError that says what is allowed.
Inspection parse_inspection(const InspectionFlags& flags, const engine::Experiment& experiment);

/// A warning when a pixel is picked that the picture does not have.
std::vector<Message> inspection_warnings(const Inspection& inspection, const engine::Experiment& experiment);

}  // namespace ir::cli
