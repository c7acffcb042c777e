#pragma once

namespace ir::gui {

/// The whole program: reads the command line, opens the window, returns the exit status (0 done, 1 failed, 2
/// wrong usage, 3 bad input file).
int run(int argc, char** argv);

}  // namespace ir::gui
