#pragma once

#include "renderers/core/condition.h"

namespace ir::methods::photon_mapping {

/// Outputs that exist where the RSM finds first hits.
Condition from_rsm();

}  // namespace ir::methods::photon_mapping
