#pragma once

#include <QWidget>

#include "widgets/models/rows_model.h"
#include "widgets/models/word_search.h"
#include "widgets/panels/empty_tree_view.h"

class QLineEdit;

namespace ir::widgets {

/// A tree view over a RowsModel that fits its columns, keeps what was folded across resets, and copies the
/// chosen rows as text.
class RowsPanel : public QWidget {
    Q_OBJECT
  public:
    RowsPanel(const QStringList& headings, const QString& empty_text, QWidget* parent = nullptr);
    void set_rows(std::vector<Row> rows);
    /// A line above the rows: those without all of its words, in name, key or group, are hidden, but for
    /// groups of shown ones. Enter clicks the one that fits best, Esc clears it.
    void set_searchable(const QString& hint);
    /// Size of pictures in the first column, logical pixels.
    void set_picture_size(QSize size);
    /// The first column is cut only down to this many logical pixels.
    void set_name_width(int width) { name_width_ = width; }
    RowsModel& model() { return *model_; }
    EmptyTreeView* view() { return view_; }

  signals:
    void row_clicked(const QString& key);
    void row_activated(const QString& key);

  protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

  private:
    void restore_folding(const QModelIndex& parent);
    void fit_columns();
    void search();
    int fit(const QModelIndex& row, Letters letters) const;
    bool show_fitting(const QModelIndex& parent, const QString& query, Letters letters);
    QModelIndex best_fit() const;
    void copy();
    RowsModel* model_;
    EmptyTreeView* view_;
    QLineEdit* search_ = nullptr;
    QString empty_text_;
    QHash<QString, bool> open_;  ///< what a person folded or unfolded
    int name_width_ = 110;
    bool restoring_ = false;
};

}  // namespace ir::widgets
