#pragma once

namespace ir::engine {

/// Lets the calling thread, and the threads that it starts from now on, give way to others: the window
/// answers although the renderer takes all that is left. Does nothing where the system has no such thing.
void give_way_to_others();

}  // namespace ir::engine
