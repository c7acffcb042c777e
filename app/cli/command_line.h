#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace ir::cli {

/// The program: what its arguments ask for, and the status that it ends with.
int run_command_line(int argc, char** argv);

/// Knows all commands and their options, and does nothing with them. Making one takes far longer than a
/// check.
class CommandCheck {
  public:
    CommandCheck();
    ~CommandCheck();
    /// Throws CLI::ParseError where the program would not take these arguments.
    void operator()(std::vector<std::string> arguments);

  private:
    struct Commands;
    const std::unique_ptr<Commands> commands_;
};

inline void check_command(std::vector<std::string> arguments) {
    CommandCheck()(std::move(arguments));
}

}  // namespace ir::cli
