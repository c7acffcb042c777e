#pragma once

#include <QAbstractItemModel>
#include <QColor>
#include <QIcon>
#include <QImage>
#include <QPoint>
#include <QSet>
#include <QSortFilterProxyModel>
#include <QString>
#include <array>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "renderers/core/output.h"
#include "widgets/models/word_search.h"

namespace ir::widgets {

/// What was read of an execution's images at some pixels. Plain data.
struct Readings {
    struct Buffer {
        std::string key = {};
        QString label = {}, unit = {}, doc = {};
        QString group = {};  ///< the pass that writes it; unused where `output`
        Semantic semantic = Semantic::generic;
        bool output = false;                          ///< one of the method's outputs: listed first
        bool available = false;                       ///< false: not computed
        int channels = 0;                             ///< 0: not known; rows stay as they were
        std::vector<std::vector<float>> values = {};  ///< one by pixel, `channels` numbers or none
        std::vector<Category> categories = {};        ///< where numbers, or colours, are names
    };
    std::optional<QPoint> cursor;  ///< one of `pixels`; none: the cursor is elsewhere
    std::vector<QPoint> pixels;
    /// Metres, one by pixel; empty, or with NaN: not known.
    std::vector<std::array<float, 3>> world = {};
    std::vector<Buffer> buffers;
};

/// The colour of a pin's mark, by its number from 0 on, and the mark itself with the number from 1 on.
QColor pin_colour(int number);
QIcon pin_icon(int number);

/// Groups → buffers → channels; columns: name, cursor, one a pin. New readings of the same shape come in
/// place, so that selection, scrolling and expansion stay.
class InspectorModel : public QAbstractItemModel {
    Q_OBJECT
  public:
    enum Column { name_column, cursor_column, first_pin_column };
    enum Role {
        key_role = Qt::UserRole,  ///< "buffer" or "buffer#2" for its channel 2; "group:NAME" for groups
        buffer_role,              ///< key of the buffer, empty for groups and position
        available_role,
        full_role  ///< the value with all digits of a float, channels separated by spaces
    };
    explicit InspectorModel(QObject* parent = nullptr);

    void set_readings(Readings readings);
    void set_pins(std::vector<QPoint> pins);
    const Readings& readings() const { return readings_; }
    const std::vector<QPoint>& pins() const { return pins_; }
    QModelIndex index_of(const QString& key) const;
    /// Says "being computed" of a buffer until it is available.
    void mark_wanted(const QString& key);
    int not_computed() const;
    /// Small pictures for tooltips, by key of the buffer; null: there is none.
    void set_thumbnails(std::function<QImage(const std::string&)> thumbnails) {
        thumbnails_ = std::move(thumbnails);
    }
    /// The pixel that a column stands for.
    std::optional<QPoint> place_of(int column) const;
    /// A header line, then a line a buffer's channel: group, key, channel, unit, cursor, pins; all digits.
    /// `separator` is ',' for CSV (quoted where needed) or a tab.
    QString to_text(QChar separator) const;

    QModelIndex index(int row, int column, const QModelIndex& parent = {}) const override;
    QModelIndex parent(const QModelIndex& child) const override;
    int rowCount(const QModelIndex& parent = {}) const override;
    int columnCount(const QModelIndex& parent = {}) const override;
    QVariant data(const QModelIndex& index, int role = Qt::DisplayRole) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

  private:
    /// A row as the tree knows it: what it stands for, its parent and its children by number.
    struct Node {
        enum class Kind { group, position, world, buffer, channel } kind = Kind::group;
        int parent = -1, row = 0;
        int buffer = -1, channel = -1;
        QString key, name;
        std::vector<int> children = {};
    };
    std::vector<Node> build() const;
    void announce();
    const Node& node(const QModelIndex& index) const { return nodes_[std::size_t(index.internalId())]; }
    const std::vector<int>& children(const QModelIndex& parent) const;
    /// Number of a column's pixel among the readings, -1 when it was not read.
    int pixel_of(int column) const;
    std::vector<float> values(const Node& node, int column) const;
    const Category* category(const Node& node, const std::vector<float>& numbers) const;
    QString value_text(const Node& node, int column) const;
    QVariant name_data(const Node& node, int role) const;
    QVariant value_data(const Node& node, int column, int role) const;
    QString tooltip(const Node& node) const;

    Readings readings_;
    std::function<QImage(const std::string&)> thumbnails_;
    std::vector<QPoint> pins_;
    std::vector<Node> nodes_;
    std::vector<int> top_;
    std::map<std::string, int> channels_;  ///< by key, last known: values that go away do not change rows
    QSet<QString> wanted_;                 ///< asked for, not there yet
    bool world_known_ = false;             ///< once known its row stays, so that rows do not jump
};

/// Rows that fit the words of a text (`fit_of`), by name, key or group.
class InspectorFilter : public QSortFilterProxyModel {
    Q_OBJECT
  public:
    explicit InspectorFilter(QObject* parent = nullptr);
    void set_text(const QString& text);

  protected:
    bool filterAcceptsRow(int row, const QModelIndex& parent) const override;

  private:
    bool has_buffer() const;

    QString text_;
    Letters letters_ = Letters::all;
};

}  // namespace ir::widgets
