#include <algorithm>
#include <chrono>

#include "renderers/graph/frame.h"
#include "renderers/graph/pass_context.h"

namespace ir::graph {
namespace {

using Kind = Pass::Access::Kind;
using Clock = std::chrono::steady_clock;

double ms_since(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// Work between two looks at cancellation and at views that wait.
constexpr double slice_ms = 30;
/// A rate measured on few items may be far off for many.
constexpr std::int64_t max_slice_growth = 8;

}  // namespace

void GraphCache::delete_framebuffers() {
    if (!context || framebuffers.empty()) return;
    context->api().BindFramebuffer(GL_FRAMEBUFFER, 0);
    context->api().DeleteFramebuffers(static_cast<GLsizei>(framebuffers.size()), framebuffers.data());
    framebuffers.clear();
}

void GraphCache::reset_gl_state() const {
    if (!context) return;
    const auto& gl = context->api();
    for (const GLenum capability :
         {GL_BLEND, GL_DEPTH_TEST, GL_CULL_FACE, GL_SCISSOR_TEST, GL_STENCIL_TEST, GL_RASTERIZER_DISCARD,
          GL_POLYGON_OFFSET_FILL, GL_MULTISAMPLE, GL_DEPTH_CLAMP})
        gl.Disable(capability);
    gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl.DepthMask(GL_TRUE);
    gl.DepthFunc(GL_LESS);
    gl.PolygonMode(GL_FRONT_AND_BACK, GL_FILL);
}

void Frame::prepare_access(const Pass& pass, const Pass::Access& access) {
    if (access.kind == Kind::object) return;
    const bool on_gl = pass.queue == Queue::gl, is_image = access.kind == Kind::image;
    auto& physical = is_image ? *images[access.index] : *buffers[access.index];
    const bool fresh = access.write && !physical.produced;
    auto& copy = access.previous ? physical.before() : fresh ? cache.pool.own(physical) : physical.now();
    if (access.previous && !copy.committed) return cache.pool.zero(physical, copy, on_gl);
    const bool cleared = fresh && !is_image && builder->buffers()[access.index].cleared;
    if (on_gl) {
        cache.pool.on_device(physical, copy);
        if (cleared) cache.device.clear_buffer(copy.name, 0, physical.copy_bytes());
    } else if (fresh) {
        copy.host.assign(physical.host_bytes(), std::byte{0});
    } else {
        cache.pool.on_host(physical, copy);
    }
    if (!access.write) return;
    physical.fingerprint.clear();
    physical.produced = true;
    copy.on_host = !on_gl;
    copy.on_device = on_gl;
    if (on_gl) copy.host = {};
}

void Frame::serve_views(bool on_gl, std::size_t index) {
    const auto start = Clock::now();
    options->between_slices();
    if (cache.context && !cache.context->is_current()) cache.context->make_current();
    if (on_gl) cache.reset_gl_state();
    views_ms[index] += ms_since(start);
}

void Frame::drop_contents(const Pass& pass) {
    for (const auto& access : pass.accesses) {
        if (!access.write || access.kind == Kind::object) continue;
        auto& physical = access.kind == Kind::image ? *images[access.index] : *buffers[access.index];
        auto& copy = cache.pool.own(physical);
        copy.on_device = copy.on_host = false;
    }
}

int Frame::run_slices(const Pass& pass, std::size_t index, PassContext& pass_context) {
    const bool on_gl = pass.queue == Queue::gl, sliced = pass.first_slice > 0;
    const auto known_rate = cache.items_per_ms.find(pass.name);
    double rate = known_rate == cache.items_per_ms.end() ? 0 : known_rate->second;
    int slices = 0;
    std::int64_t begin = 0, last_size = 0;
    do {
        cancel().check();
        std::int64_t size = std::max<std::int64_t>(1, pass.items);
        if (sliced) {
            size = rate > 0 ? std::max<std::int64_t>(1, static_cast<std::int64_t>(rate * slice_ms))
                            : pass.first_slice;
            if (last_size > 0) size = std::min(size, max_slice_growth * last_size);
            last_size = size;
        }
        const auto end = begin + std::min(pass.items - begin, size);
        const auto start = Clock::now();
        pass.execute(pass_context, {begin, end, begin == 0, end == pass.items});
        ++slices;
        // after the last slice a graphics card is not waited for: its clock tells the rate after the frame
        const bool is_waited_for = !on_gl || end < pass.items || cache.device.software();
        if (sliced && end > begin && is_waited_for) {
            if (on_gl) cache.device.finish();
            rate = static_cast<double>(end - begin) / std::max(ms_since(start), 1e-3);
        }
        begin = end;
        if (options->progress) {
            const double within = pass.items > 0 ? static_cast<double>(begin) / pass.items : 1;
            options->progress(pass.name, (index + within) / builder->passes().size());
        }
        if (begin < pass.items && options->between_slices) serve_views(on_gl, index);
    } while (begin < pass.items);
    if (sliced && rate > 0) cache.items_per_ms[pass.name] = rate;
    pass_context.check_names();
    return slices;
}

PassReport Frame::run_pass(const Pass& pass, std::size_t index) {
    const bool on_gl = pass.queue == Queue::gl;
    ran[index] = true;
    cache.counts_of_passes.erase(pass.name);
    cache.shaders_of_passes.erase(pass.name);
    const auto start = Clock::now();  // copies between device and host are part of the pass that needs them
    for (const auto& access : pass.accesses) prepare_access(pass, access);
    PassReport result;
    result.name = pass.name;
    result.has_two_bodies = pass.has_two_bodies;
    result.queue = on_gl ? "gl" : "cpu";
    PassContext pass_context(*this, pass);
    if (on_gl) {
        cache.reset_gl_state();
        // copies to a card that are still under way would count as this pass
        if (options->rebuild && !cache.device.software()) cache.device.finish();
        cache.device.begin_pass(pass.name);
    }
    const auto clean_up = [&] {
        drop_contents(pass);  // half written
        if (!on_gl) return;
        if (cache.context && !cache.context->is_current()) cache.context->make_current();
        cache.device.end_pass();
        cache.delete_framebuffers();
    };
    try {
        result.slices = run_slices(pass, index, pass_context);
    } catch (const gl::ConstantsError& error) {
        clean_up();
        throw Error("pass '" + pass.name + "', " + error.what());
    } catch (...) {
        clean_up();
        throw;
    }
    result.cpu_ms = ms_since(start) - views_ms[index];
    if (on_gl) {
        cache.device.barrier();
        const int ticket = cache.device.end_pass();
        result.gpu_ms =
            cache.device.software() ? cache.device.pass_ms(ticket) : -1 - ticket;  // resolved after the frame
        if (cache.device.software()) result.cpu_ms = ms_since(start) - views_ms[index];
        cache.delete_framebuffers();
    }
    keep_fingerprints(pass, index);
    return result;
}

}  // namespace ir::graph
