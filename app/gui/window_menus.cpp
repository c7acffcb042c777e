#include <QDockWidget>
#include <QMenuBar>
#include <QToolBar>

#include "app/gui/main_window.h"
#include "app/gui/stage_chain.h"
#include "app/gui/text_of.h"

namespace ir::gui {
void MainWindow::make_menus() {
    const auto fill = [this](QMenu* menu, std::initializer_list<const char*> names) {
        for (const char* name : names)
            *name ? menu->addAction(actions_.value(QLatin1String(name))) : void(menu->addSeparator());
    };
    auto* file = menuBar()->addMenu(tr("&File"));
    fill(file, {"new", "open"});
    recent_menu_ = file->addMenu(tr("Open &recent"));
    fill(file, {"", "save", "save-as", ""});
    fill(file->addMenu(tr("&Export")), {"export-view", "export-buffer", "export-values", "", "export-all"});
    fill(file, {"", "close", "quit"});
    auto* edit = menuBar()->addMenu(tr("&Edit"));
    fill(edit, {"undo", "redo", "", "experiment-add", "experiment-duplicate", "experiment-rename",
                "experiment-remove", "match", "", "scene-add", "image-add", "bookmark", "comparison-add"});
    experiment_menu_ = new QMenu(this);
    fill(experiment_menu_, {"experiment-add", "experiment-duplicate", "experiment-rename",
                            "experiment-remove", "", "match", "keep"});
    experiment_menu_->setToolTipsVisible(true);
    experiment_panel_->set_menu(experiment_menu_);
    auto* view = menuBar()->addMenu(tr("&View"));
    fill(view, {"inspect",
                "orbit",
                "fly",
                "rectangle",
                "",
                "fit",
                "actual",
                "zoom-in",
                "zoom-out",
                "",
                "grid",
                "legend",
                "marks",
                "zebra",
                "",
                "brighter",
                "darker",
                "display-reset",
                "",
                "buffer-main",
                "buffer-next",
                "buffer-previous",
                "stages",
                "",
                "explain",
                "explain-nothing",
                "pin"});
    auto* compare = menuBar()->addMenu(tr("&Compare"));
    fill(compare, {"mode-single", "mode-side-by-side", "mode-wipe", "mode-flip", "mode-difference",
                   "mode-stages", "", "swap", "link", "", "comparison-add"});
    auto* render = menuBar()->addMenu(tr("&Render"));
    fill(render,
         {"cancel", "rerun", "shaders", "", "play", "step-forward", "step-back", "", "match", "keep"});
    render->setToolTipsVisible(true);
    auto* window = menuBar()->addMenu(tr("&Window"));
    fill(window, {"views-1", "views-2", "views-2-stacked", "views-3", "views-4", "", "view-open",
                  "view-close", "view-next", "view-previous", ""});
    for (const auto* dock : findChildren<QDockWidget*>(QString(), Qt::FindDirectChildrenOnly)) {
        auto* show = action(QStringLiteral("dock-") + dock->objectName());
        window->addAction(show);
        action_order_ << show;
    }
    fill(window, {"", "layout-default", "full-screen"});
    auto* help = menuBar()->addMenu(tr("&Help"));
    fill(help, {"shortcuts", "about"});
    update_recent();
}

void MainWindow::make_toolbar() {
    auto* bar = addToolBar(tr("Main tools"));
    bar->setObjectName(QStringLiteral("toolbar"));
    bar->setIconSize(QSize(18, 18));
    bar->setMovable(false);
    bar->setContextMenuPolicy(Qt::PreventContextMenu);
    for (const char* name :
         {"new",    "open",    "save",      "",        "undo",    "redo",    "",        "inspect",
          "orbit",  "fly",     "rectangle", "",        "fit",     "actual",  "zoom-in", "zoom-out",
          "grid",   "",        "views-1",   "views-2", "views-3", "views-4", "link",    "",
          "stages", "explain", "bookmark",  "",        "rerun",   "cancel"})
        *name ? bar->addAction(actions_.value(QLatin1String(name))) : void(bar->addSeparator());
}

void MainWindow::update_actions() {
    const bool open = session_.has_project(), writable = open && !session_.open_project().is_read_only();
    const bool experiment = session_.experiment() != nullptr;
    const auto set = [this](const char* name, bool enabled, const QString& text = {}) {
        auto* action = actions_.value(QLatin1String(name));
        action->setEnabled(enabled);
        if (!text.isEmpty()) action->setText(text);
    };
    const auto* undo = open ? &session_.open_project().undo_stack() : nullptr;
    set("undo", writable && undo->can_undo(),
        undo && undo->can_undo() ? tr("&Undo: %1").arg(text_of(undo->undo_label())) : tr("&Undo"));
    set("redo", writable && undo->can_redo(),
        undo && undo->can_redo() ? tr("&Redo: %1").arg(text_of(undo->redo_label())) : tr("&Redo"));
    set("save", writable && (session_.open_project().is_dirty() || session_.open_project().folder().empty()));
    for (const char* name : {"save-as", "close"}) set(name, open);
    for (const char* name : {"experiment-add", "scene-add", "image-add"}) set(name, writable);
    for (const char* name :
         {"experiment-duplicate", "experiment-rename", "experiment-remove", "bookmark", "comparison-add"})
        set(name, writable && experiment);
    update_result_actions();
    const bool rendering = !live_.is_settled();
    set("cancel", rendering);
    for (const char* name : {"fit",
                             "actual",
                             "zoom-in",
                             "zoom-out",
                             "grid",
                             "legend",
                             "marks",
                             "zebra",
                             "brighter",
                             "darker",
                             "display-reset",
                             "buffer-main",
                             "buffer-next",
                             "buffer-previous",
                             "rerun",
                             "inspect",
                             "orbit",
                             "fly",
                             "rectangle",
                             "explain",
                             "explain-nothing",
                             "pin",
                             "mode-single",
                             "mode-side-by-side",
                             "mode-wipe",
                             "mode-flip",
                             "mode-difference",
                             "mode-stages",
                             "swap",
                             "link",
                             "views-1",
                             "views-2",
                             "views-2-stacked",
                             "views-3",
                             "views-4",
                             "view-open",
                             "view-close",
                             "view-next",
                             "view-previous",
                             "export-view",
                             "export-buffer",
                             "export-values",
                             "export-all"})
        set(name, open && experiment);
    const bool stages = has_stages(session_, workspace_.active_state().a.owner);
    set("stages", stages);
    auto* chain = action(QStringLiteral("stages"));
    chain->setToolTip(chain->data().toString() + (stages ? QString() : tr(".\nThis method names none.")));
}

}  // namespace ir::gui
