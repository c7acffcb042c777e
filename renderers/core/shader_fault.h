#pragma once

#include <string>

namespace ir {

/// What a compiler found wrong in a shader.
struct ShaderFault {
    std::string file;         ///< relative to the shader folder; without a place in it, all of the program's
    int line = 0;             ///< from 1; 0: nobody knows
    std::string problem;      ///< one line
    std::string text = {};    ///< of that line of the file, without blanks around it
    std::string path = {};    ///< of the file on disk; empty: it is none
    bool is_changed = false;  ///< it is of an experiment's changed copy of the file, and so is its line
    bool operator==(const ShaderFault&) const = default;

    /// "FILE:LINE"
    std::string place() const { return line > 0 ? file + ":" + std::to_string(line) : file; }
    std::string message() const { return file.empty() ? problem : place() + ": " + problem; }
};

}  // namespace ir
