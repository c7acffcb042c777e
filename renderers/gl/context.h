#pragma once

#include <glad/gl.h>

#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "renderers/core/report.h"

namespace ir::gl {

/// The functions of one context; `api.DrawArrays(...)`.
using Api = GladGLContext;

enum class Backend { egl, osmesa };
std::string to_string(Backend backend);
/// Throws UsageError for anything but "egl" and "osmesa".
Backend parse_backend(const std::string& text);

struct ContextOptions {
    bool debug = false;  ///< KHR_debug output, synchronous
    std::string
        device;  ///< part of an EGL device's renderer or extension string, or "surfaceless"; empty: the best
    std::string osmesa_library = {};  ///< file to load instead of the system's libOSMesa
};

struct DeviceInfo {
    Backend backend = Backend::egl;
    std::string platform;  ///< "device", "surfaceless", "osmesa"
    std::string vendor, renderer, version, glsl_version;
    bool software = false;  ///< llvmpipe, softpipe, swrast: timer queries are meaningless there
    std::int64_t max_storage_buffer_bytes = 0;  ///< as reported; software drivers take more
    int max_texture_size = 0, max_texture_layers = 0, max_compute_invocations = 0,
        max_compute_shared_bytes = 0, max_storage_buffer_bindings = 0;
    std::vector<std::string> extensions;
};

/// An OpenGL 4.5 core context without a window. It belongs to one thread at a time. On creation the
/// conventions of the house are set: y = +1 in normalised device coordinates is the top and row 0 of every
/// image is the top row (gl_FragCoord.y counts downwards), depth is 0…1
/// (glClipControl(GL_UPPER_LEFT, GL_ZERO_TO_ONE)), cube maps are seamless, nothing is dithered, pack and
/// unpack alignment are 1.
class Context {
  public:
    /// The new context is current on the calling thread. Throws Error with one line that says what was tried
    /// and what would mend it.
    static std::unique_ptr<Context> create(Backend backend, const ContextOptions& options = {});
    /// EGL on a hardware device, any EGL device, surfaceless EGL, OSMesa: the first that works.
    static std::unique_ptr<Context> create_best(const ContextOptions& options = {});

    virtual ~Context() = default;
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    /// EGL and OSMesa share thread-local dispatch, so another context of this process that is current on the
    /// calling thread is released first.
    void make_current();
    void release();
    bool is_current() const;

    const Api& api() const { return api_; }
    const DeviceInfo& info() const { return info_; }
    bool has_extension(const std::string& name) const;
    /// True after a GPU reset (asked only where the context is current); the context must be created anew.
    bool is_lost() const;

    /// KHR_debug messages since the last call: errors, undefined behaviour and portability as errors (each
    /// text once per call), deprecated behaviour and performance as warnings (each text once per context).
    /// Compiler errors are left to ProgramLibrary, which knows files and lines. Empty without options.debug.
    std::vector<Message> take_messages();

  protected:
    Context() = default;
    virtual void bind() = 0;
    virtual void unbind() = 0;
    /// Loads the functions, reads DeviceInfo, sets the conventions; the context is current.
    void initialise(GLADloadfunc load, const ContextOptions& options);

    Api api_{};
    DeviceInfo info_;

  private:
    static void on_debug_message(GLenum source, GLenum type, GLuint id, GLenum severity, GLsizei length,
                                 const GLchar* text, const void* user);
    void read_info();
    void set_conventions();
    void set_debug_output();
    void add_message(Severity severity, const std::string& text);

    std::vector<Message> messages_;
    std::set<std::string> warned_;  ///< texts of warnings that were given
    mutable bool lost_ = false;
};

}  // namespace ir::gl
