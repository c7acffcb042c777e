#pragma once

#include <QByteArray>
#include <QObject>
#include <QRect>
#include <QSize>
#include <QStringList>
#include <functional>

class QAction;
class QDockWidget;
class QKeySequence;
class QMainWindow;
class QMenu;
class QWidget;

namespace ir::widgets {
class ViewArea;
}

namespace ir::gui {

class Actions;

/// A screen of 1280×800 without its title bar: there the panels of both sides fit beside four views.
inline constexpr QSize min_size_for_all_panels(1280, 770);

/// A window's geometry, without its frame, moved and shrunk into what the screen has for windows; above it
/// stands a title bar of that height.
QRect within(QRect window, const QRect& available, int title_bar);

/// Bumped when docks are added or renamed, so that a remembered arrangement of other docks is not applied.
inline constexpr int dock_version = 12;

/// The window's docks: how they are arranged, on large and on small screens, and what is remembered of that.
class DockLayout : public QObject {
    Q_OBJECT
  public:
    DockLayout(QMainWindow& window, widgets::ViewArea& views, Actions& actions);
    /// With an action "dock-NAME" that shows and hides it; menus underline the letter behind the title's "&".
    void add(const QString& name, const QString& title, QWidget* content, const QKeySequence& key);
    /// Shown, and neither hidden nor covered by another tab.
    bool is_seen(const QString& name) const;
    void raise(const QString& name) const;
    void hide(const QString& name) const;
    void fill(QMenu* menu) const;  ///< with the actions that show and hide docks

    /// The default arrangement, with one view.
    void restore_default();
    static QStringList names();
    /// Those that a menu offers.
    struct Entry {
        QString name, title, doc;
    };
    static QList<Entry> entries();
    /// What an arrangement is called now; it may have been called otherwise. Throws UsageError that lists the
    /// known ones.
    static QString present_name(const QString& name);
    /// Without a project, what a layout does with its pictures waits until there is one.
    void apply(const QString& name);
    /// What layouts for comparing call: the active view begins to compare, unless there is nothing to
    /// compare.
    void set_compare(std::function<bool()> begins) { compare_ = std::move(begins); }
    /// The panels as they stand, and back.
    QByteArray save() const { return arrangement(); }
    void load(const QByteArray& state);
    void hide_all() const;
    /// The welcome page stands alone; with a project the docks come back as they were.
    void show(bool shown);
    /// Arranges the window for what a screen has for windows. One that has less than min_size_for_all_panels
    /// has an arrangement of its own: the panels of both sides stand behind each other,
    /// so that four views of whatever project find room beside them.
    void fit(const QRect& available);
    void fit_screen();  ///< fit() for the screen that the window is on
    void restore();     ///< what remember() has written, in this run or before
    void remember() const;

  signals:
    /// Other docks may be seen now.
    void seen_changed();

  protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

  private:
    QDockWidget* dock(const QString& name) const;
    QList<QDockWidget*> docks() const;
    QAction* toggle_of(const QDockWidget* dock) const;
    void look();  ///< soon: visibility changes in the middle of rearrangements
    void arrange();
    void open(QDockWidget* dock) const;
    void toggle(QDockWidget* dock);
    QByteArray arrangement() const;  ///< as it is with a project
    void set_cramped(bool cramped);
    /// Panels at the sides that nobody made wider or narrower are as wide as suits the window.
    void follow_width();

    QMainWindow& window_;
    widgets::ViewArea& views_;
    Actions& actions_;
    std::function<bool()> compare_;
    QString waiting_;         ///< the layout that waits for a project
    QByteArray hidden_;       ///< the arrangement while the welcome page is shown
    QByteArray other_;        ///< that of small screens on a large one, and the other way round
    int followed_width_ = 0;  ///< the window's, which widths of panels suit
    bool has_project_ = false, is_hidden_ = false, is_cramped_ = false;
};

}  // namespace ir::gui
