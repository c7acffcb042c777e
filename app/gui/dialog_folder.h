#pragma once

#include <QString>

namespace ir::gui {

class Session;

/// Where a file dialog starts: the folder last chosen from in this run, else the one that holds the open
/// project, else home.
QString dialog_folder(const Session& session);
/// To be told what was chosen, a file or a project's folder. Empty (nothing was chosen) changes nothing.
void remember_folder_of(const QString& chosen);

}  // namespace ir::gui
