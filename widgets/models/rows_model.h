#pragma once

#include <QAbstractItemModel>
#include <QImage>
#include <QString>
#include <QVariant>
#include <memory>
#include <string>
#include <vector>

namespace ir::widgets {

/// One cell of a row: what is shown, how it sorts, what the tooltip says.
struct Cell {
    QString text;
    QString tooltip = {};
    QImage picture = {};
    const char* sign = nullptr;  ///< where there is no picture; as in widgets::icon()
    bool number = false;         ///< right-aligned
    bool operator==(const Cell&) const = default;
};

/// A row of a tree as plain data. Keys are unique among siblings.
struct Row {
    std::string key;
    std::vector<Cell> cells;
    std::vector<Row> children = {};
    bool dim = false;     ///< there, but without content: drawn grey
    bool strong = false;  ///< a total or the current one: drawn bold
    bool folded = false;  ///< its children are hidden until somebody unfolds it
};

/// A read-only tree of rows. Data of the same shape replaces the old in place, so that selection, scrolling
/// and expansion stay.
class RowsModel : public QAbstractItemModel {
    Q_OBJECT
  public:
    enum Role { key_role = Qt::UserRole, folded_role };
    explicit RowsModel(QStringList headings, QObject* parent = nullptr);

    void set_rows(std::vector<Row> rows);
    const std::vector<Row>& rows() const { return rows_; }
    /// Index of the first row with the key at any depth; invalid when there is none.
    QModelIndex index_of(const std::string& key) const;

    QModelIndex index(int row, int column, const QModelIndex& parent = {}) const override;
    QModelIndex parent(const QModelIndex& child) const override;
    int rowCount(const QModelIndex& parent = {}) const override;
    int columnCount(const QModelIndex& parent = {}) const override;
    QVariant data(const QModelIndex& index, int role = Qt::DisplayRole) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role) const override;
    // A row that is dragged brings its key. Headings stay.
    Qt::ItemFlags flags(const QModelIndex& index) const override;
    QStringList mimeTypes() const override { return {QLatin1String(mime_type)}; }
    QMimeData* mimeData(const QModelIndexList& indexes) const override;
    static constexpr const char* mime_type = "application/x-interreflect-row";

  private:
    struct Place {
        const Row* row = nullptr;
        Place* parent = nullptr;
        int number = 0;
        std::vector<std::unique_ptr<Place>> children;
    };
    void link(Place& place, const std::vector<Row>& rows);
    void announce(const QModelIndex& parent);
    const Place& place_of(const QModelIndex& index) const;
    QModelIndex find_below(const QModelIndex& parent, const std::string& key) const;

    QStringList headings_;
    std::vector<Row> rows_;
    Place root_;
};

}  // namespace ir::widgets
