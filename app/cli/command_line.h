#pragma once

#include <string>
#include <vector>

namespace ir::cli {

/// The program: what its arguments ask for, and the status that it ends with.
int run_command_line(int argc, char** argv);

/// Throws CLI::ParseError where the program would not take these arguments.
void check_command(std::vector<std::string> arguments);

}  // namespace ir::cli
