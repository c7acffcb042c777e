#pragma once

#include <filesystem>

#include "renderers/core/file_system.h"
#include "renderers/core/method.h"

namespace ir::projects {

/// What somebody works on in place of a sample: samples belong to the installation, where nothing is written.
struct SampleCopy {
    std::filesystem::path folder;
    bool is_changed = false;   ///< by whoever worked on it
    bool is_outdated = false;  ///< the sample has changed since it was copied
};

/// The copy of the project folder `sample` inside `place`, which is created where it is missing. The copy
/// that is there is taken; where nobody changed or edits it, it follows the sample. Its relative sources mean
/// the files that the sample's mean. Throws Error.
SampleCopy copy_of_sample(const std::filesystem::path& sample, const std::filesystem::path& place,
                          const Registry& registry, FileSystem& files = real_file_system());

/// A name beside a copy that is free.
std::filesystem::path place_aside(const SampleCopy& copy, FileSystem& files = real_file_system());

/// Gives a copy that name, so that copy_of_sample() makes a new one. Returns where it is now. Throws Error
/// while a process edits it.
std::filesystem::path put_aside(const SampleCopy& copy, FileSystem& files = real_file_system());

}  // namespace ir::projects
