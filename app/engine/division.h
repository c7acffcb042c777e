#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace ir::engine {

// Parts of what is divided among tasks: files in one folder, BEGIN-2-of-4.EXTENSION.

std::string part_name(const std::string& begin, int index, int count);
/// "part 2 of 4"
std::string part_text(int index, int count);
/// Into how many parts it is divided: the largest number of which all files are there, else the largest. 0:
/// there is none.
int division_of(const std::filesystem::path& folder, const std::string& begin, const std::string& extension);
/// Removes all parts, and the folder where nothing else is in it.
void remove_parts(const std::filesystem::path& folder, const std::string& begin, int count,
                  const std::string& extension);

}  // namespace ir::engine
