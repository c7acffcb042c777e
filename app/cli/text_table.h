#pragma once

#include <ostream>
#include <set>
#include <string>
#include <vector>

namespace ir::cli {

/// Columns as wide as they need; those of numbers to the right.
void print_table(std::ostream& out, const std::vector<std::vector<std::string>>& rows,
                 const std::set<std::size_t>& numbers);

}  // namespace ir::cli
