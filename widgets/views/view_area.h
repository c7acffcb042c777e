#pragma once

#include <QMainWindow>
#include <functional>
#include <vector>

class QAction;
class QDockWidget;

namespace ir::widgets {

/// One to four views as docks of their own: moved, tabbed, floated, closed; one of them is the active one, to
/// which panels and keys belong. At least one stays. A view keeps what it shows wherever it is moved; what it
/// is called goes by its place.
class ViewArea : public QMainWindow {
    Q_OBJECT
  public:
    static constexpr int max_views = 4;
    enum class Arrangement { one, side_by_side, stacked, three, four };

    /// `make` is called for a view when it is first shown.
    ViewArea(std::function<QWidget*(int view)> make, QWidget* parent = nullptr);

    QWidget* view(int number) const { return views_[std::size_t(number)]; }  ///< null: never shown
    QDockWidget* dock(int number) const { return docks_[std::size_t(number)]; }
    bool is_open(int number) const;
    std::vector<int> open_views() const;
    /// What titles, links and people call an open view: its place, line by line from the upper left; 0: it is
    /// not open.
    int number_of(int view) const;
    /// The open views in the order of their numbers.
    std::vector<int> as_one_reads() const;
    int active() const { return active_; }
    void set_active(int number);
    void set_title(int view, const QString& title);

    void arrange(Arrangement arrangement);
    /// Opens another view beside the active one and makes it active; -1 when all are open.
    int open_another();
    void open(int number);
    void close_view(int number);
    /// An open view comes to the front and gets the keyboard.
    void go_to(int number);
    /// The next (previous) open view becomes active.
    void step_active(int step);

    QByteArray save() const;
    bool restore(const QByteArray& state);

  signals:
    void active_changed(int view);
    /// Views were opened or closed.
    void views_changed();

  protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

  private:
    void ensure(int number);
    void take_all_out();
    void follow_focus(QWidget* now);
    void mark_active();
    void number_titles();
    void number_soon();
    std::function<QWidget*(int)> make_;
    std::vector<QDockWidget*> docks_;
    std::vector<QWidget*> views_;
    std::vector<QString> titles_;
    int active_ = 0;
    bool arranging_ = false, numbering_ = false;
};

}  // namespace ir::widgets
