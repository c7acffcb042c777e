#pragma once

#include <filesystem>

namespace ir {

/// Where shaders/ and samples/ are: share/interreflect beside the program's bin/ folder or, of a module in
/// another program, beside the lib/ folder that it is in, in the build tree as in an installation.
/// INTERREFLECT_DATA overrides it. Throws Error naming the places looked at.
std::filesystem::path data_directory();
std::filesystem::path shader_directory();
std::filesystem::path samples_directory();

/// Where modules are that a program loads when it needs them: lib/interreflect, beside the same folder.
std::filesystem::path module_directory();

}  // namespace ir
