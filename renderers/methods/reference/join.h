#pragma once

#include "renderers/core/shard.h"
#include "renderers/graph/history.h"

namespace ir::methods::reference {

/// Puts the pixels of a shard's tiles into `whole`, and adds what both counted (graph::Method::join). Throws
/// Error where they are not of one picture.
void join(graph::History& whole, const graph::History& part, const Shard& shard);

}  // namespace ir::methods::reference
