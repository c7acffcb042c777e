#include "app/gui/notices.h"

#include <exception>

#include "renderers/core/reason.h"

namespace ir::gui {

using Kind = widgets::BannerStack::Kind;

void Notices::fail(const QString& banner, const std::string& source, const QString& error) {
    add({Severity::error, source, error.toStdString()});
    banners_.show_banner(banner, Kind::error, error);
}

bool Notices::attempt(const std::function<void()>& work, const QString& what) {
    const auto banner = QStringLiteral("file");
    try {
        work();
        banners_.hide_banner(banner);
        return true;
    } catch (const std::exception& error) {
        add({Severity::error, "project", reason_of(error)});
        banners_.show_banner(banner, Kind::error,
                             QStringLiteral("%1: %2").arg(what, QString::fromStdString(reason_of(error))));
        return false;
    }
}

void Notices::forget_project() {
    for (const auto& dock : docks_) banners_.hide_banner(dock);
    banners_.hide_banner(QLatin1String(processor_banner));
    status_.forget();
}

}  // namespace ir::gui
