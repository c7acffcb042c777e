#pragma once

#include <QMetaType>
#include <QString>

namespace ir::widgets {

/// What a project consists of. `part` is a file of a scene, `light` a single light of a set.
enum class ItemKind {
    none,
    project,
    scene,
    part,
    camera,
    light_set,
    light,
    motion,
    experiment,
    comparison,
    image,
    sweep,
    plot,
    analysis
};

/// One item of the project: by id, parts and single lights by their owner's id and their place in it.
struct ItemRef {
    ItemKind kind = ItemKind::none;
    QString id = {};
    int index = -1;

    bool operator==(const ItemRef&) const = default;
    bool is_valid() const { return kind != ItemKind::none; }
    /// "camera:nave", "part:atrium:0", "project": unique in a project, the key of problems and fold states.
    QString key() const;
    static ItemRef from_key(const QString& key);
    /// The scene of a part, the set of a single light; the item itself otherwise.
    ItemRef owner() const;
};

/// "camera", "set of lights", …: as messages call it.
QString kind_word(ItemKind kind);

}  // namespace ir::widgets

Q_DECLARE_METATYPE(ir::widgets::ItemRef)
