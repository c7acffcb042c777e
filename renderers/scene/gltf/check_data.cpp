#include <map>

#include "renderers/core/error.h"
#include "renderers/scene/gltf/check.h"
#include "renderers/scene/gltf/source.h"

namespace ir::scene::gltf {
namespace {

constexpr std::int64_t max_bytes = INT32_MAX;

const std::map<std::string, int>& component_counts() {
    static const std::map<std::string, int> counts{{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4},
                                                   {"MAT2", 4},   {"MAT3", 9}, {"MAT4", 16}};
    return counts;
}

/// 0 for a component type that glTF does not know.
int component_bytes(std::int64_t type) {
    switch (type) {
        case 5120:
        case 5121:
            return 1;
        case 5122:
        case 5123:
            return 2;
        case 5125:
        case 5126:
            return 4;
        default:
            return 0;
    }
}

/// `count` elements at `offset` must end within the buffer view.
void check_range(const Checking& checking, const CheckedObject& object, int view, std::int64_t offset,
                 std::int64_t element_bytes, std::int64_t count) {
    const auto& fields = checking.checked["bufferViews"][view];
    const auto length = fields["byteLength"].get<std::int64_t>();
    const auto stride = fields.value("byteStride", element_bytes);
    if (stride < element_bytes)
        object.fail("bufferView", "has a byteStride of " + std::to_string(stride) +
                                      ", less than an element; export the file again");
    // All factors are below 2^31: no overflow in 64 bits.
    if (offset + stride * (count - 1) + element_bytes > length)
        object.fail("bufferView", "ends at byte " + std::to_string(length) +
                                      ", but the accessor reaches to " +
                                      std::to_string(offset + stride * (count - 1) + element_bytes) +
                                      "; export the file again");
}

void check_sparse(Checking& checking, CheckedObject& accessor, const Json& source, std::int64_t count,
                  std::int64_t element_bytes) {
    CheckedObject sparse(checking.file, accessor.place("sparse"), source);
    const auto changed = sparse.required(sparse.integer("count", 1, count), "count");
    CheckedObject indices(checking.file, sparse.place("indices"), sparse.required_object("indices"));
    const auto type = indices.required(indices.integer("componentType", 5121, 5125), "componentType");
    if (type == 5122 || type == 5124) indices.fail("componentType", "must be an unsigned integer type");
    const auto views = checking.count("bufferViews");
    const auto index_view = indices.required(indices.index("bufferView", views, "bufferViews"), "bufferView");
    check_range(checking, indices, index_view, indices.integer("byteOffset", 0, max_bytes).value_or(0),
                component_bytes(type), changed);
    CheckedObject values(checking.file, sparse.place("values"), sparse.required_object("values"));
    const auto value_view = values.required(values.index("bufferView", views, "bufferViews"), "bufferView");
    check_range(checking, values, value_view, values.integer("byteOffset", 0, max_bytes).value_or(0),
                element_bytes, changed);
    sparse.result["indices"] = indices.result;
    sparse.result["values"] = values.result;
    accessor.result["sparse"] = sparse.result;
}

}  // namespace

void check_buffer_views(Checking& checking) {
    checking.for_each("bufferViews", [&](CheckedObject& view) {
        view.text("name");
        const auto buffer =
            view.required(view.index("buffer", checking.count("buffers"), "buffers"), "buffer");
        const auto offset = view.integer("byteOffset", 0, max_bytes).value_or(0);
        const auto length = view.required(view.integer("byteLength", 1, max_bytes), "byteLength");
        if (view.integer("byteStride", 4, 252).value_or(4) % 4 != 0)
            view.fail("byteStride", "must be a multiple of 4; export the file again");
        CheckedObject owner(checking.file, element("buffers", buffer), checking.source["buffers"][buffer]);
        const auto total = owner.required(owner.integer("byteLength", 1, max_bytes), "byteLength");
        if (offset + length > total)
            view.fail("byteLength", "reaches to byte " + std::to_string(offset + length) + ", but " +
                                        owner.place() + " has " + std::to_string(total) +
                                        "; export the file again");
    });
}

void check_accessors(Checking& checking) {
    checking.for_each("accessors", [&](CheckedObject& accessor) {
        accessor.text("name");
        accessor.boolean("normalized");
        const auto count = accessor.required(accessor.integer("count", 1, max_bytes), "count");
        const auto type = accessor.required(accessor.text("type"), "type");
        const auto component =
            accessor.required(accessor.integer("componentType", 0, max_bytes), "componentType");
        const auto components = component_counts().find(type);
        if (components == component_counts().end() || component_bytes(component) == 0) {
            checking.accessor_problems.push_back(
                "has an unknown type or componentType; export the file again");
            accessor.result = {{"type", "SCALAR"}, {"componentType", 5126}, {"count", 1}};
            return;
        }
        checking.accessor_problems.emplace_back();
        const std::int64_t bytes = components->second * component_bytes(component);
        const auto offset = accessor.integer("byteOffset", 0, max_bytes).value_or(0);
        const auto view = accessor.index("bufferView", checking.count("bufferViews"), "bufferViews");
        if (view) check_range(checking, accessor, *view, offset, bytes, count);
        if (const auto* sparse = accessor.object("sparse"))
            check_sparse(checking, accessor, *sparse, count, bytes);
    });
}

}  // namespace ir::scene::gltf
