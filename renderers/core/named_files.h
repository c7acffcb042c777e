#pragma once

#include <filesystem>
#include <string>

/// Files that documents name. Scenes and projects may come from anybody, while their pictures are shown,
/// packed and sent on: docs/security.md says which files they reach.
namespace ir {

/// Whether `file` is `folder` or lies below it, behind all links. Neither need exist.
bool lies_within(const std::filesystem::path& file, const std::filesystem::path& folder);

enum class Links { all, to_folders };
/// Throws Error where a link below `folder` leads out of it: what is written or removed behind it is
/// elsewhere. Links to files harm nobody who replaces and removes the links themselves.
void refuse_links_out(const std::filesystem::path& folder, Links which);

/// Whether a URI begins as https: and data: do.
bool has_scheme(const std::string& uri);
/// The path that a URI without a scheme means, relative to the folder of the glTF file `gltf`:
/// percent-decoded, or as it stands where only that is there, as some writers do not escape. Empty where it
/// is no path.
std::string path_in_uri(const std::filesystem::path& gltf, const std::string& uri);

enum class NamedFile { buffer, image };
/// Whether a glTF file may read `named`: buffers and images of its own folder and below, and images, told by
/// their endings, also of the folder above and below that.
bool may_read(const std::filesystem::path& gltf, const std::filesystem::path& named, NamedFile kind);

/// What a person answers who started the program: documents of this process may name any file.
void allow_outside_files();
bool are_outside_files_allowed();

}  // namespace ir
