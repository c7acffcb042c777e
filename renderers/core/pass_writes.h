#pragma once

#include <algorithm>
#include <string>

#include "renderers/core/report.h"

namespace ir {

/// Whether the frame's pass writes a resource.
inline bool writes(const PassReport& pass, const std::string& key) {
    return !pass.culled && std::find(pass.writes.begin(), pass.writes.end(), key) != pass.writes.end();
}

/// Whether a resource is written when a pass has run: by that one, or by one before it.
inline bool is_written_by(const FrameReport& report, const std::string& key, const std::string& pass) {
    for (const auto& each : report.passes) {
        if (writes(each, key)) return true;
        if (each.name == pass) break;
    }
    return false;
}

}  // namespace ir
