#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "renderers/core/named_files.h"

/// Where a glTF document's bytes come from: files, GLB chunks and data URIs.
namespace ir::scene::gltf {

using Bytes = std::vector<std::uint8_t>;

/// Text from a file as it may stand in a message: one line, no control characters, at most `max_length`
/// bytes.
std::string one_line(std::string_view text, std::size_t max_length = 120);

/// The whole of a regular file of at most 2 GiB. Throws InputError naming `owner` and `place` when given
/// (a file that `owner` refers to), else `file` itself.
Bytes read_file(const std::filesystem::path& file, const std::string& owner = {},
                const std::string& place = {});

/// The two chunks of a glTF file; a .gltf has no binary one.
struct Container {
    std::string json;
    Bytes binary;
    bool has_binary = false;
    bool is_binary_file = false;
};

/// Splits a GLB (known by its magic number) into its chunks. Throws InputError.
Container open_container(const std::string& file, const Bytes& bytes);

bool is_data_uri(std::string_view uri);

/// Bytes of a data URI, base64 or percent-encoded [RFC 2397]. Throws InputError.
Bytes decode_data_uri(const std::string& file, const std::string& place, std::string_view uri);

/// The file that a relative URI means. Throws InputError for a scheme such as http:, and for what a glTF file
/// must not read.
std::filesystem::path resolve_uri(const std::string& file, const std::string& place, const std::string& uri,
                                  NamedFile kind);

}  // namespace ir::scene::gltf
