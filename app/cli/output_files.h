#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "projects/store.h"

namespace ir::cli {

/// The files that a command reads and writes, known before it begins. Nothing may be written over what is
/// read.
class OutputFiles {
  public:
    /// `what` it is for people: "IMAGE", "--scene". What is no file on disk is not looked at.
    void reads(const std::string& what, const std::string& file);
    /// The project's own files (projects::is_own_file). It outlives this.
    void reads(const projects::LoadedProject& project) { project_ = &project; }
    /// Throws UsageError where the file is read, is the project's, or is written for another option, too.
    /// Empty, "-" and devices are nobody's file.
    void writes(const std::string& option, const std::string& file);

  private:
    std::map<std::filesystem::path, std::string> known_;  ///< canonical; for which option
    const projects::LoadedProject* project_ = nullptr;
};

/// Whether a name ends as those of pictures that are read.
bool has_picture_ending(const std::string& file);

/// Before work whose picture goes to --out: throws UsageError for a file that is no .exr or .png, for a .png
/// that cannot hold `dumps`, and where its folder is missing.
void require_picture(const std::string& file, const std::vector<std::string>& dumps);

}  // namespace ir::cli
