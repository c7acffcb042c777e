#pragma once

#include <QHash>
#include <QKeySequence>
#include <QList>
#include <functional>

class QAction;
class QWidget;

namespace ir::gui {

class Session;

/// The window's actions by name. Controllers add theirs; menus and toolbar show them.
class Actions {
  public:
    explicit Actions(QWidget& window) : window_(window) {}

    /// Its tooltip is the text with the first key. `icon` as in widgets::icon(); null: none.
    QAction* add(const QString& name, const QString& text, const char* icon, const QList<QKeySequence>& keys,
                 std::function<void()> run);
    QAction* add_switch(const QString& name, const QString& text, const char* icon,
                        const QList<QKeySequence>& keys, bool on, std::function<void(bool)> run);

    QAction* find(const QString& name) const { return by_name_.value(name); }  ///< null: there is none
    const QList<QAction*>& in_order() const { return in_order_; }
    // Names stand between blanks.
    void enable(const char* names, bool enabled) const;
    /// Adds actions to a menu or toolbar; "|" is a separator.
    void fill(QWidget* bar, const char* names) const;

  private:
    QWidget& window_;
    QHash<QString, QAction*> by_name_;
    QList<QAction*> in_order_;
};

/// Also while it is disabled, a tooltip says what an action would do, and why it cannot. Its data is what it
/// does; without a reason it is enabled.
void set_reason(QAction& action, const QString& why_not);
QString why_disabled(const QAction& action);
/// They are enabled while there is an experiment, from now on.
void enable_with_experiment(const Session& session, const QList<QAction*>& actions);

}  // namespace ir::gui
