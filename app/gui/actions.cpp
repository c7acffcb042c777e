#include "app/gui/actions.h"

#include <QAction>
#include <QStringList>
#include <QWidget>
#include <utility>

#include "app/gui/session.h"
#include "widgets/style/icons.h"

namespace ir::gui {

constexpr const char* reason_property = "why_not";

QAction* Actions::add(const QString& name, const QString& text, const char* icon,
                      const QList<QKeySequence>& keys, std::function<void()> run) {
    auto* action = new QAction(text, &window_);
    action->setObjectName(name);
    if (icon) action->setIcon(widgets::icon(icon));
    action->setShortcuts(keys);
    QString tip = text;
    tip.remove(QLatin1Char('&'));
    if (!keys.isEmpty()) tip += QStringLiteral(" (%1)").arg(keys.front().toString(QKeySequence::NativeText));
    action->setToolTip(tip);
    QObject::connect(action, &QAction::triggered, action, [run = std::move(run)] { run(); });
    window_.addAction(action);
    by_name_.insert(name, action);
    in_order_ << action;
    return action;
}

QAction* Actions::add_switch(const QString& name, const QString& text, const char* icon,
                             const QList<QKeySequence>& keys, bool on, std::function<void(bool)> run) {
    auto* action = add(name, text, icon, keys, [] {});
    action->setCheckable(true);
    action->setChecked(on);
    QObject::connect(action, &QAction::toggled, action, std::move(run));
    return action;
}

void Actions::enable(const char* names, bool enabled) const {
    for (const auto& name : QString(QLatin1String(names)).split(QLatin1Char(' ')))
        find(name)->setEnabled(enabled);
}

void Actions::fill(QWidget* bar, const char* names) const {
    for (const auto& name : QString(QLatin1String(names)).split(QLatin1Char(' '))) {
        const bool is_separator = name == QLatin1String("|");
        auto* action = is_separator ? new QAction(bar) : find(name);
        if (is_separator) action->setSeparator(true);
        bar->addAction(action);
    }
}

void set_reason(QAction& action, const QString& why_not) {
    const auto help = action.data().toString();
    action.setEnabled(why_not.isEmpty());
    action.setToolTip(why_not.isEmpty() ? help : QStringLiteral("%1.\n%2").arg(help, why_not));
    action.setProperty(reason_property, why_not);
}

QString why_disabled(const QAction& action) {
    return action.property(reason_property).toString();
}

void enable_with_experiment(const Session& session, const QList<QAction*>& actions) {
    const auto update = [&session, actions] {
        for (auto* action : actions) action->setEnabled(session.experiment() != nullptr);
    };
    follow(session, actions.front(), update);
    update();
}

}  // namespace ir::gui
