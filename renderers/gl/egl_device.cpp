#include "renderers/gl/egl_device.h"

#include <EGL/eglext.h>

#include <algorithm>
#include <array>
#include <sstream>

namespace ir::gl {
namespace {

template <class Function>
Function egl_function(const char* name) {
    return reinterpret_cast<Function>(eglGetProcAddress(name));
}

std::string device_text(EGLDeviceEXT device) {
    const auto query = egl_function<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
    if (!query) return {};
    const char* extensions = query(device, EGL_EXTENSIONS);
    std::string text = extensions ? extensions : "";
    if (has_word(extensions, "EGL_EXT_device_query_name"))
        for (const EGLint name : {EGL_RENDERER_EXT, EGL_VENDOR})
            if (const char* more = query(device, name)) text += std::string(" ") + more;
    return text;
}

std::vector<EglCandidate> device_candidates(PFNEGLGETPLATFORMDISPLAYEXTPROC get_display) {
    const auto query_devices = egl_function<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
    EGLint count = 0;
    if (!query_devices || !query_devices(0, nullptr, &count) || count <= 0) return {};
    std::vector<EGLDeviceEXT> devices(static_cast<std::size_t>(count));
    if (!query_devices(count, devices.data(), &count)) return {};
    devices.resize(static_cast<std::size_t>(count));

    std::vector<EglCandidate> candidates;
    for (std::size_t i = 0; i < devices.size(); ++i) {
        EglCandidate candidate{"device " + std::to_string(i), "device", device_text(devices[i])};
        candidate.software = has_word(candidate.text.c_str(), "EGL_MESA_device_software");
        candidate.display = get_display(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr);
        candidates.push_back(std::move(candidate));
    }
    std::stable_partition(candidates.begin(), candidates.end(),
                          [](const EglCandidate& candidate) { return !candidate.software; });
    return candidates;
}

}  // namespace

std::vector<EglCandidate> egl_candidates() {
    const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    const auto get_display = egl_function<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
    if (!extensions || !get_display) return {};
    std::vector<EglCandidate> candidates;
    const bool can_enumerate =
        has_word(extensions, "EGL_EXT_device_enumeration") || has_word(extensions, "EGL_EXT_device_base");
    if (can_enumerate && has_word(extensions, "EGL_EXT_platform_device"))
        candidates = device_candidates(get_display);
    if (has_word(extensions, "EGL_MESA_platform_surfaceless")) {
        EglCandidate candidate{"surfaceless", "surfaceless", "surfaceless"};
        // EGL_DEFAULT_DISPLAY is a plain 0 of the native display type
        candidate.display = get_display(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr);
        candidates.push_back(std::move(candidate));
    }
    return candidates;
}

std::string egl_error_name() {
    static constexpr std::array names{"EGL_SUCCESS",       "EGL_NOT_INITIALIZED",     "EGL_BAD_ACCESS",
                                      "EGL_BAD_ALLOC",     "EGL_BAD_ATTRIBUTE",       "EGL_BAD_CONFIG",
                                      "EGL_BAD_CONTEXT",   "EGL_BAD_CURRENT_SURFACE", "EGL_BAD_DISPLAY",
                                      "EGL_BAD_MATCH",     "EGL_BAD_NATIVE_PIXMAP",   "EGL_BAD_NATIVE_WINDOW",
                                      "EGL_BAD_PARAMETER", "EGL_BAD_SURFACE",         "EGL_CONTEXT_LOST"};
    const EGLint error = eglGetError();
    const EGLint index = error - EGL_SUCCESS;
    if (index >= 0 && index < static_cast<EGLint>(names.size()))
        return names[static_cast<std::size_t>(index)];
    return "EGL error " + std::to_string(error);
}

bool has_word(const char* list, const std::string& word) {
    if (!list) return false;
    std::istringstream words(list);
    for (std::string each; words >> each;)
        if (each == word) return true;
    return false;
}

}  // namespace ir::gl
