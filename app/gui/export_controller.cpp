#include "app/gui/export_controller.h"

#include <QAction>
#include <QClipboard>
#include <QFileDialog>
#include <QGuiApplication>

#include "app/gui/dialog_folder.h"
#include "app/gui/text_of.h"

namespace ir::gui {

ExportController::ExportController(QWidget& window, Session& session, Renderer& renderer,
                                   Workspace& workspace, const Exports& exports, Notices& notices,
                                   Actions& actions)
    : window_(window), exports_(exports), notices_(notices) {
    QList<QAction*> all;
    const auto add = [&](const char* name, const QString& text, const char* icon, Qt::Key key,
                         const QString& suffix, const QString& filter, Save save) {
        all << actions.add(name, text, icon, {QKeySequence(Qt::CTRL | Qt::SHIFT | key)},
                           [=, this] { export_to(suffix, filter, save); });
    };
    const auto exr = tr("OpenEXR (*.exr)");
    all << actions.add("copy-view", tr("&Copy the view as shown"), "copy",
                       {QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_C)}, [this] { copy_view(); });
    add("export-view", tr("View as shown, with labels and legend (&PNG) …"), "export", Qt::Key_P, ".png",
        tr("PNG (*.png)"), &Exports::save_view);
    add("export-buffer", tr("Buffer (&EXR) …"), nullptr, Qt::Key_E, ".exr", exr, &Exports::save_buffer);
    add("export-values", tr("&Values (CSV) …"), nullptr, Qt::Key_V, ".csv",
        tr("Comma-separated values (*.csv)"), &Exports::save_values);
    add("export-all", tr("&All buffers in one file (EXR) …"), nullptr, Qt::Key_A, ".exr", exr,
        &Exports::save_all_buffers);
    enable_with_experiment(session, all);
    connect(&workspace, &Workspace::export_values_wanted, actions.find("export-values"), &QAction::trigger);
    connect(&renderer, &Renderer::exported, this,
            [this](const std::string&, const std::string& file, const std::string& error) {
                if (error.empty()) return notices_.say(tr("Wrote %1").arg(text_of(file)));
                notices_.fail(QStringLiteral("file"), "export", text_of(error));
            });
}

void ExportController::copy_view() {
    if (notices_.attempt([&] { QGuiApplication::clipboard()->setImage(exports_.view()); }, tr("Cannot copy")))
        notices_.say(tr("Copied the view"));
}

void ExportController::export_to(const QString& suffix, const QString& filter, Save save) {
    QString file = QFileDialog::getSaveFileName(&window_, tr("Export"),
                                                export_proposal(exports_.title(), suffix), filter);
    if (file.isEmpty()) return;
    remember_export(file);
    if (!file.endsWith(suffix, Qt::CaseInsensitive)) file += suffix;
    if (notices_.attempt([&] { (exports_.*save)(file); }, tr("Cannot export")))
        notices_.say(tr("Wrote %1").arg(file));
}

}  // namespace ir::gui
