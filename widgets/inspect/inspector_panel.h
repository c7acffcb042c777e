#pragma once

#include <QHash>
#include <QWidget>

#include "widgets/inspect/inspector_model.h"

class QCheckBox;
class QLabel;
class QLineEdit;
class QMenu;
class QToolButton;
class QTreeView;

namespace ir::widgets {

/// All channels of all buffers at the pixel under the cursor and at pinned pixels. Who shows it reads the
/// pixels; this only asks.
class InspectorPanel : public QWidget {
    Q_OBJECT
  public:
    explicit InspectorPanel(QWidget* parent = nullptr);
    /// New values; cheap enough for each movement of the mouse.
    void set_readings(Readings readings);
    /// The pixels that have a column of their own, in the order of their numbers (from 1 on).
    void set_pins(const std::vector<QPoint>& pins);
    /// Shows whether all buffers are computed, also those nobody looks at; emits nothing.
    void set_compute_all(bool on);
    /// What a picked pixel shows, in a sentence; empty: nobody knows.
    void set_surface(const QString& text);
    InspectorModel& model() { return *model_; }
    QTreeView& view() { return *view_; }
    /// What Copy puts on the clipboard.
    QString text() const { return model_->to_text(QLatin1Char('\t')); }
    QString csv() const { return model_->to_text(QLatin1Char(',')); }

  signals:
    void compute_wanted(const QString& key);  ///< a buffer that was not computed
    void compute_all_chosen(bool on);
    void show_wanted(const QString& key);  ///< in the active view: double click or Enter
    void pin_wanted(QPoint pixel);
    void pin_removed(int number);  ///< from 0 on
    void pins_cleared();
    void fly_wanted(int number);  ///< from 0 on
    void explain_wanted(QPoint pixel);

  public slots:
    void copy_text();
    void copy_csv();
    /// Pins the pixel under the cursor, if there is one.
    void pin_cursor();

  protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

  private:
    QWidget* make_bar();
    void make_view();
    void clicked(const QModelIndex& at);
    void activated(const QModelIndex& at);
    void add_column_actions(QMenu& menu, int column);
    void show_column_menu(int column, QPoint at);
    void show_menu(QPoint at);
    void copy_selection();
    void point_at(QPoint at);
    /// The chosen pin's pixel, else the one under the cursor.
    std::optional<QPoint> chosen_pixel() const;
    void remember_place();
    void restore_all();
    void restore(const QModelIndex& parent);
    void fit_columns();
    void update_controls();

    InspectorModel* model_;
    InspectorFilter* filter_;
    QTreeView* view_;
    QLineEdit* search_ = nullptr;
    QToolButton *pin_ = nullptr, *explain_ = nullptr, *clear_ = nullptr;
    QCheckBox* compute_all_ = nullptr;
    QLabel *missing_ = nullptr, *surface_ = nullptr;
    QHash<QString, bool> open_;  ///< what a person folded or unfolded
    std::vector<bool> sized_;    ///< columns that have their first width
    QString current_;
    int current_column_ = 0, scrolled_ = 0;
    bool restoring_ = false;
};

}  // namespace ir::widgets
