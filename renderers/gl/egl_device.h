#pragma once

#include <EGL/egl.h>

#include <string>
#include <vector>

namespace ir::gl {

/// A place where EGL may give a context.
struct EglCandidate {
    std::string name;      ///< "device 0", "surfaceless"
    std::string platform;  ///< "device" or "surfaceless"
    std::string text;      ///< what a device is asked for by: its extensions and name, "surfaceless"
    EGLDisplay display = EGL_NO_DISPLAY;
    bool software = false;
};

/// Devices with hardware, other devices, surfaceless; their displays are not initialised yet.
std::vector<EglCandidate> egl_candidates();

/// "EGL_NOT_INITIALIZED" for the last error of this thread.
std::string egl_error_name();

/// Whether a space-separated list has this word.
bool has_word(const char* list, const std::string& word);

}  // namespace ir::gl
