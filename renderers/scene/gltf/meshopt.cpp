#include <meshoptimizer.h>

#include <map>

#include "renderers/scene/gltf/compression.h"
#include "renderers/scene/gltf/expansion_budget.h"

namespace ir::scene::gltf {
namespace {

enum class Mode { attributes, triangles, indices };

/// How a buffer view is compressed [EXT_meshopt_compression, "Specifying compressed views"].
struct Compression {
    Mode mode;
    std::size_t count, stride;
    void (*filter)(void* values, std::size_t count, std::size_t stride);  ///< null: none
};

template <class Value>
Value value_of(CheckedObject& object, const char* key, const std::map<std::string, Value>& values,
               const char* otherwise) {
    const auto name = object.text(key);
    if (!name && !otherwise) object.fail(key, "is missing; export the file again");
    const auto found = values.find(name.value_or(otherwise ? otherwise : ""));
    if (found == values.end()) object.fail(key, "is \"" + one_line(*name) + "\", which is unknown");
    return found->second;
}

Compression compression_of(CheckedObject& object) {
    using Filter = decltype(Compression::filter);
    Compression result;
    result.mode = value_of<Mode>(
        object, "mode",
        {{"ATTRIBUTES", Mode::attributes}, {"TRIANGLES", Mode::triangles}, {"INDICES", Mode::indices}},
        nullptr);
    result.count = object.required(object.integer("count", 1, INT32_MAX), "count");
    result.stride = object.required(object.integer("byteStride", 2, 256), "byteStride");
    result.filter = value_of<Filter>(object, "filter",
                                     {{"NONE", nullptr},
                                      {"OCTAHEDRAL", meshopt_decodeFilterOct},
                                      {"QUATERNION", meshopt_decodeFilterQuat},
                                      {"EXPONENTIAL", meshopt_decodeFilterExp}},
                                     "NONE");
    if (result.mode == Mode::attributes && result.stride % 4 != 0)
        object.fail("byteStride", "must be a multiple of 4 for ATTRIBUTES; export the file again");
    if (result.mode != Mode::attributes && result.stride != 2 && result.stride != 4)
        object.fail("byteStride", "must be 2 or 4 for indices; export the file again");
    if (result.mode == Mode::triangles && result.count % 3 != 0)
        object.fail("count", "must be a multiple of 3 for TRIANGLES; export the file again");
    const bool fits = !result.filter || (result.mode == Mode::attributes &&
                                         (result.filter == meshopt_decodeFilterExp || result.stride == 8 ||
                                          (result.filter == meshopt_decodeFilterOct && result.stride == 4)));
    if (!fits) object.fail("filter", "does not go with this mode and byteStride; export the file again");
    return result;
}

/// False where the bytes are broken.
bool decode(const Compression& compression, const std::uint8_t* bytes, std::size_t length, Bytes& result) {
    const auto [mode, count, stride, filter] = compression;
    const auto failure =
        mode == Mode::attributes  ? meshopt_decodeVertexBuffer(result.data(), count, stride, bytes, length)
        : mode == Mode::triangles ? meshopt_decodeIndexBuffer(result.data(), count, stride, bytes, length)
                                  : meshopt_decodeIndexSequence(result.data(), count, stride, bytes, length);
    if (failure == 0 && filter) filter(result.data(), count, stride);
    return failure == 0;
}

Bytes decoded_view(const Document& document, const Checking& checking, ExpansionBudget& budget,
                   const std::string& place, const Json& source) {
    CheckedObject object(document.file, place, source);
    const auto buffer =
        object.required(object.index("buffer", checking.count("buffers"), "buffers"), "buffer");
    const auto offset = static_cast<std::size_t>(object.integer("byteOffset", 0, INT32_MAX).value_or(0));
    const auto length =
        static_cast<std::size_t>(object.required(object.integer("byteLength", 1, INT32_MAX), "byteLength"));
    const auto& data = document.buffers[buffer];
    if (!data.present || offset + length > data.bytes.size())
        object.fail("byteLength",
                    "reaches beyond the end of " + element("buffers", buffer) + "; export the file again");
    const auto compression = compression_of(object);
    budget.spend(compression.count * compression.stride, place);
    Bytes result(compression.count * compression.stride);
    if (!decode(compression, data.bytes.data() + offset, length, result))
        object.fail("buffer", "holds data that cannot be decoded; export the file again");
    return result;
}

}  // namespace

int add_buffer(Document& document, Bytes bytes) {
    document.buffers.push_back({std::move(bytes), true});
    return static_cast<int>(document.buffers.size()) - 1;
}

void decode_meshopt(Document& document, Checking& checking) {
    ExpansionBudget budget(document);
    for (std::size_t i = 0; i < checking.count("bufferViews"); ++i) {
        const CheckedObject view(document.file, element("bufferViews", i), checking.source["bufferViews"][i]);
        const auto* source = view.extension(meshopt_compression);
        if (!source) continue;
        auto bytes = decoded_view(document, checking, budget,
                                  view.place(std::string("extensions.") + meshopt_compression), *source);
        auto& checked = checking.checked["bufferViews"][i];
        checked["byteLength"] = bytes.size();
        checked["byteOffset"] = 0;
        checked["buffer"] = add_buffer(document, std::move(bytes));
    }
}

}  // namespace ir::scene::gltf
