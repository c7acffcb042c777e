#pragma once

#include <QFrame>
#include <QImage>
#include <functional>
#include <optional>
#include <vector>

#include "widgets/models/word_search.h"

class QHelpEvent;
class QLabel;
class QLineEdit;
class QListView;
class QModelIndex;
class QStandardItemModel;

namespace ir::widgets {

/// An entry of a list of buffers or pictures.
struct SearchEntry {
    QString key, label, doc;
    QString group = {};          ///< the heading that it stands under; entries of one are neighbours
    const char* sign = nullptr;  ///< name of its icon
    /// Where several are chosen: whether it is one of them.
    std::optional<bool> is_chosen = {};
    bool operator==(const SearchEntry&) const = default;
};

/// A list in a window of its own, searched by words (`fit_of`) of an entry's label, key or group. Rows that
/// cannot be chosen are groups, seen where an entry below them is. It closes with a choice, unless several
/// are chosen.
class SearchList : public QFrame {
    Q_OBJECT
  public:
    static constexpr int key_role = Qt::UserRole, place_role = Qt::UserRole + 1;  ///< place of the entry

    explicit SearchList(QWidget* parent);
    void set_entries(const std::vector<SearchEntry>& entries);
    const std::vector<SearchEntry>& entries() const { return entries_; }
    /// What it says without entries.
    void set_empty_text(const QString& text) { empty_text_ = text; }
    /// Shown with the tooltip of a row; asked for when it is pointed at.
    void set_pictures(std::function<QImage(const QModelIndex&)> pictures) { pictures_ = std::move(pictures); }
    QStandardItemModel* model() const { return model_; }
    /// Below (or, without room, above) a control; with this row as the current one, -1: none.
    void open_at(const QWidget& control, int row = -1);

  signals:
    void chosen(const QModelIndex& row);

  protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

  private:
    void fill();
    void search(const QString& query);
    int show_fitting(const QString& query, Letters letters);
    void choose(const QModelIndex& row);
    void show_tip(const QHelpEvent& event) const;

    std::vector<SearchEntry> entries_;
    QString empty_text_;
    QStandardItemModel* model_;
    QLineEdit* line_;
    QLabel* nothing_;
    QListView* list_;
    std::function<QImage(const QModelIndex&)> pictures_;
};

}  // namespace ir::widgets
