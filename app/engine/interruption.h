#pragma once

#include "renderers/core/progress.h"

namespace ir::engine {

/// From now on SIGINT, SIGTERM and SIGHUP do the same. The first cancels interruption(), so that whoever
/// works puts away what there is and ends with interruption_status(). One that comes half a second later or
/// more ends the program at once, with that status. What the process was started to ignore it ignores.
void watch_interruptions();

/// Cancelled by the first signal; long work looks at it between slices.
const CancelToken& interruption();

/// The exit status of an interrupted program, as shells give it: 128 and the number of the first signal.
int interruption_status();

/// Becomes readable with the first signal: for event loops.
int interruption_descriptor();

}  // namespace ir::engine
