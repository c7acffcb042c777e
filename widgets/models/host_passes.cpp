#include "widgets/models/host_passes.h"

#include <QCoreApplication>

namespace ir::widgets {

QString host_passes_html(const QString& passes) {
    const auto said = [](const char* text) { return QCoreApplication::translate("HostPasses", text); };
    return said("These passes run on the host, where shaders change, print and draw nothing: %1. ")
               .arg(passes.toHtmlEscaped()) +
           QStringLiteral("<a href='#%1'>%2</a>")
               .arg(QLatin1String(use_opengl_link), said("Run them on OpenGL"));
}

}  // namespace ir::widgets
