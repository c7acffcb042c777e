#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

/// The experiment project: document, edits, file format, results. No GL, no Qt.
namespace ir::projects {

/// Objects keep the order of their keys, so that files stay stable.
using Json = nlohmann::ordered_json;

/// Bounds that keep hostile files from exhausting stack, time or memory.
struct JsonLimits {
    std::size_t bytes = 16u << 20;
    std::size_t depth = 64;  ///< nested arrays and objects
    std::size_t keys_per_object = 1024;
};

/// Parses text of `file` (a name for messages only). Throws InputError with line and column for anything that
/// is not JSON in UTF-8, for duplicate keys and beyond the limits.
Json parse_json(std::string_view text, const std::string& file, const JsonLimits& limits = {});

/// Indented by two spaces, ends with a newline; arrays of plain numbers stand on one line; numbers in the
/// shortest form that reads back bit for bit, floating-point ones always with '.' or 'e'.
std::string pretty_json(const Json& json);

/// One line, keys sorted at every level: equal content gives equal text. Fit for hashing.
std::string canonical_json(const Json& json);

}  // namespace ir::projects
