#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "app/cli/command_line.h"
#include "app/cli/pixel_flags.h"
#include "app/cli/shard.h"
#include "app/engine/machine_settings.h"
#include "projects/light_spec.h"
#include "renderers/core/error.h"

namespace ir::fuzz {

/// Whether words are a command line; they may be refused, by an error of CLI11 or of ours. Each is tried as
/// the value of an option, too. Nothing is done.
inline bool understands(const std::vector<std::string>& words) {
    for (const auto& word : words)
        for (const auto& read : {
                 +[](const std::string& text) { projects::parse_size(text, "--size"); },
                 +[](const std::string& text) { projects::parse_vec3(text, "--eye"); },
                 +[](const std::string& text) { projects::parse_light(text); },
                 +[](const std::string& text) { engine::parse_bytes(text); },
                 +[](const std::string& text) { cli::chosen_shard({.text = text}); },
                 +[](const std::string& text) { cli::pixels_of(text, 4, "--inset", "x,y,w,h"); },
             })
            try {
                read(word);
            } catch (const Error&) {
            }
    try {
        static cli::CommandCheck check;
        check(words);
        return true;
    } catch (const CLI::Error&) {
        return false;
    } catch (const Error&) {
        return false;
    }
}

}  // namespace ir::fuzz
