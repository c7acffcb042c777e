#include <dlfcn.h>

#include <cstdint>
#include <vector>

#include "renderers/core/error.h"
#include "renderers/gl/backends.h"

namespace ir::gl {
namespace {

// The part of OSMesa's interface that is used here; newer distributions do not have its header.
using OsmesaHandle = struct osmesa_context*;
constexpr int format_attribute = 0x22;
constexpr int depth_bits_attribute = 0x30;
constexpr int profile_attribute = 0x33;
constexpr int core_profile = 0x34;
constexpr int major_version_attribute = 0x36;
constexpr int minor_version_attribute = 0x37;

/// The functions of libOSMesa. It is loaded at run time because linking it beside libGL or libEGL mixes up
/// their symbols, and because newer Mesa releases do not have it. It is never unloaded: its threads may
/// outlive the last context.
struct OsMesa {
    OsmesaHandle (*create_context)(const int* attributes, OsmesaHandle share);
    void (*destroy_context)(OsmesaHandle context);
    GLboolean (*make_current)(OsmesaHandle context, void* pixels, GLenum type, GLsizei width, GLsizei height);
    GLADapiproc (*get_function)(const char* name);
};

void* open_library(const std::string& name) {
    if (!name.empty()) return dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL);
    for (const char* candidate : {"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"})
        if (void* library = dlopen(candidate, RTLD_NOW | RTLD_LOCAL)) return library;
    return nullptr;
}

template <class Function>
Function find_function(void* library, const char* name) {
    auto* function = reinterpret_cast<Function>(dlsym(library, name));
    if (!function) {
        throw Error(std::string("osmesa: the library has no function ") + name +
                    "; Mesa 12 to 25.0 is needed (Debian: libosmesa6), or use --backend egl");
    }
    return function;
}

OsMesa load_osmesa(const std::string& name) {
    void* library = open_library(name);
    if (!library) {
        throw Error("osmesa: cannot load " + (name.empty() ? "libOSMesa.so.8" : name) +
                    "; install OSMesa (Debian: libosmesa6; Mesa 25.1 and later do not have it) or use "
                    "--backend egl");
    }
    OsMesa osmesa{};
    osmesa.create_context =
        find_function<decltype(osmesa.create_context)>(library, "OSMesaCreateContextAttribs");
    osmesa.destroy_context = find_function<decltype(osmesa.destroy_context)>(library, "OSMesaDestroyContext");
    osmesa.make_current = find_function<decltype(osmesa.make_current)>(library, "OSMesaMakeCurrent");
    osmesa.get_function = find_function<decltype(osmesa.get_function)>(library, "OSMesaGetProcAddress");
    return osmesa;
}

class OsMesaContext final : public Context {
  public:
    explicit OsMesaContext(const ContextOptions& options) : osmesa_(load_osmesa(options.osmesa_library)) {
        info_.backend = Backend::osmesa;
        info_.platform = "osmesa";
        const int attributes[] = {format_attribute,
                                  GL_RGBA,
                                  depth_bits_attribute,
                                  0,
                                  profile_attribute,
                                  core_profile,
                                  major_version_attribute,
                                  4,
                                  minor_version_attribute,
                                  5,
                                  0};
        context_ = osmesa_.create_context(attributes, nullptr);
        if (!context_)
            throw Error(
                "osmesa: the library gives no OpenGL 4.5 core context; Mesa 20 to 25.0 is needed, or use "
                "--backend egl");
        try {
            make_current();
            initialise(osmesa_.get_function, options);
        } catch (...) {
            destroy();
            throw;
        }
    }
    ~OsMesaContext() override { destroy(); }

  private:
    // OSMesa insists on memory to draw into; passes bind framebuffers of their own.
    static constexpr int size = 16;

    void bind() override {
        if (!osmesa_.make_current(context_, pixels_.data(), GL_UNSIGNED_BYTE, size, size))
            throw Error("osmesa: cannot make the context current");
    }
    void unbind() override { osmesa_.make_current(nullptr, nullptr, 0, 0, 0); }
    void destroy() {
        release();
        osmesa_.destroy_context(context_);
    }

    OsMesa osmesa_;
    OsmesaHandle context_ = nullptr;
    std::vector<std::uint8_t> pixels_ = std::vector<std::uint8_t>(size * size * 4);
};

}  // namespace

std::unique_ptr<Context> create_osmesa_context(const ContextOptions& options) {
    return std::make_unique<OsMesaContext>(options);
}

}  // namespace ir::gl
