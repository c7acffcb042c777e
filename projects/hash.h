#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "projects/json.h"

namespace ir::projects {

/// XXH3-128 as 32 lower-case hexadecimal digits.
std::string hash_bytes(std::string_view bytes);
/// Of a file's bytes, read in blocks. Throws InputError when it cannot be read.
std::string hash_file(const std::filesystem::path& file);
/// Of the canonical text: neither the order of keys nor the layout matters.
std::string hash_json(const Json& json);

}  // namespace ir::projects
