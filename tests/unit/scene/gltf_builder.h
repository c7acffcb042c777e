#pragma once

#include <unistd.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "renderers/scene/scene.h"

namespace ir::test {

using Json = nlohmann::json;

/// A folder of its own that goes away with the object.
class TemporaryFolder {
  public:
    TemporaryFolder() {
        std::string pattern = (std::filesystem::temp_directory_path() / "interreflect-XXXXXX").string();
        path = mkdtemp(pattern.data());
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    std::filesystem::path path;
};

constexpr int type_byte = 5120, type_ubyte = 5121, type_short = 5122, type_ushort = 5123, type_uint = 5125,
              type_float = 5126;

/// Builds glTF documents piece by piece: one buffer, written embedded, beside the file or as a GLB.
class GltfBuilder {
  public:
    Json json = {{"asset", {{"version", "2.0"}}}};
    std::vector<std::uint8_t> bytes;

    template <class T>
    int view(const std::vector<T>& values, int stride = 0) {
        while (bytes.size() % 4 != 0) bytes.push_back(0);
        const auto offset = bytes.size();
        bytes.resize(offset + values.size() * sizeof(T));
        std::memcpy(bytes.data() + offset, values.data(), values.size() * sizeof(T));
        Json view = {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", values.size() * sizeof(T)}};
        if (stride > 0) view["byteStride"] = stride;
        return append("bufferViews", view);
    }

    int accessor(int view, int component_type, const std::string& type, std::size_t count,
                 std::size_t offset = 0, bool normalised = false) {
        Json accessor = {{"componentType", component_type}, {"type", type}, {"count", count}};
        if (view >= 0) accessor["bufferView"] = view;
        if (offset > 0) accessor["byteOffset"] = offset;
        if (normalised) accessor["normalized"] = true;
        return append("accessors", accessor);
    }

    int floats(const std::vector<float>& values, const std::string& type) {
        const std::size_t components = type == "SCALAR" ? 1 : type[3] - '0';
        return accessor(view(values), type_float, type, values.size() / components);
    }

    int append(const std::string& array, const Json& element) {
        json[array].push_back(element);
        return static_cast<int>(json[array].size()) - 1;
    }

    /// A mesh of one primitive, on a node of its own in the scene.
    int draw(const Json& attributes, int indices = -1, int mode = 4, const Json& node = Json::object()) {
        Json primitive = {{"attributes", attributes}, {"mode", mode}};
        if (indices >= 0) primitive["indices"] = indices;
        const int mesh = append("meshes", {{"primitives", Json::array({primitive})}});
        auto drawn = node;
        drawn["mesh"] = mesh;
        add_node(drawn);
        return mesh;
    }

    /// A root node of the scene.
    int add_node(const Json& node) {
        const int index = append("nodes", node);
        json["scene"] = 0;
        json["scenes"][0]["nodes"].push_back(index);
        return index;
    }

    /// A right triangle in the plane z = 0 that faces +Z.
    int triangle_positions() { return floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3"); }

    std::string embedded_text() const {
        auto document = json;
        if (!bytes.empty() && !document.contains("buffers"))
            document["buffers"] = {{{"byteLength", bytes.size()},
                                    {"uri", "data:application/octet-stream;base64," + base64(bytes)}}};
        return document.dump();
    }

    std::string glb_bytes() const {
        auto document = json;
        if (!bytes.empty()) document["buffers"] = {{{"byteLength", bytes.size()}}};
        auto text = document.dump();
        while (text.size() % 4 != 0) text += ' ';
        std::string binary(bytes.begin(), bytes.end());
        while (binary.size() % 4 != 0) binary += '\0';
        const auto chunks =
            word(text.size()) + "JSON" + text + word(binary.size()) + std::string("BIN\0", 4) + binary;
        return "glTF" + word(2) + word(12 + chunks.size()) + chunks;
    }

    static std::string base64(const std::vector<std::uint8_t>& data) {
        const char* alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        std::string text;
        for (std::size_t i = 0; i < data.size(); i += 3) {
            std::uint32_t bits = 0;
            for (std::size_t k = 0; k < 3; ++k) bits = (bits << 8) | (i + k < data.size() ? data[i + k] : 0);
            for (std::size_t k = 0; k < 4; ++k)
                text += k <= data.size() - i ? alphabet[(bits >> (18 - 6 * k)) & 63] : '=';
        }
        return text;
    }

  private:
    static std::string word(std::size_t value) {
        std::string text;
        for (int i = 0; i < 4; ++i) text += static_cast<char>((value >> (8 * i)) & 255);
        return text;
    }
};

inline std::string write_file(const TemporaryFolder& folder, const std::string& name,
                              const std::string& contents) {
    const auto path = folder.path / name;
    std::ofstream(path, std::ios::binary)
        .write(contents.data(), static_cast<std::streamsize>(contents.size()));
    return path.string();
}

/// A file of one triangle without cameras, whose node moves from x = 0 at 1 s to x = 4 at 3 s.
inline std::string write_moving_triangle(const TemporaryFolder& folder) {
    GltfBuilder builder;
    builder.draw({{"POSITION", builder.triangle_positions()}});
    const int input = builder.floats({1, 3}, "SCALAR");
    const int output = builder.floats({0, 0, 0, 4, 0, 0}, "VEC3");
    builder.append("animations",
                   {{"samplers", {{{"input", input}, {"output", output}}}},
                    {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}});
    return write_file(folder, "moving.gltf", builder.embedded_text());
}

inline scene::Scene load(const GltfBuilder& builder) {
    const TemporaryFolder folder;
    return scene::load_scene(write_file(folder, "test.gltf", builder.embedded_text()));
}

}  // namespace ir::test
