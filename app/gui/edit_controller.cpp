#include "app/gui/edit_controller.h"

#include <QAction>
#include <QRegularExpression>

#include "app/gui/text_of.h"

namespace ir::gui {

using K = QKeySequence;

namespace {

/// What an edit is called, as a menu shows it: with the window's quotes, and no letter underlined.
QString entry_of(const std::string& label) {
    static const QRegularExpression quoted(QStringLiteral(" '(.*)'"));
    return in_menu(text_of(label).replace(quoted, QStringLiteral(" “\\1”")));
}

}  // namespace

EditController::EditController(Session& session, DocumentDock& document, Actions& actions)
    : session_(session), document_(document), actions_(actions) {
    actions_.add("undo", tr("&Undo"), "undo", {K(Qt::CTRL | Qt::Key_Z)}, [this] { session_.undo(); });
    actions_.add("redo", tr("&Redo"), "redo", {K(Qt::CTRL | Qt::SHIFT | Qt::Key_Z), K(Qt::CTRL | Qt::Key_Y)},
                 [this] { session_.redo(); });
    actions_.add("experiment-add", tr("&Add experiment"), "add", {K(Qt::CTRL | Qt::Key_E)},
                 [this] { document_.add_experiment(); });
    actions_.add("experiment-duplicate", tr("&Duplicate experiment"), "copy",
                 {K(Qt::CTRL | Qt::SHIFT | Qt::Key_D)}, [this] { duplicate_experiment(); });
    actions_.add("experiment-rename", tr("Re&name experiment"), nullptr, {K(Qt::SHIFT | Qt::Key_F2)}, [this] {
        document_.select({widgets::ItemKind::experiment, text_of(session_.experiment()->id)});
        emit edit_wanted();
    });
    actions_.add("experiment-remove", tr("Remo&ve experiment"), "clear", {K(Qt::CTRL | Qt::Key_Delete)},
                 [this] { remove_experiment(); });
    actions_.add("scene-add", tr("Add s&cene …"), nullptr, {K(Qt::CTRL | Qt::ALT | Qt::Key_S)},
                 [this] { document_.add_scene(); });
    actions_.add("image-add", tr("Add &image of another renderer …"), nullptr,
                 {K(Qt::CTRL | Qt::ALT | Qt::Key_I)}, [this] { document_.add_image(); });
    actions_.add("bookmark", tr("&Bookmark the view"), "bookmark", {K(Qt::CTRL | Qt::Key_B)},
                 [this] { session_.camera().bookmark(); });
    follow(session_, this, &EditController::update);
    update();
}

void EditController::duplicate_experiment() {
    const std::string id = session_.experiment()->id;
    const bool done = session_.edit([&](const projects::Project& project) {
        return projects::edits::duplicate<projects::Experiment>(project, id);
    });
    if (!done) return;
    const auto* original = projects::find_item(session_.document().experiments, id);
    session_.select_experiment((original + 1)->id);
}

void EditController::remove_experiment() {
    const std::string id = session_.experiment()->id;
    session_.edit([&](const projects::Project& project) {
        return projects::edits::remove<projects::Experiment>(project, id);
    });
}

void EditController::update() {
    const bool open = session_.has_project(), writable = open && !session_.open_project().is_read_only();
    const auto set = [&](const char* name, const QString& text, bool possible, const auto& label) {
        auto* action = actions_.find(QLatin1String(name));
        action->setEnabled(writable && possible);
        action->setText(possible ? QStringLiteral("%1: %2").arg(text, entry_of(label())) : text);
    };
    const auto* stack = open ? &session_.open_project().undo_stack() : nullptr;
    set("undo", tr("&Undo"), stack && stack->can_undo(), [&] { return stack->undo_label(); });
    set("redo", tr("&Redo"), stack && stack->can_redo(), [&] { return stack->redo_label(); });
    actions_.enable("experiment-add scene-add image-add", writable);
    actions_.enable("experiment-duplicate experiment-rename experiment-remove bookmark",
                    writable && session_.experiment());
}

}  // namespace ir::gui
