#pragma once

#include <string>

namespace ir::fuzz {

/// Loads a glTF file, looks for a camera unless it has one or none is wanted, and flattens what is not large.
/// Says whether it was loaded; it may be refused in one line. Throws std::logic_error where something does
/// not hold that must hold for any file.
bool loads_scene(const std::string& file, bool wants_camera = true);

}  // namespace ir::fuzz
