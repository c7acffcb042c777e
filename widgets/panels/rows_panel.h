#pragma once

#include <QWidget>

#include "widgets/models/rows_model.h"

class QTreeView;

namespace ir::widgets {

/// A tree view over a RowsModel that fits its columns, keeps what was folded across resets, and copies the
/// chosen rows as text.
class RowsPanel : public QWidget {
    Q_OBJECT
  public:
    RowsPanel(const QStringList& headings, const QString& empty_text, QWidget* parent = nullptr);
    void set_rows(std::vector<Row> rows);
    /// Size of pictures in the first column, logical pixels.
    void set_picture_size(QSize size);
    /// Rows whose key begins so start folded.
    void fold_at_first(const std::string& prefix) { folded_prefixes_.push_back(prefix); }
    RowsModel& model() { return *model_; }
    QTreeView* view() { return view_; }

  signals:
    void row_clicked(const QString& key);
    void row_activated(const QString& key);

  private:
    void restore_folding(const QModelIndex& parent);
    bool folds(const QString& key) const;
    void copy();
    RowsModel* model_;
    QTreeView* view_;
    QString empty_text_;
    std::vector<std::string> folded_prefixes_;
    QHash<QString, bool> open_;
};

}  // namespace ir::widgets
