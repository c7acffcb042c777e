#pragma once

#include <QDesktopServices>
#include <QTextBrowser>
#include <QUrl>

namespace ir::gui {

/// What the window opens, in the browser's place: any object with a slot that takes an address.
class OpenedFiles {
  public:
    OpenedFiles() { QDesktopServices::setUrlHandler(QStringLiteral("file"), &shown_, "setSource"); }
    ~OpenedFiles() { QDesktopServices::unsetUrlHandler(QStringLiteral("file")); }
    QString file() const { return shown_.source().toLocalFile(); }

  private:
    QTextBrowser shown_;
};

}  // namespace ir::gui
