#pragma once

#include <string>
#include <vector>

namespace ir::cli {

/// "a,b" as {"a", "b"}.
std::vector<std::string> split_at_commas(const std::string& text);

/// As many numbers, of an option whose value has that form. Throws UsageError.
std::vector<double> numbers_of(const std::string& text, std::size_t count, const std::string& option,
                               const std::string& form);
/// Whole numbers of pixels.
std::vector<int> pixels_of(const std::string& text, std::size_t count, const std::string& option,
                           const std::string& form);

}  // namespace ir::cli
