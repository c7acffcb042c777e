#include "projects/gltf_references.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>

#include "projects/json_events.h"
#include "renderers/core/named_files.h"

namespace ir::projects {
namespace {

namespace fs = std::filesystem;

struct Uri {
    std::string text;
    NamedFile kind;
};

/// Keeps the value of every "uri" three levels down, {"buffers": [{"uri": …}]}, without building a tree: the
/// files may hold large embedded data.
class UriCollector final : public JsonEvents {
  public:
    std::vector<Uri> uris;

    bool string(string_t& text) override {
        if (depth_ == 3 && key_ == "uri" && (list_ == "buffers" || list_ == "images"))
            uris.push_back({text, list_ == "images" ? NamedFile::image : NamedFile::buffer});
        return true;
    }
    bool key(string_t& key) override {
        if (depth_ == 1) list_ = key;
        key_ = key;
        return true;
    }
    bool start_object(std::size_t) override { return ++depth_ > 0; }
    bool end_object() override { return depth_-- > 0; }
    bool start_array(std::size_t) override { return ++depth_ > 0; }
    bool end_array() override { return depth_-- > 0; }

  private:
    int depth_ = 0;
    std::string list_, key_;
};

std::uint32_t read_u32(std::istream& stream) {
    std::array<unsigned char, 4> b{};
    stream.read(reinterpret_cast<char*>(b.data()), 4);
    return b[0] | std::uint32_t{b[1]} << 8 | std::uint32_t{b[2]} << 16 | std::uint32_t{b[3]} << 24;
}

constexpr std::uint32_t glb_magic = 0x46546C67;  // "glTF"

/// Leaves the stream where the JSON text begins; of a binary file, known by its first bytes as the loader
/// knows it, that of its first chunk. [glTF 2.0 §4.4] Its length; 0 for what begins in no way as JSON does.
std::uintmax_t enter_json(std::istream& stream, std::uintmax_t size) {
    if (read_u32(stream) == glb_magic) {
        read_u32(stream);  // version
        read_u32(stream);  // length of the file
        const std::uintmax_t length = read_u32(stream);
        return read_u32(stream) == 0x4E4F534A && stream && length <= size ? length : 0;
    }
    stream.clear();
    stream.seekg(0);
    const bool has_mark = stream.peek() == 0xEF;  // the mark of UTF-8
    if (has_mark) stream.ignore(3);
    if ((stream >> std::ws).peek() != '{') return 0;
    return size - static_cast<std::uintmax_t>(stream.tellg());
}

/// Empty where there is none.
std::string json_text(const fs::path& file) {
    std::error_code error;
    const auto size = fs::is_regular_file(file, error) ? fs::file_size(file, error) : 0;
    std::ifstream stream(file, std::ios::binary);
    if (error || !stream || size < 2) return {};
    std::string text(enter_json(stream, size), '\0');
    stream.read(text.data(), static_cast<std::streamsize>(text.size()));
    return stream ? text : std::string{};
}

using AnyJson = nlohmann::json;  // objects of any number of keys are found quickly

double last_key(const AnyJson& document, const AnyJson& animation, const AnyJson& channel) {
    const auto path = channel.at("target").value("path", "");
    if (path != "translation" && path != "rotation" && path != "scale") return 0;
    const auto& sampler = animation.at("samplers").at(channel.at("sampler").get<std::size_t>());
    return document.at("accessors").at(sampler.at("input").get<std::size_t>()).at("max").at(0).get<double>();
}

}  // namespace

double gltf_animation_end(const fs::path& file) {
    const auto text = json_text(file);
    if (text.find("\"animations\"") == std::string::npos) return 0;
    double end = 0;
    try {
        const auto document = AnyJson::parse(text);
        if (!document.contains("animations")) return 0;
        for (const auto& animation : document.at("animations"))
            for (const auto& channel : animation.at("channels"))
                end = std::max(end, last_key(document, animation, channel));
    } catch (const std::exception&) {
        return 0;
    }
    return std::isfinite(end) ? end : 0;
}

bool is_no_gltf(const fs::path& file) {
    std::error_code error;
    if (!fs::is_regular_file(file, error)) return false;
    std::ifstream stream(file, std::ios::binary);
    if (!stream || read_u32(stream) == glb_magic) return false;
    stream.clear();
    stream.seekg(0);
    return enter_json(stream, fs::file_size(file, error)) == 0;
}

GltfReferences gltf_references(const fs::path& file) {
    UriCollector collector;
    if (!Json::sax_parse(json_text(file), &collector)) return {};
    GltfReferences references;
    for (const auto& uri : collector.uris) {
        const auto path = has_scheme(uri.text) ? std::string() : path_in_uri(file, uri.text);
        if (path.empty()) continue;
        const bool is_read = path.front() != '/' && may_read(file, file.parent_path() / path, uri.kind);
        (is_read ? references.read : references.refused).push_back(path);
    }
    return references;
}

}  // namespace ir::projects
