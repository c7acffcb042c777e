#include "renderers/gl/context.h"

#include <algorithm>
#include <array>

#include "renderers/core/error.h"
#include "renderers/gl/backends.h"

namespace ir::gl {
namespace {

/// The context of ours that is current on this thread.
thread_local Context* current_context = nullptr;

std::string text_of(const Api& api, GLenum name) {
    const auto* text = reinterpret_cast<const char*>(api.GetString(name));
    return text ? text : "";
}

int integer_of(const Api& api, GLenum name) {
    GLint value = 0;
    api.GetIntegerv(name, &value);
    return value;
}

bool is_software(const std::string& renderer) {
    static constexpr std::array names{"llvmpipe", "softpipe", "swrast", "SWR", "Software Rasterizer"};
    return std::any_of(names.begin(), names.end(),
                       [&](const char* name) { return renderer.find(name) != std::string::npos; });
}

/// A driver's message as one line.
std::string one_line(std::string text) {
    while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

}  // namespace

std::string to_string(Backend backend) {
    return backend == Backend::egl ? "egl" : "osmesa";
}

Backend parse_backend(const std::string& text) {
    if (text == "egl") return Backend::egl;
    if (text == "osmesa") return Backend::osmesa;
    throw UsageError("backend '" + text + "' is not known; give egl or osmesa");
}

std::unique_ptr<Context> Context::create(Backend backend, const ContextOptions& options) {
    // Creation makes the new context current, which must not meet another API's current context.
    if (current_context) current_context->release();
    return backend == Backend::egl ? create_egl_context(options) : create_osmesa_context(options);
}

std::unique_ptr<Context> Context::create_best(const ContextOptions& options) {
    std::string tried;
    for (const Backend backend : {Backend::egl, Backend::osmesa}) {
        try {
            return create(backend, options);
        } catch (const Error& error) {
            tried += (tried.empty() ? "" : "; ") + std::string(error.what());
        }
    }
    throw Error(tried);
}

void Context::make_current() {
    if (current_context == this) return;
    if (current_context) current_context->release();
    bind();
    current_context = this;
}

void Context::release() {
    if (current_context != this) return;
    unbind();
    current_context = nullptr;
}

bool Context::is_current() const {
    return current_context == this;
}

bool Context::has_extension(const std::string& name) const {
    return std::binary_search(info_.extensions.begin(), info_.extensions.end(), name);
}

bool Context::is_lost() const {
    // The driver reports a reset only until it is over, so the answer is kept.
    if (!lost_ && is_current() && api_.GetGraphicsResetStatus)
        lost_ = api_.GetGraphicsResetStatus() != GL_NO_ERROR;
    return lost_;
}

std::vector<Message> Context::take_messages() {
    std::vector<Message> result;
    result.swap(messages_);
    return result;
}

void Context::initialise(GLADloadfunc load, const ContextOptions& options) {
    const int version = gladLoadGLContext(&api_, load);
    if (!api_.VERSION_4_5) {
        throw Error(to_string(info_.backend) + ": OpenGL 4.5 is needed, this driver has " +
                    std::to_string(GLAD_VERSION_MAJOR(version)) + "." +
                    std::to_string(GLAD_VERSION_MINOR(version)));
    }
    read_info();
    if (options.debug) set_debug_output();
    set_conventions();
}

void Context::read_info() {
    info_.vendor = text_of(api_, GL_VENDOR);
    info_.renderer = text_of(api_, GL_RENDERER);
    info_.version = text_of(api_, GL_VERSION);
    info_.glsl_version = text_of(api_, GL_SHADING_LANGUAGE_VERSION);
    info_.software = is_software(info_.renderer);
    api_.GetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &info_.max_storage_buffer_bytes);
    info_.max_texture_size = integer_of(api_, GL_MAX_TEXTURE_SIZE);
    info_.max_texture_layers = integer_of(api_, GL_MAX_ARRAY_TEXTURE_LAYERS);
    info_.max_compute_invocations = integer_of(api_, GL_MAX_COMPUTE_WORK_GROUP_INVOCATIONS);
    info_.max_compute_shared_bytes = integer_of(api_, GL_MAX_COMPUTE_SHARED_MEMORY_SIZE);
    info_.max_storage_buffer_bindings = integer_of(api_, GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS);
    const int extensions = integer_of(api_, GL_NUM_EXTENSIONS);
    for (int i = 0; i < extensions; ++i)
        info_.extensions.emplace_back(
            reinterpret_cast<const char*>(api_.GetStringi(GL_EXTENSIONS, static_cast<GLuint>(i))));
    std::sort(info_.extensions.begin(), info_.extensions.end());
}

void Context::set_conventions() {
    api_.ClipControl(GL_UPPER_LEFT, GL_ZERO_TO_ONE);
    api_.Enable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
    api_.Disable(GL_DITHER);
    api_.PixelStorei(GL_PACK_ALIGNMENT, 1);
    api_.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
}

void Context::set_debug_output() {
    api_.Enable(GL_DEBUG_OUTPUT);
    api_.Enable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    api_.DebugMessageCallback(&Context::on_debug_message, this);
    api_.DebugMessageControl(GL_DONT_CARE, GL_DONT_CARE, GL_DONT_CARE, 0, nullptr, GL_TRUE);
}

void Context::on_debug_message(GLenum source, GLenum type, GLuint, GLenum, GLsizei length, const GLchar* text,
                               const void* user) {
    auto* context = static_cast<Context*>(const_cast<void*>(user));
    const std::string line =
        one_line(length < 0 ? std::string(text) : std::string(text, static_cast<std::size_t>(length)));
    switch (type) {
        case GL_DEBUG_TYPE_ERROR:
            if (source != GL_DEBUG_SOURCE_SHADER_COMPILER) context->add_message(Severity::error, line);
            break;
        case GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR:
        case GL_DEBUG_TYPE_PORTABILITY:
            context->add_message(Severity::error, line);
            break;
        case GL_DEBUG_TYPE_DEPRECATED_BEHAVIOR:
        case GL_DEBUG_TYPE_PERFORMANCE:
            if (context->warned_.insert(line).second) context->add_message(Severity::warning, line);
            break;
        default:
            break;
    }
}

void Context::add_message(Severity severity, const std::string& text) {
    const bool known = std::any_of(messages_.begin(), messages_.end(), [&](const Message& message) {
        return message.severity == severity && message.text == text;
    });
    if (!known) messages_.push_back({severity, "gl", text});
}

}  // namespace ir::gl
