#include "renderers/graph/pass_context.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "renderers/graph/frame.h"

namespace ir::graph {
namespace {

using Kind = Pass::Access::Kind;

/// The declared access, or std::logic_error.
const Pass::Access& declared(const Pass& pass, Kind kind, int index, bool previous, const std::string& key) {
    const Pass::Access* found = nullptr;
    for (const auto& access : pass.accesses)
        if (access.kind == kind && access.index == index && access.previous == previous)
            if (!found || access.write) found = &access;
    if (!found)
        throw std::logic_error("pass '" + pass.name + "' uses " + (previous ? "the history of '" : "'") +
                               key + "' without declaring it");
    return *found;
}

void require_write(const Pass& pass, const Pass::Access& access, const std::string& key) {
    if (!access.write)
        throw std::logic_error("pass '" + pass.name + "' writes '" + key + "' without declaring it");
}

}  // namespace

const FrameInputs& PassContext::inputs() const {
    return *frame_.inputs;
}
const CancelToken& PassContext::cancel() const {
    return frame_.cancel();
}
const gl::Api& PassContext::api() const {
    if (!frame_.cache.context)
        throw std::logic_error("pass '" + pass_.name + "' asks for OpenGL, which this device lacks");
    return frame_.cache.context->api();
}

// Passes of the cpu queue may come here from many threads, and have no programs: only the others note what
// they touch.

Physical& PassContext::physical(ImageRef ref, bool previous, bool write) const {
    auto& s = frame_;
    const auto& key = s.builder->images().at(ref.index).text.key;
    const auto& access = declared(pass_, Kind::image, ref.index, previous, key);
    if (write) require_write(pass_, access, key);
    if (pass_.queue == Queue::gl) touched_.emplace(Pass::Binding::Kind::image, ref.index);
    return *s.images.at(ref.index);
}

Physical& PassContext::physical(BufferRef ref, bool previous, bool write) const {
    auto& s = frame_;
    const auto& key = s.builder->buffers().at(ref.index).text.key;
    const auto& access = declared(pass_, Kind::buffer, ref.index, previous, key);
    if (write) require_write(pass_, access, key);
    if (pass_.queue == Queue::gl) touched_.emplace(Pass::Binding::Kind::buffer, ref.index);
    return *s.buffers.at(ref.index);
}

gl::Name PassContext::image(ImageRef ref) const {
    return physical(ref, false).now().name;
}
gl::Name PassContext::previous(ImageRef ref) const {
    return physical(ref, true).before().name;
}
gl::Name PassContext::buffer(BufferRef ref) const {
    return physical(ref, false).now().name;
}
gl::Name PassContext::previous(BufferRef ref) const {
    return physical(ref, true).before().name;
}

void PassContext::check_declared(CounterRef ref) const {
    const auto found = std::find_if(pass_.counters.begin(), pass_.counters.end(),
                                    [&](CounterRef counter) { return counter.index == ref.index; });
    if (found == pass_.counters.end())
        throw std::logic_error("pass '" + pass_.name + "' uses counter '" +
                               frame_.builder->counters().at(ref.index).key + "' without declaring it");
}

void PassContext::bind_framebuffer(const std::vector<Attachment>& colours, const Attachment* depth) const {
    const auto& gl = api();
    GLuint name = 0;
    gl.CreateFramebuffers(1, &name);
    frame_.cache.framebuffers.push_back(name);
    int width = 0, height = 0;
    const auto attach = [&](GLenum point, const Attachment& attachment) {
        const auto& target = physical(attachment.image, false, true);
        width = target.shape.level_width(attachment.level);
        height = target.shape.level_height(attachment.level);
        const auto texture = image(attachment.image);
        if (attachment.layer < 0)
            gl.NamedFramebufferTexture(name, point, texture, attachment.level);
        else
            gl.NamedFramebufferTextureLayer(name, point, texture, attachment.level, attachment.layer);
    };
    std::vector<GLenum> draw_buffers;
    for (const auto& colour : colours) {
        draw_buffers.push_back(static_cast<GLenum>(GL_COLOR_ATTACHMENT0 + draw_buffers.size()));
        attach(draw_buffers.back(), colour);
    }
    if (depth) attach(GL_DEPTH_ATTACHMENT, *depth);
    if (draw_buffers.empty())
        gl.NamedFramebufferDrawBuffer(name, GL_NONE);
    else
        gl.NamedFramebufferDrawBuffers(name, static_cast<GLsizei>(draw_buffers.size()), draw_buffers.data());
    if (gl.CheckNamedFramebufferStatus(name, GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        throw std::logic_error("pass '" + pass_.name +
                               "': its attachments do not make a complete framebuffer");
    gl.BindFramebuffer(GL_FRAMEBUFFER, name);
    gl.Viewport(0, 0, width, height);
}

void PassContext::bind_empty_framebuffer(int width, int height, int layers) const {
    const auto& gl = api();
    GLuint name = 0;
    gl.CreateFramebuffers(1, &name);
    frame_.cache.framebuffers.push_back(name);
    gl.NamedFramebufferParameteri(name, GL_FRAMEBUFFER_DEFAULT_WIDTH, width);
    gl.NamedFramebufferParameteri(name, GL_FRAMEBUFFER_DEFAULT_HEIGHT, height);
    gl.NamedFramebufferParameteri(name, GL_FRAMEBUFFER_DEFAULT_LAYERS, layers);
    gl.BindFramebuffer(GL_FRAMEBUFFER, name);
    gl.Viewport(0, 0, width, height);
}

void PassContext::bind_empty_vertex_array() const {
    auto& s = frame_;
    if (!s.cache.empty_vertex_array) api().CreateVertexArrays(1, &s.cache.empty_vertex_array);
    api().BindVertexArray(s.cache.empty_vertex_array);
}

void PassContext::draw_full_screen() const {
    bind_empty_vertex_array();
    if (!programs_.empty()) programs_.back()->require_uniforms();
    api().DrawArrays(GL_TRIANGLES, 0, 3);
}

void PassContext::upload(BufferRef ref, std::span<const std::byte> bytes, std::uint64_t offset) const {
    const auto& target = physical(ref, false, true);
    if (offset + bytes.size() > target.copy_bytes())
        throw std::logic_error("pass '" + pass_.name + "' uploads beyond the end of '" + target.label + "'");
    if (!bytes.empty()) frame_.cache.device.write_buffer(buffer(ref), offset, bytes);
}

void PassContext::upload(ImageRef ref, std::span<const std::byte> texels, int level, int layer) const {
    const auto& target = physical(ref, false, true);
    frame_.cache.device.write_image(image(ref), target.shape, level, layer, texels);
}

void PassContext::clear(ImageRef ref) const {
    const auto& target = physical(ref, false, true);
    frame_.cache.device.clear_image(image(ref), target.shape);
}

void PassContext::clear(BufferRef ref) const {
    const auto& target = physical(ref, false, true);
    frame_.cache.device.clear_buffer(buffer(ref), 0, target.copy_bytes());
}

void PassContext::barrier() const {
    frame_.cache.device.barrier();
}

std::span<std::byte> PassContext::host(ImageRef ref, int layer, bool previous) const {
    auto& target = physical(ref, previous);
    auto& copy = previous ? target.before() : target.now();
    const auto layer_bytes = copy.host.size() / std::max(1, target.shape.layers);
    return std::span(copy.host).subspan(layer * layer_bytes, layer_bytes);
}

std::span<std::byte> PassContext::host(BufferRef ref, bool previous) const {
    auto& target = physical(ref, previous);
    return previous ? target.before().host : target.now().host;
}

void PassContext::add(CounterRef ref, std::uint32_t amount) const {
    check_declared(ref);
    if (pass_.queue == Queue::gl) touched_.emplace(Pass::Binding::Kind::counter, ref.index);
    frame_.host_counters[ref.index].fetch_add(amount, std::memory_order_relaxed);
}

PassNotes PassContext::notes() const {
    return PassNotes(frame_);
}

void PassNotes::set_figure(const std::string& key, double value) const {
    frame_.cache.figures[key] = value;
}

void PassNotes::set_sum(const std::string& key, double value) const {
    set_figure(key, value);
    frame_.cache.report.sums.insert(key);
}

void PassNotes::warn(std::string text) const {
    frame_.cache.warnings.push_back(std::move(text));
}

std::shared_ptr<void> PassContext::stored(ObjectRef ref) const {
    auto& s = frame_;
    const auto& key = s.builder->objects().at(ref.index).text.key;
    declared(pass_, Kind::object, ref.index, false, key);
    const auto found = s.cache.objects.find(key);
    return found == s.cache.objects.end() ? nullptr : found->second.object;
}

void PassContext::store(ObjectRef ref, std::shared_ptr<void> object, std::uint64_t bytes) const {
    auto& s = frame_;
    const auto& desc = s.builder->objects().at(ref.index);
    const auto& key = desc.text.key;
    require_write(pass_, declared(pass_, Kind::object, ref.index, false, key), key);
    s.cache.objects[key] = {std::move(object), bytes, {}, desc.is_spare};
}

gl::ImageShape PassContext::shape(ImageRef ref) const {
    auto& s = frame_;
    return resolve(s.builder->images().at(ref.index), s.inputs->view);
}

std::uint64_t PassContext::capacity(BufferRef ref) const {
    const auto& s = frame_;
    const auto declares = [&](const Pass::Access& access) {
        return access.kind == Kind::buffer && access.index == ref.index;
    };
    if (std::none_of(pass_.accesses.begin(), pass_.accesses.end(), declares))
        throw std::logic_error("pass '" + pass_.name + "' uses '" +
                               s.builder->buffers().at(ref.index).text.key + "' without declaring it");
    if (pass_.queue == Queue::gl) touched_.emplace(Pass::Binding::Kind::buffer, ref.index);
    return s.buffers.at(ref.index)->capacity;
}

std::uint64_t PassContext::capacity(ObjectRef ref) const {
    const auto& desc = frame_.builder->objects().at(ref.index);
    require_write(pass_, declared(pass_, Kind::object, ref.index, false, desc.text.key), desc.text.key);
    if (!desc.is_spare) throw std::logic_error("object '" + desc.text.key + "' is not spare");
    return FrameMemory(frame_).spare_bytes(desc.text.key);
}

bool PassContext::has_previous() const {
    auto& s = frame_;
    bool any = false;
    for (const auto& access : pass_.accesses) {
        if (!access.previous || access.kind == Kind::object) continue;
        any = true;
        auto* target = access.kind == Kind::image ? s.images[access.index] : s.buffers[access.index];
        if (!target->before().committed) return false;
    }
    return any;
}

}  // namespace ir::graph
