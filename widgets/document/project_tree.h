#pragma once

#include <QHash>
#include <QSortFilterProxyModel>
#include <QTreeView>

class QAction;
class QKeyEvent;

namespace ir::widgets {

/// Items whose name or details contain a text, with the groups that they stand in.
class ProjectFilter : public QSortFilterProxyModel {
    Q_OBJECT
  public:
    explicit ProjectFilter(QObject* parent);
    void set_text(const QString& text);
    const QString& text() const { return text_; }

  protected:
    bool filterAcceptsRow(int row, const QModelIndex& parent) const override;

  private:
    QString text_;
};

/// The view: keeps what was folded across resets, and gives its own keys precedence over the window's as long
/// as it has the focus (the window uses F2 and Ctrl+D for the experiment that is looked at).
class ProjectTree : public QTreeView {
    Q_OBJECT
  public:
    explicit ProjectTree(QWidget* parent);
    void setModel(QAbstractItemModel* model) override;
    /// Triggered by its key here; where it is disabled, its tooltip is shown.
    void add_key(const QKeySequence& key, QAction* action);
    /// Unfolds groups, folds items, except where a person chose otherwise; with `all`, unfolds everything.
    void restore_folding(bool all);

  protected:
    bool event(QEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;

  private:
    QAction* action_for(const QKeyEvent& event) const;
    void restore_below(const QModelIndex& parent, bool all);
    QHash<QKeySequence, QAction*> keys_;
    QHash<QString, bool> open_;
    bool restoring_ = false;
};

}  // namespace ir::widgets
