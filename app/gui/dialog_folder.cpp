#include "app/gui/dialog_folder.h"

#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QMessageBox>
#include <QRegularExpression>
#include <QSettings>
#include <QStandardPaths>
#include <algorithm>

#include "app/gui/session.h"

namespace ir::gui {
namespace {

constexpr int longest_name = 100;  ///< characters; file systems take 255 bytes

QString& last_folder() {
    static QString folder;
    return folder;
}

QString export_key() {
    return QStringLiteral("export/folder");
}

QString documents() {
    const auto folder = QStandardPaths::writableLocation(QStandardPaths::DocumentsLocation);
    return QFileInfo(folder).isDir() ? folder : QDir::homePath();
}

/// Copies of samples and projects that were never saved live there.
bool is_own_data(const QString& folder) {
    const auto data = QStandardPaths::writableLocation(QStandardPaths::AppDataLocation);
    return !data.isEmpty() && (folder + QLatin1Char('/')).startsWith(data + QLatin1Char('/'));
}

}  // namespace

QString dialog_folder(const Session& session) {
    if (!last_folder().isEmpty() && QFileInfo(last_folder()).isDir()) return last_folder();
    if (!session.has_project() || session.open_project().folder().empty()) return documents();
    const auto folder =
        QFileInfo(QString::fromStdString(session.open_project().folder().string())).absolutePath();
    return is_own_data(folder) ? documents() : folder;
}

void remember_folder_of(const QString& chosen) {
    if (chosen.isEmpty()) return;
    const auto folder = QFileInfo(QDir::cleanPath(chosen)).absolutePath();
    if (!is_own_data(folder)) last_folder() = folder;
}

QString export_proposal(const QString& title, const QString& suffix) {
    const auto last = QSettings().value(export_key()).toString();
    const auto folder = !last.isEmpty() && QFileInfo(last).isDir() ? last : documents();
    return QDir(folder).filePath(clean_file_name(title) + suffix);
}

void remember_export(const QString& file) {
    QSettings().setValue(export_key(), QFileInfo(QDir::cleanPath(file)).absolutePath());
}

QString ask_for_export(QWidget* parent, const QString& title, const QString& name, const QString& filter,
                       const QStringList& endings) {
    auto file = QFileDialog::getSaveFileName(parent, title, export_proposal(name, endings.front()), filter,
                                             nullptr, QFileDialog::DontConfirmOverwrite);
    if (file.isEmpty()) return {};
    const auto is_ending = [&](const QString& ending) { return file.endsWith(ending, Qt::CaseInsensitive); };
    if (std::none_of(endings.begin(), endings.end(), is_ending)) file += endings.front();
    if (QFileInfo::exists(file) &&
        QMessageBox::question(parent, title, QObject::tr("%1 exists. Replace it?").arg(file)) !=
            QMessageBox::Yes)
        return {};
    remember_export(file);
    return file;
}

QString clean_file_name(const QString& title) {
    static const QRegularExpression others(QStringLiteral("[^\\p{L}\\p{N}]+"),
                                           QRegularExpression::UseUnicodePropertiesOption);
    auto words = title.split(others, Qt::SkipEmptyParts).join(QLatin1Char('-')).left(longest_name);
    if (words.endsWith(QLatin1Char('-'))) words.chop(1);
    return words.isEmpty() ? QStringLiteral("untitled") : words;
}

}  // namespace ir::gui
