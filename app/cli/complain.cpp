#include "app/cli/complain.h"

#include <iostream>

#include "app/cli/command.h"
#include "projects/text.h"

namespace ir::cli {

void complain(const std::string& line) {
    constexpr std::size_t longest_line = 4096;
    std::cerr << "interreflect-cli: " << projects::printable(line, longest_line) << "\n";
}

int status_of(const Error& error) {
    return is_refusal(error) ? bad_input : failed;
}

}  // namespace ir::cli
