#pragma once

#include <QStringList>
#include <QWidget>

#include "widgets/results/results_model.h"

class QAction;
class QLabel;
class QLineEdit;
class QListWidget;

namespace ir::widgets {

class EmptyTreeView;

/// The kept results as a table, and below it what differs between two of them, or one and what its experiment
/// would render now.
class ResultsPanel : public QWidget {
    Q_OBJECT
  public:
    explicit ResultsPanel(QWidget* parent = nullptr);
    /// What stands in the place of an empty table.
    void set_empty_text(const QString& text);
    /// Selection, order and filter stay. Emits nothing.
    void set_rows(std::vector<ResultRow> rows);
    /// Not empty: nothing can be deleted, and why.
    void set_read_only(const QString& reason);
    /// Below the table; without lines `nothing` stands there.
    void show_changes(const QString& title, const QStringList& lines, const QString& nothing);
    void hide_changes();

    ResultsModel& model() { return *model_; }
    ResultsFilter& filter() { return *filter_; }
    EmptyTreeView& view() { return *view_; }
    QStringList selected() const;  ///< keys, older ones first
    void select(const QStringList& keys);
    QAction* action(const QString& name) const { return findChild<QAction*>(name); }

  signals:
    void show_wanted(const QString& key, bool as_b);
    /// Two results, or one and the present state.
    void changes_wanted(const QStringList& keys);
    void delete_wanted(const QStringList& keys);
    void reveal_wanted(const QString& key);
    void selection_changed();

  private:
    QWidget* make_bar();
    QWidget* make_changes();
    QAction* add(const QString& name, const QString& text, const QString& tip, const char* icon_name,
                 const QList<QKeySequence>& keys);
    void make_actions();
    void update_actions();
    void copy_rows();
    void copy_changes();

    ResultsModel* model_;
    ResultsFilter* filter_;
    EmptyTreeView* view_;
    QLineEdit* search_ = nullptr;
    QWidget* changes_ = nullptr;
    QLabel* changes_title_ = nullptr;
    QListWidget* changes_list_ = nullptr;
    QString empty_text_, read_only_;
};

}  // namespace ir::widgets
