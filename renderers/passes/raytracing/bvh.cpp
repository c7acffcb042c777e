#include "renderers/passes/raytracing/bvh.h"

#include <embree3/rtcore.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstring>
#include <mutex>
#include <string>

#include "renderers/core/constants.h"
#include "renderers/core/error.h"
#include "renderers/core/threads.h"
#include "renderers/graph/declared.h"
#include "renderers/graph/pass_context.h"
#include "renderers/passes/raytracing/alpha_masks.h"

namespace ir::passes {
namespace {

/// Embree reads vertices with 16-byte loads: the last one needs this much behind it.
constexpr std::size_t vertex_padding = 16;

using Device = std::unique_ptr<std::remove_pointer_t<RTCDevice>, decltype(&rtcReleaseDevice)>;
using SceneHandle = std::unique_ptr<std::remove_pointer_t<RTCScene>, decltype(&rtcReleaseScene)>;
using Geometry = std::unique_ptr<std::remove_pointer_t<RTCGeometry>, decltype(&rtcReleaseGeometry)>;
using Buffer = std::unique_ptr<std::remove_pointer_t<RTCBuffer>, decltype(&rtcReleaseBuffer)>;

/// Lets rays through the holes of masks; `N` hits in a row of structures of arrays.
void filter_masked(const RTCFilterFunctionNArguments* arguments) {
    const auto& masks = *static_cast<const AlphaMasks*>(arguments->geometryUserPtr);
    const unsigned n = arguments->N;
    for (unsigned i = 0; i < n; ++i) {
        if (arguments->valid[i] != -1) continue;
        const auto triangle = RTCHitN_primID(arguments->hit, n, i);
        const float u = RTCHitN_u(arguments->hit, n, i), v = RTCHitN_v(arguments->hit, n, i);
        if (!masks.is_covered(triangle, u, v)) arguments->valid[i] = 0;
    }
}

RTCIntersectContext context(bool coherent) {
    RTCIntersectContext result;
    rtcInitIntersectContext(&result);
    result.flags = coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    return result;
}

RTCRay make_ray(glm::vec3 origin, glm::vec3 direction, float near, float far) {
    RTCRay ray{};
    ray.org_x = origin.x, ray.org_y = origin.y, ray.org_z = origin.z;
    ray.dir_x = direction.x, ray.dir_y = direction.y, ray.dir_z = direction.z;
    ray.tnear = near, ray.tfar = far;
    ray.mask = ~0u;
    return ray;
}

void copy_rays(const Bvh::Packet16& from, RTCRay16& to) {
    std::memcpy(to.org_x, from.ox, sizeof from.ox);
    std::memcpy(to.org_y, from.oy, sizeof from.oy);
    std::memcpy(to.org_z, from.oz, sizeof from.oz);
    std::memcpy(to.dir_x, from.dx, sizeof from.dx);
    std::memcpy(to.dir_y, from.dy, sizeof from.dy);
    std::memcpy(to.dir_z, from.dz, sizeof from.dz);
    std::memcpy(to.tnear, from.near, sizeof from.near);
    std::memcpy(to.tfar, from.far, sizeof from.far);
    for (unsigned i = 0; i < 16; ++i) to.time[i] = 0, to.mask[i] = ~0u, to.id[i] = i, to.flags[i] = 0;
}

RTCRayHit make_query(glm::vec3 origin, glm::vec3 direction, float near, float far) {
    RTCRayHit query{};
    query.ray = make_ray(origin, direction, near, far);
    query.hit.geomID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    return query;
}

void make_query(const Bvh::Packet16& rays, RTCRayHit16& query) {
    copy_rays(rays, query.ray);
    std::fill_n(query.hit.geomID, 16, RTC_INVALID_GEOMETRY_ID);
    std::fill_n(query.hit.instID[0], 16, RTC_INVALID_GEOMETRY_ID);
}

}  // namespace

struct Bvh::Impl {
    Impl(const scene::Scene& scene, const scene::World& world, int threads, Edges edges)
        : masks(scene, world), device(make_device(), rtcReleaseDevice), handle(nullptr, rtcReleaseScene) {
        rtcSetDeviceErrorFunction(device.get(), on_error, this);
        rtcSetDeviceMemoryMonitorFunction(device.get(), on_memory, this);
        handle.reset(rtcNewScene(device.get()));
        rtcSetSceneBuildQuality(handle.get(), RTC_BUILD_QUALITY_MEDIUM);
        rtcSetSceneFlags(handle.get(),
                         edges == Edges::watertight ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
        check("was made ready");
        add_triangles(world);
        check("took the triangles");
        build(threads);
        check("was built");
    }

    static RTCDevice make_device() {
        const auto result = rtcNewDevice(nullptr);
        if (!result) {
            throw Error("ray tracing: Embree does not start (error " +
                        std::to_string(static_cast<int>(rtcGetDeviceError(nullptr))) +
                        "); it needs a processor with SSE2 and enough memory");
        }
        return result;
    }

    void add_triangles(const scene::World& world) {
        const std::size_t opaque = world.opaque_triangles, all = world.triangles();
        if (all == 0) return;
        const std::size_t vertex_bytes = world.positions.size() * sizeof(glm::vec3);
        const Buffer vertices(rtcNewBuffer(device.get(), vertex_bytes + vertex_padding), rtcReleaseBuffer);
        check("made room for the vertices");
        std::memcpy(rtcGetBufferData(vertices.get()), world.positions.data(), vertex_bytes);
        add_geometry(world, vertices.get(), 0, opaque);
        add_geometry(world, vertices.get(), opaque, all);
    }

    /// Triangles [begin, end). Only those with masks pay for a filter.
    void add_geometry(const scene::World& world, RTCBuffer vertices, std::size_t begin, std::size_t end) {
        if (begin == end) return;
        const Geometry geometry(rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE), rtcReleaseGeometry);
        rtcSetGeometryBuildQuality(geometry.get(), RTC_BUILD_QUALITY_MEDIUM);
        rtcSetGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, vertices, 0,
                             sizeof(glm::vec3), world.positions.size());
        constexpr std::size_t index_bytes = 3 * sizeof(std::uint32_t);
        void* indices = rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                index_bytes, end - begin);
        check("made room for the triangles");
        std::memcpy(indices, world.indices.data() + 3 * begin, (end - begin) * index_bytes);
        if (begin >= world.opaque_triangles) {
            rtcSetGeometryUserData(geometry.get(), &masks);
            rtcSetGeometryIntersectFilterFunction(geometry.get(), filter_masked);
            rtcSetGeometryOccludedFilterFunction(geometry.get(), filter_masked);
        }
        rtcCommitGeometry(geometry.get());
        const auto id = rtcAttachGeometry(handle.get(), geometry.get());
        first_triangles.at(id) = static_cast<std::uint32_t>(begin);
    }

    Hit hit(float distance, unsigned geometry, unsigned primitive, float u, float v) const {
        if (geometry == RTC_INVALID_GEOMETRY_ID) return {};
        return {distance, first_triangles[geometry] + primitive, u, v};
    }

    /// Not with the device's option "threads": that one limits TBB in the whole process while the device
    /// lives.
    void build(int threads) {
        tbb::task_arena arena(arena_size(threads));
        arena.execute([this] { rtcJoinCommitScene(handle.get()); });
    }

    static void on_error(void* self, RTCError code, const char* text) {
        auto& impl = *static_cast<Impl*>(self);
        const std::lock_guard lock(impl.error_mutex);
        if (!impl.error.empty()) return;  // the first says what went wrong
        impl.error = text ? text : "error " + std::to_string(static_cast<int>(code));
        if (code == RTC_ERROR_OUT_OF_MEMORY) impl.error += " (out of memory)";
    }

    static bool on_memory(void* self, ssize_t bytes, bool) {
        static_cast<Impl*>(self)->embree_bytes += bytes;
        return true;
    }

    /// Throws what the error callback kept: exceptions must not cross the C library.
    void check(const char* step) {
        const std::lock_guard lock(error_mutex);
        if (!error.empty()) {
            throw Error("ray tracing: Embree failed before the BVH " + std::string(step) + ": " + error);
        }
    }

    AlphaMasks masks;
    /// Of each of Embree's geometries, which number their triangles from 0.
    std::array<std::uint32_t, 2> first_triangles{};
    std::mutex error_mutex;
    std::string error;
    std::atomic<std::int64_t> embree_bytes{0};
    // The callbacks use the members above, so the device dies first.
    Device device;
    SceneHandle handle;
};

Bvh::Bvh(const scene::Scene& scene, const scene::World& world, int threads, Edges edges)
    : impl_(std::make_unique<Impl>(scene, world, threads, edges)) {}

Bvh::~Bvh() = default;

float Bvh::closest(glm::vec3 origin, glm::vec3 direction, float near, float far) const {
    auto ctx = context(false);
    auto query = make_query(origin, direction, near, far);
    rtcIntersect1(impl_->handle.get(), &ctx, &query);
    return query.hit.geomID == RTC_INVALID_GEOMETRY_ID ? infinity : query.ray.tfar;
}

bool Bvh::occluded(glm::vec3 origin, glm::vec3 direction, float near, float far) const {
    auto ctx = context(false);
    auto ray = make_ray(origin, direction, near, far);
    rtcOccluded1(impl_->handle.get(), &ctx, &ray);
    return ray.tfar == -infinity;  // how Embree says so
}

unsigned Bvh::occluded16(const Packet16& rays, bool coherent) const {
    auto ctx = context(coherent);
    RTCRay16 packet;
    copy_rays(rays, packet);
    rtcOccluded16(rays.active, impl_->handle.get(), &ctx, &packet);
    unsigned result = 0;
    for (unsigned i = 0; i < 16; ++i) {
        if (rays.active[i] && packet.tfar[i] == -infinity) result |= 1u << i;
    }
    return result;
}

void Bvh::closest16(const Packet16& rays, bool coherent, float (&distances)[16]) const {
    auto ctx = context(coherent);
    RTCRayHit16 query;
    make_query(rays, query);
    rtcIntersect16(rays.active, impl_->handle.get(), &ctx, &query);
    for (unsigned i = 0; i < 16; ++i) {
        const bool hit = rays.active[i] && query.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
        distances[i] = hit ? query.ray.tfar[i] : infinity;
    }
}

Hit Bvh::closest_hit(glm::vec3 origin, glm::vec3 direction, float near, float far) const {
    auto ctx = context(false);
    auto query = make_query(origin, direction, near, far);
    rtcIntersect1(impl_->handle.get(), &ctx, &query);
    return impl_->hit(query.ray.tfar, query.hit.geomID, query.hit.primID, query.hit.u, query.hit.v);
}

void Bvh::closest_hits16(const Packet16& rays, bool coherent, Hit (&hits)[16]) const {
    auto ctx = context(coherent);
    RTCRayHit16 query;
    make_query(rays, query);
    rtcIntersect16(rays.active, impl_->handle.get(), &ctx, &query);
    const auto& hit = query.hit;
    for (unsigned i = 0; i < 16; ++i) {
        hits[i] = rays.active[i]
                      ? impl_->hit(query.ray.tfar[i], hit.geomID[i], hit.primID[i], hit.u[i], hit.v[i])
                      : Hit{};
    }
}

std::uint64_t Bvh::bytes() const {
    return static_cast<std::uint64_t>(std::max<std::int64_t>(0, impl_->embree_bytes)) + impl_->masks.bytes();
}

graph::ObjectRef bvh(graph::GraphBuilder& builder) {
    graph::ObjectDesc desc;
    desc.text.key = "raytracing.bvh";
    if (const auto found = graph::declared_object(builder, desc.text.key)) return *found;
    desc.text.label = "Bounding volume hierarchy";
    desc.text.doc = "Embree's acceleration structure over the world.";
    desc.fingerprint = builder.inputs().geometry_fingerprint;
    const auto result = builder.object(desc);
    builder.pass("BVH", graph::Queue::cpu).writes(result).execute([result](graph::PassContext& context) {
        const auto& inputs = context.inputs();
        const auto made = std::make_shared<Bvh>(*inputs.scene, *inputs.world, inputs.threads);
        context.store(result, made, made->bytes());
    });
    return result;
}

}  // namespace ir::passes
