#include <embree3/rtcore.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <mutex>
#include <string>

#include "renderers/core/error.h"
#include "renderers/core/threads.h"
#include "renderers/passes/raytracing/device_bvh.h"

namespace ir::passes {
namespace {

using Device = std::unique_ptr<std::remove_pointer_t<RTCDevice>, decltype(&rtcReleaseDevice)>;
using Tree = std::unique_ptr<std::remove_pointer_t<RTCBVH>, decltype(&rtcReleaseBVH)>;

/// Larger coordinates are none to Embree.
constexpr float largest_coordinate = 1e18f;
/// Where Embree stops using the heuristic and halves what is left. Halving needs no more than 28 levels.
constexpr unsigned builder_depth = bvh_max_depth - 1;

/// What the builder makes, in its own memory.
struct Part {
    bool is_leaf;
};
struct Inner : Part {
    Part* children[2];
    RTCBounds bounds[2];
};
struct Leaf : Part {
    std::uint32_t count;
    std::uint32_t triangles[bvh_leaf_size];
};

void* create_node(RTCThreadLocalAllocator allocator, unsigned, void*) {
    return new (rtcThreadLocalAlloc(allocator, sizeof(Inner), 16)) Inner{{false}, {}, {}};
}

void set_children(void* node, void** children, unsigned count, void*) {
    for (unsigned i = 0; i < count; ++i)
        static_cast<Inner*>(node)->children[i] = static_cast<Part*>(children[i]);
}

void set_bounds(void* node, const RTCBounds** bounds, unsigned count, void*) {
    for (unsigned i = 0; i < count; ++i) static_cast<Inner*>(node)->bounds[i] = *bounds[i];
}

void* create_leaf(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* primitives, std::size_t count,
                  void*) {
    auto* leaf = new (rtcThreadLocalAlloc(allocator, sizeof(Leaf), 16))
        Leaf{{true}, static_cast<std::uint32_t>(count), {}};
    for (std::size_t i = 0; i < count; ++i) leaf->triangles[i] = primitives[i].primID;
    std::sort(leaf->triangles, leaf->triangles + count);
    return leaf;
}

std::array<glm::vec3, 3> corners(const scene::World& world, std::size_t triangle) {
    const auto* vertices = &world.indices[3 * triangle];
    return {world.positions[vertices[0]], world.positions[vertices[1]], world.positions[vertices[2]]};
}

bool can_be_hit(const std::array<glm::vec3, 3>& corners) {
    for (const auto& corner : corners)
        for (int i = 0; i < 3; ++i)
            if (!(std::abs(corner[i]) <= largest_coordinate)) return false;
    return true;
}

std::vector<RTCBuildPrimitive> primitives_of(const scene::World& world) {
    std::vector<RTCBuildPrimitive> result;
    result.reserve(world.triangles());
    for (std::size_t i = 0; i < world.triangles(); ++i) {
        const auto t = corners(world, i);
        if (!can_be_hit(t)) continue;
        const auto low = glm::min(t[0], glm::min(t[1], t[2])), high = glm::max(t[0], glm::max(t[1], t[2]));
        result.push_back({low.x, low.y, low.z, 0, high.x, high.y, high.z, static_cast<unsigned>(i)});
    }
    return result;
}

/// Embree's device and tree, and the first error of theirs: exceptions must not cross the C library.
class Builder {
  public:
    Builder() : device_(rtcNewDevice(nullptr), rtcReleaseDevice), tree_(nullptr, rtcReleaseBVH) {
        if (!device_) throw Error("ray tracing: Embree does not start");
        rtcSetDeviceErrorFunction(device_.get(), on_error, this);
        tree_.reset(rtcNewBVH(device_.get()));
        check();
    }

    /// The root lives as long as this object. Leaf or inner node; null without primitives.
    const Part* build(std::vector<RTCBuildPrimitive>& primitives, int threads) {
        if (primitives.empty()) return nullptr;
        auto arguments = rtcDefaultBuildArguments();
        arguments.buildQuality = RTC_BUILD_QUALITY_MEDIUM;
        arguments.maxBranchingFactor = 2;
        arguments.maxDepth = builder_depth;
        arguments.minLeafSize = 1;
        arguments.maxLeafSize = bvh_leaf_size;
        arguments.bvh = tree_.get();
        arguments.primitives = primitives.data();
        arguments.primitiveCount = arguments.primitiveArrayCapacity = primitives.size();
        arguments.createNode = create_node;
        arguments.setNodeChildren = set_children;
        arguments.setNodeBounds = set_bounds;
        arguments.createLeaf = create_leaf;
        // Not the device's option "threads", which limits TBB in the whole process.
        tbb::task_arena arena(arena_size(threads));
        void* root = nullptr;
        arena.execute([&] { root = rtcBuildBVH(&arguments); });
        check();
        return static_cast<const Part*>(root);
    }

  private:
    static void on_error(void* self, RTCError code, const char* text) {
        auto& builder = *static_cast<Builder*>(self);
        const std::lock_guard lock(builder.mutex_);
        if (!builder.error_.empty()) return;  // the first says what went wrong
        builder.error_ = text ? text : "error " + std::to_string(static_cast<int>(code));
    }

    void check() {
        const std::lock_guard lock(mutex_);
        if (!error_.empty()) throw Error("ray tracing: Embree built no BVH for the device: " + error_);
    }

    std::mutex mutex_;
    std::string error_;
    // The callback uses the members above, so the device dies first.
    Device device_;
    Tree tree_;
};

/// Lays the tree out in arrays.
class Layout {
  public:
    Layout(const scene::Scene& scene, const scene::World& world) : scene_(scene), world_(world) {}

    DeviceBvhData run(const Part* root) {
        const auto node = add_node(0, 0);
        if (root && !root->is_leaf) {
            fill(node, static_cast<const Inner&>(*root));
        } else {
            // Every ray reads two children of the root.
            auto& only = result_.nodes[node];
            only.left = only.right = bvh_no_child;
            if (root) set_single_leaf(node, static_cast<const Leaf&>(*root));
        }
        return std::move(result_);
    }

  private:
    std::uint32_t add_node(std::uint32_t parent, std::uint32_t depth) {
        if (depth >= bvh_max_depth)
            throw Error("ray tracing: the BVH for the device is deeper than " +
                        std::to_string(bvh_max_depth) + " nodes; use the tracer of the host");
        result_.depth = std::max(result_.depth, static_cast<int>(depth) + 1);
        result_.nodes.push_back({});
        result_.nodes.back().parent = parent;
        result_.nodes.back().depth = depth;
        return static_cast<std::uint32_t>(result_.nodes.size() - 1);
    }

    void fill(std::uint32_t node, const Inner& inner) {
        const auto low = [](const RTCBounds& b) { return glm::vec3(b.lower_x, b.lower_y, b.lower_z); };
        const auto high = [](const RTCBounds& b) { return glm::vec3(b.upper_x, b.upper_y, b.upper_z); };
        auto& first = result_.nodes[node];
        first.left_min_ws = low(inner.bounds[0]), first.left_max_ws = high(inner.bounds[0]);
        first.right_min_ws = low(inner.bounds[1]), first.right_max_ws = high(inner.bounds[1]);
        const auto left = child(*inner.children[0], node), right = child(*inner.children[1], node);
        result_.nodes[node].left = left;  // the array has grown since
        result_.nodes[node].right = right;
    }

    std::uint32_t child(const Part& part, std::uint32_t parent) {
        if (part.is_leaf) return add_leaf(static_cast<const Leaf&>(part));
        const auto node = add_node(parent, result_.nodes[parent].depth + 1);
        fill(node, static_cast<const Inner&>(part));
        return node;
    }

    void set_single_leaf(std::uint32_t node, const Leaf& leaf) {
        const auto word = add_leaf(leaf);
        auto& only = result_.nodes[node];
        only.left = word;
        only.left_min_ws = glm::vec3(std::numeric_limits<float>::max());
        only.left_max_ws = -only.left_min_ws;
        for (const auto& t : result_.triangles) {
            only.left_min_ws = glm::min(only.left_min_ws, glm::min(t.a_ws, glm::min(t.b_ws, t.c_ws)));
            only.left_max_ws = glm::max(only.left_max_ws, glm::max(t.a_ws, glm::max(t.b_ws, t.c_ws)));
        }
    }

    std::uint32_t add_leaf(const Leaf& leaf) {
        const auto first = static_cast<std::uint32_t>(result_.triangles.size());
        for (std::uint32_t i = 0; i < leaf.count; ++i) add_triangle(leaf.triangles[i]);
        return bvh_leaf | leaf.count << 28 | first;
    }

    void add_triangle(std::uint32_t triangle) {
        const auto [a, b, c] = corners(world_, triangle);
        std::uint32_t mask = 0;
        if (triangle >= world_.opaque_triangles) {
            result_.masks.push_back(mask_of(triangle));
            mask = static_cast<std::uint32_t>(result_.masks.size());
        }
        result_.triangles.push_back({a, triangle, b, mask, c, 0});
    }

    BvhMask mask_of(std::uint32_t triangle) const {
        BvhMask mask{};
        mask.material = world_.triangle_materials[triangle];
        const auto& slot = scene_.materials.at(mask.material).base_colour_texture;
        const auto& uvs = slot.uv_set == 1 ? world_.uv1 : world_.uv0;
        for (std::size_t i = 0; i < 3; ++i) {
            const auto vertex = world_.indices[3 * triangle + i];
            mask.uv[i] = vertex < uvs.size() ? scene::transformed_uv(slot, uvs[vertex]) : glm::vec2(0);
        }
        return mask;
    }

    const scene::Scene& scene_;
    const scene::World& world_;
    DeviceBvhData result_;
};

}  // namespace

static_assert(sizeof(BvhNode) == 64 && sizeof(BvhTriangle) == 48 && sizeof(BvhMask) == 32,
              "structs equal their std430 twins");
static_assert(bvh_leaf_size < 8, "three bits hold the size of a leaf");

DeviceBvhData build_device_bvh(const scene::Scene& scene, const scene::World& world, int threads) {
    if (world.triangles() > bvh_max_triangles)
        throw Error("ray tracing: the BVH for the device holds 2^28 triangles; the scene has " +
                    std::to_string(world.triangles()));
    auto primitives = primitives_of(world);
    const auto left_out = world.triangles() - primitives.size();
    Builder builder;
    auto result = Layout(scene, world).run(builder.build(primitives, threads));
    result.left_out = left_out;
    return result;
}

}  // namespace ir::passes
