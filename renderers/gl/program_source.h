#pragma once

#include <compare>
#include <map>
#include <string>
#include <vector>

#include "renderers/core/changed_shaders.h"

namespace ir::gl {

/// What a program is made of. Files are relative to the shader folder and end in .vert .tesc .tese .geom
/// .frag .comp.
struct ProgramSource {
    std::vector<std::string> files;
    std::map<std::string, std::string> defines = {};
    std::string preamble = {};  ///< GLSL put after #version and defines, e.g. a generated parameter block
    std::vector<std::string> feedback = {};  ///< transform-feedback varyings, interleaved
    ShaderChanges changes = {};              ///< of files that it may be made of
    bool debugs = false;  ///< what it says of the picked pixel by lib/debug.glsl is written
    auto operator<=>(const ProgramSource&) const = default;
};

}  // namespace ir::gl
