#include "app/gui/dialog_folder.h"

#include <QDir>
#include <QFileInfo>

#include "app/gui/session.h"

namespace ir::gui {
namespace {

QString& last_folder() {
    static QString folder;
    return folder;
}

}  // namespace

QString dialog_folder(const Session& session) {
    if (!last_folder().isEmpty() && QFileInfo(last_folder()).isDir()) return last_folder();
    if (session.has_project() && !session.open_project().folder().empty())
        return QFileInfo(QString::fromStdString(session.open_project().folder().string())).absolutePath();
    return QDir::homePath();
}

void remember_folder_of(const QString& chosen) {
    if (!chosen.isEmpty()) last_folder() = QFileInfo(QDir::cleanPath(chosen)).absolutePath();
}

}  // namespace ir::gui
