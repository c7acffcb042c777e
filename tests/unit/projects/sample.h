#pragma once

#include <filesystem>
#include <string>

#include "projects/document_json.h"

/// Shared by the tests of projects: two made-up methods, and a project that uses every part of the schema.
namespace ir::projects::testing {

/// Methods "fog" (version 3, with parameters of every type and the transport) and "plain" (few parameters).
const Registry& registry();

/// A project whose every list but that of analyses, which no frozen file has, has items, in the newest
/// schema, all values complete.
Project sample_project();

/// A folder of its own for a test, removed at the end.
class TemporaryFolder {
  public:
    enum class Place { disk, memory };
    /// In memory, where the machine has such a place: for tests that write a lot and model the disk
    /// themselves.
    explicit TemporaryFolder(Place place = Place::disk);
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

/// Writes the files of the sample's scenes, light and image below a project's folder.
void write_sample_files(const std::filesystem::path& folder);
/// The sample without hashes of those.
Project unhashed_sample();
bool mentions(const std::vector<Message>& messages, const std::string& text);

std::string read_text(const std::filesystem::path& file);
void write_text(const std::filesystem::path& file, const std::string& text);

/// Reads text as a project of the fake registry.
inline ReadProject read(const std::string& text) {
    return read_project(text, "test.json", registry());
}

}  // namespace ir::projects::testing
