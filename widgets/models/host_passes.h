#pragma once

#include <QString>

namespace ir::widgets {

/// Says that shaders do nothing in these passes (between commas), with a link that mends it.
QString host_passes_html(const QString& passes);
inline constexpr const char* use_opengl_link = "use-opengl";

}  // namespace ir::widgets
