#pragma once

#include <QStringList>

class QWidget;

namespace ir::gui {

class Session;

/// Where a file dialog starts: the folder last chosen from in this run, else the one that holds the open
/// project, else documents. Never in the program's own data.
QString dialog_folder(const Session& session);
/// To be told what was chosen, a file or a project's folder. Empty (nothing was chosen) changes nothing.
void remember_folder_of(const QString& chosen);

/// What a dialog that exports proposes: a clean name made of `title`, in the folder that was exported to
/// last, in this run or before, else in documents.
QString export_proposal(const QString& title, const QString& suffix);
/// To be told where a person exported to.
void remember_export(const QString& file);
/// Asks for the file of an export, and proposes a name made of `name`. A name with none of the endings gets
/// the first before it is asked whether to replace a file. Empty: it is not to be written.
QString ask_for_export(QWidget* parent, const QString& title, const QString& name, const QString& filter,
                       const QStringList& endings);

/// A name for a file in any language and on any system: letters, digits and single dashes between them.
QString clean_file_name(const QString& title);

}  // namespace ir::gui
