#pragma once

#include <QAbstractItemModel>
#include <QHash>
#include <QSet>
#include <memory>
#include <vector>

#include "renderers/core/method.h"
#include "widgets/document/item_ref.h"

namespace ir::projects {
struct Project;
}

namespace ir::widgets {

/// The project as a tree: itself, then a group for each kind of item. It holds no document: it copies what it
/// shows, and asks for changes by signals.
class ProjectModel : public QAbstractItemModel {
    Q_OBJECT
  public:
    enum Column { name_column, detail_column, column_count };
    enum Role { key_role = Qt::UserRole, kind_role, is_group_role };

    struct Node {
        ItemRef item;                     ///< kind none: a hint of an empty group
        ItemKind group = ItemKind::none;  ///< of a group's own row
        QString name, detail, tooltip;
        const char* icon = nullptr;
        Node* parent = nullptr;
        int row = 0;
        std::vector<std::unique_ptr<Node>> children = {};
    };

    explicit ProjectModel(QObject* parent = nullptr);
    void set_project(const projects::Project& project, const Registry& registry);
    void clear();
    void set_read_only(bool read_only);
    /// Id of the experiment that is looked at.
    void set_current_experiment(const QString& id);
    /// Ids of experiments whose kept results are no longer what they would render.
    void set_stale(const QSet<QString>& experiments);
    /// ItemRef::key() → what is wrong ("nave.gltf is missing").
    void set_problems(const QHash<QString, QString>& problems);

    QModelIndex index_of(const ItemRef& item) const;
    QModelIndex group_index(ItemKind kind) const;
    ItemRef item(const QModelIndex& index) const;
    /// The kind of items that the row holds or is; none for hints.
    ItemKind kind(const QModelIndex& index) const;
    std::vector<ItemRef> items() const;

    QModelIndex index(int row, int column, const QModelIndex& parent = {}) const override;
    QModelIndex parent(const QModelIndex& child) const override;
    int rowCount(const QModelIndex& parent = {}) const override;
    int columnCount(const QModelIndex& parent = {}) const override;
    QVariant data(const QModelIndex& index, int role = Qt::DisplayRole) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role) const override;
    Qt::ItemFlags flags(const QModelIndex& index) const override;
    bool setData(const QModelIndex& index, const QVariant& value, int role) override;
    Qt::DropActions supportedDropActions() const override;
    QStringList mimeTypes() const override;
    QMimeData* mimeData(const QModelIndexList& indexes) const override;
    bool canDropMimeData(const QMimeData* data, Qt::DropAction action, int row, int column,
                         const QModelIndex& parent) const override;
    bool dropMimeData(const QMimeData* data, Qt::DropAction action, int row, int column,
                      const QModelIndex& parent) override;

  signals:
    void rename_wanted(const ir::widgets::ItemRef& item, const QString& name);
    /// To this place in the list without the item.
    void move_wanted(const ir::widgets::ItemRef& item, int position);

  private:
    Node* node_of(const QModelIndex& index) const;
    QModelIndex index_at(const Node* node, int column = 0) const;
    QVariant name_data(const Node& node, int role) const;
    QVariant detail_data(const Node& node, int role) const;
    QString tooltip(const Node& node) const;
    bool is_stale(const Node& node) const;
    QString problem_of(const Node& node) const;
    void announce(const Node& node);

    std::unique_ptr<Node> root_;
    bool read_only_ = false;
    QString current_;
    QSet<QString> stale_;
    QHash<QString, QString> problems_;
};

}  // namespace ir::widgets
