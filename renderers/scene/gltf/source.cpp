#include "renderers/scene/gltf/source.h"

#include <array>
#include <cstring>
#include <fstream>

#include "renderers/core/error.h"
#include "renderers/core/percent_decoded.h"

namespace ir::scene::gltf {
namespace {

constexpr std::uintmax_t max_file_bytes = std::uintmax_t{2} << 30;

std::uint32_t word_at(const Bytes& bytes, std::size_t offset) {
    std::uint32_t word = 0;
    for (int i = 3; i >= 0; --i) word = (word << 8) | bytes[offset + i];
    return word;
}

std::array<int, 256> base64_table() {
    std::array<int, 256> table;
    table.fill(-1);
    const char* alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (int i = 0; i < 64; ++i) table[static_cast<unsigned char>(alphabet[i])] = i;
    return table;
}

}  // namespace

std::string one_line(std::string_view text, std::size_t max_length) {
    std::string result;
    for (const char c : text.substr(0, max_length)) {
        const auto byte = static_cast<unsigned char>(c);
        result += byte < 0x20 || byte == 0x7f ? '?' : c;
    }
    if (text.size() > max_length) result += "...";
    return result;
}

Bytes read_file(const std::filesystem::path& file, const std::string& owner, const std::string& place) {
    const auto fail = [&](const std::string& problem) {
        if (owner.empty()) throw InputError(one_line(file.string(), 4096), "", problem);
        throw InputError(owner, place, one_line(file.string(), 4096) + ": " + problem);
    };
    std::error_code failure;
    const auto status = std::filesystem::status(file, failure);
    if (!std::filesystem::exists(status)) fail("no such file; check the path");
    if (!std::filesystem::is_regular_file(status)) fail("not a regular file; give the path of a file");
    const auto size = std::filesystem::file_size(file, failure);
    if (failure) fail("cannot be read: " + failure.message());
    if (size > max_file_bytes) fail("larger than 2 GiB; split the scene");
    Bytes bytes(size);
    std::ifstream stream(file, std::ios::binary);
    stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
    if (!stream && size > 0) fail("cannot be read; check its permissions");
    return bytes;
}

Container open_container(const std::string& file, const Bytes& bytes) {
    constexpr std::size_t header_bytes = 12, chunk_header_bytes = 8;
    constexpr std::uint32_t json_chunk = 0x4e4f534a, binary_chunk = 0x004e4942;
    Container result;
    if (bytes.size() < 4 || std::memcmp(bytes.data(), "glTF", 4) != 0) {
        result.json.assign(bytes.begin(), bytes.end());
        return result;
    }
    result.is_binary_file = true;
    const auto fail = [&](const std::string& problem) {
        throw InputError(file, "GLB header", problem + "; export the file again");
    };
    if (bytes.size() < header_bytes + chunk_header_bytes) fail("the file ends inside the header");
    if (word_at(bytes, 4) != 2)
        fail("version " + std::to_string(word_at(bytes, 4)) + ", only 2 is supported");
    const std::size_t length = word_at(bytes, 8);
    if (length > bytes.size()) fail("announces more bytes than the file has");
    std::size_t offset = header_bytes;
    for (int chunk = 0; offset + chunk_header_bytes <= length; ++chunk) {
        const std::size_t size = word_at(bytes, offset);
        const auto type = word_at(bytes, offset + 4);
        offset += chunk_header_bytes;
        if (size > length - offset) fail("chunk " + std::to_string(chunk) + " reaches beyond the end");
        if (chunk == 0 && type != json_chunk) fail("the first chunk is not JSON");
        const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(offset);
        const auto end = begin + static_cast<std::ptrdiff_t>(size);
        if (chunk == 0) result.json.assign(begin, end);
        if (chunk == 1 && type == binary_chunk) {
            result.binary.assign(begin, end);
            result.has_binary = true;
        }
        offset += size;
    }
    return result;
}

bool is_data_uri(std::string_view uri) {
    return uri.substr(0, 5) == "data:";
}

Bytes decode_data_uri(const std::string& file, const std::string& place, std::string_view uri) {
    static const auto table = base64_table();
    const auto comma = uri.find(',');
    if (comma == std::string_view::npos)
        throw InputError(file, place, "a data URI without data; export the file again");
    if (uri.substr(0, comma).find(";base64") == std::string_view::npos) {
        const auto text = percent_decoded(std::string(uri.substr(comma + 1)));
        return Bytes(text.begin(), text.end());
    }
    Bytes bytes;
    bytes.reserve((uri.size() - comma) / 4 * 3);
    std::uint32_t pending = 0;
    int bits = 0;
    for (const char c : uri.substr(comma + 1)) {
        if (c == '=') break;
        const int value = table[static_cast<unsigned char>(c)];
        if (value < 0) throw InputError(file, place, "a data URI that is not base64; export the file again");
        pending = (pending << 6) | static_cast<std::uint32_t>(value);
        bits += 6;
        if (bits < 8) continue;
        bits -= 8;
        bytes.push_back(static_cast<std::uint8_t>(pending >> bits));
    }
    return bytes;
}

std::filesystem::path resolve_uri(const std::string& file, const std::string& place, const std::string& uri,
                                  NamedFile kind) {
    if (has_scheme(uri))
        throw InputError(
            file, place,
            "the URI " + one_line(uri) + " has a scheme; only relative paths and data: are read");
    const auto path = path_in_uri(file, uri);
    if (path.empty()) throw InputError(file, place, "an empty or broken URI; give a relative path");
    const auto named = std::filesystem::path(file).parent_path() / path;
    if (!may_read(file, named, kind))
        throw InputError(
            file, place,
            "the URI " + one_line(uri) + " leads out of the scene's folder; put the file there" +
                (kind == NamedFile::image ? " or, as a PNG, JPEG or WebP, beside that folder" : "") +
                ", or allow it by --allow-outside");
    return named;
}

}  // namespace ir::scene::gltf
