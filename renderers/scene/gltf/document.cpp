#include "renderers/scene/gltf/document.h"

#include "renderers/core/error.h"
#include "renderers/core/hash.h"
#include "renderers/scene/gltf/compression.h"

namespace ir::scene::gltf {
namespace {

/// Parsers and destructors recurse, so nesting is limited before anything is built.
void check_nesting(const std::string& file, const std::string& text) {
    constexpr int max_depth = 64;
    int depth = 0;
    bool in_string = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (in_string) {
            if (c == '\\') ++i;
            if (c == '"') in_string = false;
            continue;
        }
        if (c == '"') in_string = true;
        if (c == '[' || c == '{') ++depth;
        if (c == ']' || c == '}') --depth;
        if (depth > max_depth)
            throw InputError(file, "byte " + std::to_string(i),
                             "JSON nested deeper than 64 levels; remove the extras that need it");
    }
}

Json parse(const std::string& file, const std::string& text) {
    check_nesting(file, text);
    try {
        auto json = Json::parse(text);
        if (!json.is_object()) throw InputError(file, "", "not a glTF document; give a .gltf or .glb file");
        return json;
    } catch (const Json::parse_error& error) {
        throw InputError(file, "byte " + std::to_string(error.byte),
                         "not valid JSON; give a .gltf or .glb file that was exported completely");
    } catch (const Json::exception&) {
        throw InputError(file, "", "JSON with a number out of range; export the file again");
    }
}

/// Bytes of a buffer or image URI; external files go to the hash.
Bytes load_uri(Document& document, Hasher& hasher, const std::string& place, const std::string& uri,
               NamedFile kind) {
    if (is_data_uri(uri)) return decode_data_uri(document.file, place, uri);
    auto bytes = read_file(resolve_uri(document.file, place, uri, kind), document.file, place);
    hasher.add(std::as_bytes(std::span(bytes)));
    document.total_bytes += bytes.size();
    return bytes;
}

/// A buffer that a program without EXT_meshopt_compression would need, and that the file does without.
bool stands_for_compressed(const CheckedObject& buffer) {
    const auto* extension = buffer.extension(meshopt_compression);
    return extension && extension->value("fallback", Json()) == Json(true);
}

void load_buffers(Document& document, Checking& checking, Container& container, Hasher& hasher) {
    for (std::size_t i = 0; i < checking.count("buffers"); ++i) {
        CheckedObject buffer(document.file, element("buffers", i), checking.source["buffers"][i]);
        const auto length = buffer.required(buffer.integer("byteLength", 1, INT32_MAX), "byteLength");
        const auto uri = buffer.text("uri");
        auto& data = document.buffers.emplace_back();
        if (uri) {
            data.bytes = load_uri(document, hasher, buffer.place("uri"), *uri, NamedFile::buffer);
        } else if (i == 0 && container.has_binary) {
            data.bytes = std::move(container.binary);
        } else {
            if (!stands_for_compressed(buffer))
                document.warnings.add(buffer.place() + " has no data; it reads as zeros");
            continue;
        }
        data.present = true;
        if (data.bytes.size() < static_cast<std::size_t>(length))
            buffer.fail("byteLength", "is " + std::to_string(length) + ", but there are only " +
                                          std::to_string(data.bytes.size()) +
                                          " bytes; export the file again");
    }
}

Bytes image_bytes(Document& document, const Checking& checking, CheckedObject& image, Hasher& hasher) {
    if (const auto uri = image.text("uri"))
        return load_uri(document, hasher, image.place("uri"), *uri, NamedFile::image);
    const auto view = image.index("bufferView", checking.count("bufferViews"), "bufferViews");
    if (!view) image.fail("uri", "is missing, as is bufferView; export the file again");
    const auto& fields = checking.checked["bufferViews"][*view];
    const auto& buffer = document.buffers[fields["buffer"].get<std::size_t>()];
    if (!buffer.present) image.fail("bufferView", "lies in a buffer without data");
    const auto begin = buffer.bytes.begin() + fields.value("byteOffset", std::ptrdiff_t{0});
    return Bytes(begin, begin + fields["byteLength"].get<std::ptrdiff_t>());
}

void load_images(Document& document, const Checking& checking, Hasher& hasher) {
    for (std::size_t i = 0; i < checking.count("images"); ++i) {
        CheckedObject image(document.file, element("images", i), checking.source["images"][i]);
        auto& data = document.images.emplace_back();
        try {
            data.bytes = image_bytes(document, checking, image, hasher);
        } catch (const InputError&) {
            data.problem = std::current_exception();
        }
    }
}

void check_all(Checking& checking) {
    check_textures(checking);
    check_materials(checking);
    check_variants(checking);
    check_meshes(checking);
    check_skins(checking);
    check_cameras(checking);
    check_lights(checking);
    check_nodes(checking);
    check_animations(checking);
}

/// tinygltf demands a buffer view of index accessors, though glTF does not; so they are given here. Those
/// that were decoded have one.
void restore_indices(Document& document, const Json& source) {
    for (std::size_t m = 0; m < document.model.meshes.size(); ++m) {
        auto& primitives = document.model.meshes[m].primitives;
        for (std::size_t p = 0; p < primitives.size(); ++p)
            if (primitives[p].indices < 0)
                primitives[p].indices = source["meshes"][m]["primitives"][p].value("indices", -1);
    }
}

void parse_model(Document& document, const Checking& checking) {
    const auto text = checking.checked.dump();
    tinygltf::TinyGLTF reader;
    std::string problems, warnings;
    if (!reader.LoadASCIIFromString(&document.model, &problems, &warnings, text.c_str(),
                                    static_cast<unsigned int>(text.size()), "", tinygltf::NO_REQUIRE))
        throw InputError(document.file, "", "cannot be understood: " + one_line(problems));
    restore_indices(document, checking.source);
}

}  // namespace

Document read_document(const std::string& file) {
    Document document;
    document.file = one_line(file, 4096);
    const auto bytes = read_file(file);
    document.total_bytes = bytes.size();
    Hasher hasher;
    hasher.add(std::as_bytes(std::span(bytes)));
    auto container = open_container(document.file, bytes);
    const auto source = parse(document.file, container.json);
    container.json = {};
    Checking checking{document.file, source, document.warnings, Json::object(), {}, {}};
    check_asset(checking);
    document.extensions = check_extensions(checking);
    load_buffers(document, checking, container, hasher);
    check_buffer_views(checking);
    decode_meshopt(document, checking);
    check_accessors(checking);
    load_images(document, checking, hasher);
    check_all(checking);
    decode_draco(document, checking);
    document.accessor_problems = std::move(checking.accessor_problems);
    document.variants = std::move(checking.variants);
    parse_model(document, checking);
    document.content_hash = hasher.hexadecimal();
    return document;
}

}  // namespace ir::scene::gltf
