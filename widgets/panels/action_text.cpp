#include "widgets/panels/action_text.h"

#include <QAction>
#include <QMenu>
#include <QToolButton>

namespace ir::widgets {
namespace {

const QMenu* menu_of(const QAction& action) {
    for (const QObject* owner : action.associatedObjects())
        // A menu without a title is a context menu, or what a narrow menu bar hides its last menus in.
        if (const auto* menu = qobject_cast<const QMenu*>(owner); menu && !menu->title().isEmpty())
            return menu;
    return nullptr;
}

constexpr const char* action_property = "panel-action";

}  // namespace

void mark_as_action(QToolButton& button) {
    button.setProperty(action_property, true);
}

QList<QToolButton*> actions_in(const QWidget& panel) {
    auto buttons = panel.findChildren<QToolButton*>();
    buttons.removeIf([&](const auto* button) {
        return !button->property(action_property).toBool() || !button->isVisibleTo(&panel);
    });
    return buttons;
}

QString plain_text(QString text) {
    // "&&" is a real ampersand, a single one marks the letter.
    text.replace(QStringLiteral("&&"), QString(QChar(0)));
    text.remove(QLatin1Char('&'));
    return text.replace(QChar(0), QLatin1Char('&'));
}

QString menu_title(const QAction& action) {
    QStringList titles;
    for (const QMenu* menu = menu_of(action); menu; menu = menu_of(*menu->menuAction()))
        titles.prepend(plain_text(menu->title()));
    return titles.isEmpty() ? QObject::tr("Other") : titles.join(QStringLiteral(" › "));
}

QString keys_of(const QAction& action) {
    QStringList keys;
    for (const auto& key : action.shortcuts()) keys << key.toString(QKeySequence::NativeText);
    return keys.join(QObject::tr(" or "));
}

}  // namespace ir::widgets
