#include "app/gui/export_controller.h"

#include <QAction>
#include <QClipboard>
#include <QGuiApplication>
#include <functional>

#include "app/gui/dialog_folder.h"
#include "app/gui/text_of.h"
#include "renderers/image/tev.h"

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
    all << actions.add("copy-view", tr("Copy the view as sho&wn"), "copy",
                       {QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_C)}, [this] { copy_view(); });
    add("export-view", tr("View as shown, with labels and legen&d (PNG) …"), "export", Qt::Key_P, ".png",
        tr("PNG (*.png)"), &Exports::save_view);
    add("export-buffer", tr("Buffer (E&XR) …"), nullptr, Qt::Key_E, ".exr", exr, &Exports::save_buffer);
    add("export-values", tr("&Values (CSV) …"), nullptr, Qt::Key_V, ".csv",
        tr("Comma-separated values (*.csv)"), &Exports::save_values);
    add("export-all", tr("&All buffers in one file (EXR) …"), nullptr, Qt::Key_A, ".exr", exr,
        &Exports::save_all_buffers);
    all << actions.add("show-in-tev", tr("&Show the buffer in tev"), nullptr,
                       {QKeySequence(Qt::CTRL | Qt::ALT | Qt::Key_T)}, [this] { show_in_tev(tev_address); });
    all.back()->setData(tr("Sends the values to the viewer tev, which must be running"));
    enable_with_experiment(session, all);
    connect(&workspace, &Workspace::export_values_wanted, actions.find("export-values"), &QAction::trigger);
    connect(&renderer, &Renderer::exported, this,
            [this](const std::string&, const std::string& file, const std::string& error) {
                if (!asked_.removeOne(text_of(file))) return;  // somebody else has asked for it
                if (error.empty()) return notices_.say(tr("Wrote %1").arg(text_of(file)));
                notices_.fail(QStringLiteral("file"), "export", text_of(error));
            });
}

ExportController::~ExportController() {
    if (tev_.joinable()) tev_.join();
}

void ExportController::show_in_tev(const std::string& address) {
    if (is_sending_) return notices_.say(tr("A picture is being sent to tev"));
    ImageLayer layer;
    if (!notices_.attempt([&] { layer = exports_.buffer(); }, tr("Cannot show in tev"))) return;
    if (tev_.joinable()) tev_.join();
    is_sending_ = true;
    tev_ = std::thread([this, address, name = exports_.title().toStdString(), layer = std::move(layer)] {
        std::string failure;
        try {
            send_to_tev(name, {layer}, address);
        } catch (const std::exception& error) {
            failure = error.what();
        }
        const auto tell = [this, failure] {
            is_sending_ = false;
            if (failure.empty()) return notices_.say(tr("Shown in tev"));
            notices_.fail(QStringLiteral("file"), "export", text_of(failure));
        };
        QMetaObject::invokeMethod(this, tell, Qt::QueuedConnection);
    });
}

void ExportController::copy_view() {
    if (notices_.attempt([&] { QGuiApplication::clipboard()->setImage(exports_.view()); }, tr("Cannot copy")))
        notices_.say(tr("Copied the view"));
}

void ExportController::export_to(const QString& suffix, const QString& filter, Save save) {
    const auto name =
        save == &Exports::save_all_buffers ? exports_.owner_title() + tr(" buffers") : exports_.title();
    const auto file = ask_for_export(&window_, tr("Export"), name, filter, {suffix});
    if (file.isEmpty()) return;
    // GCC's check of types takes the closure for the object in `(exports_.*save)(file)`.
    if (!notices_.attempt([&] { std::invoke(save, exports_, file); }, tr("Cannot export"))) return;
    if (save == &Exports::save_all_buffers)
        asked_.append(file);  // the renderer says when it is there
    else
        notices_.say(tr("Wrote %1").arg(file));
}

}  // namespace ir::gui
