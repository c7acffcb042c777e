#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <vector>

#include "renderers/core/error.h"
#include "renderers/gl/backends.h"
#include "renderers/gl/egl_device.h"

namespace ir::gl {
namespace {

/// EGL_NO_CONFIG_KHR where that is allowed, else any configuration that does OpenGL.
EGLConfig choose_config(EGLDisplay display) {
    if (has_word(eglQueryString(display, EGL_EXTENSIONS), "EGL_KHR_no_config_context"))
        return EGL_NO_CONFIG_KHR;
    const EGLint wanted[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, 0, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    if (!eglChooseConfig(display, wanted, &config, 1, &count) || count == 0)
        throw Error("no configuration for OpenGL");
    return config;
}

EGLContext create_handle(EGLDisplay display, bool debug, bool robust) {
    std::vector<EGLint> attributes{EGL_CONTEXT_MAJOR_VERSION,       4,
                                   EGL_CONTEXT_MINOR_VERSION,       5,
                                   EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT};
    if (debug) attributes.insert(attributes.end(), {EGL_CONTEXT_OPENGL_DEBUG, EGL_TRUE});
    if (robust)
        attributes.insert(attributes.end(),
                          {EGL_CONTEXT_OPENGL_ROBUST_ACCESS, EGL_TRUE,
                           EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY, EGL_LOSE_CONTEXT_ON_RESET});
    attributes.push_back(EGL_NONE);
    return eglCreateContext(display, choose_config(display), EGL_NO_CONTEXT, attributes.data());
}

class EglContext final : public Context {
  public:
    /// Throws Error with the reason alone; the caller names the place.
    EglContext(const EglCandidate& place, const ContextOptions& options) : display_(place.display) {
        info_.backend = Backend::egl;
        info_.platform = place.platform;
        // Displays are never terminated: EGL hands out the same one to everybody who asks for the device, and
        // termination would pull it from under the other contexts of the process.
        EGLint major = 0, minor = 0;
        if (display_ == EGL_NO_DISPLAY || !eglInitialize(display_, &major, &minor))
            throw Error(egl_error_name());
        if (major == 1 && minor < 5) throw Error("EGL 1.5 is needed");
        if (!has_word(eglQueryString(display_, EGL_EXTENSIONS), "EGL_KHR_surfaceless_context"))
            throw Error("EGL_KHR_surfaceless_context is missing");
        if (!eglBindAPI(EGL_OPENGL_API)) throw Error("desktop OpenGL is missing");
        context_ = create_handle(display_, options.debug, true);
        if (context_ == EGL_NO_CONTEXT) context_ = create_handle(display_, options.debug, false);
        if (context_ == EGL_NO_CONTEXT) throw Error("no OpenGL 4.5 core context (" + egl_error_name() + ")");
        try {
            make_current();
            initialise(&eglGetProcAddress, options);
        } catch (...) {
            destroy();
            throw;
        }
    }
    ~EglContext() override { destroy(); }

  private:
    // The bound API belongs to the thread, so it is set wherever the context arrives.
    void bind() override {
        eglBindAPI(EGL_OPENGL_API);
        if (!eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_))
            throw Error("egl: cannot make the context current (" + egl_error_name() + ")");
    }
    void unbind() override {
        eglBindAPI(EGL_OPENGL_API);
        eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    }
    void destroy() {
        release();
        eglDestroyContext(display_, context_);
    }

    EGLDisplay display_ = EGL_NO_DISPLAY;
    EGLContext context_ = EGL_NO_CONTEXT;
};

bool matches(const Context& context, const EglCandidate& place, const std::string& wanted) {
    return wanted.empty() || context.info().renderer.find(wanted) != std::string::npos ||
           place.text.find(wanted) != std::string::npos;
}

}  // namespace

std::unique_ptr<Context> create_egl_context(const ContextOptions& options) {
    std::string tried;
    for (const auto& place : egl_candidates()) {
        std::string problem;
        try {
            auto context = std::make_unique<EglContext>(place, options);
            if (matches(*context, place, options.device)) return context;
            problem = context->info().renderer + " is not '" + options.device + "'";
        } catch (const Error& error) {
            problem = error.what();
        }
        tried += (tried.empty() ? "" : ", ") + place.name + ": " + problem;
    }
    if (tried.empty()) tried = "EGL offers neither devices nor the surfaceless platform";
    throw Error("egl: no OpenGL 4.5 context (" + tried +
                "); install a driver (Debian: libegl-mesa0 libgl1-mesa-dri)" +
                (options.device.empty() ? "" : ", name another device") + " or use --backend osmesa");
}

}  // namespace ir::gl
