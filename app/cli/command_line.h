#pragma once

namespace ir::cli {

/// The program: what its arguments ask for, and the status that it ends with.
int run_command_line(int argc, char** argv);

}  // namespace ir::cli
