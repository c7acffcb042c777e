#include "widgets/inspect/inspector_model.h"

#include <algorithm>
#include <set>

#include "widgets/image/display.h"

namespace ir::widgets {
namespace {

QString text(const std::string& s) {
    return QString::fromStdString(s);
}

/// The names of groups in order: the outputs, then the passes as they come.
QStringList group_order(const std::vector<Readings::Buffer>& buffers) {
    QStringList groups;
    if (std::any_of(buffers.begin(), buffers.end(), [](const auto& b) { return b.output; }))
        groups << QString();  // the outputs'
    for (const auto& buffer : buffers)
        if (!buffer.output && !groups.contains(buffer.group)) groups << buffer.group;
    return groups;
}

bool in_group(const Readings::Buffer& buffer, bool outputs, const QString& group) {
    return buffer.output ? outputs : !outputs && buffer.group == group;
}

}  // namespace

InspectorModel::InspectorModel(QObject* parent) : QAbstractItemModel(parent) {
    set_readings({});
}

std::vector<InspectorModel::Node> InspectorModel::build() const {
    std::vector<Node> nodes;
    using Kind = Node::Kind;
    nodes.push_back({Kind::position, -1, 0, -1, -1, QStringLiteral("position"), tr("Pixel")});
    if (world_known_)
        nodes.push_back({Kind::world, -1, 1, -1, -1, QStringLiteral("world"), tr("World position")});
    int top = int(nodes.size());
    bool outputs = std::any_of(readings_.buffers.begin(), readings_.buffers.end(),
                               [](const auto& buffer) { return buffer.output; });
    const auto add = [&nodes](Node node) {
        const int number = int(nodes.size());
        if (node.parent >= 0) {
            auto& siblings = nodes[std::size_t(node.parent)].children;
            node.row = int(siblings.size());
            siblings.push_back(number);
        }
        nodes.push_back(std::move(node));
        return number;
    };
    for (const QString& group : group_order(readings_.buffers)) {
        const QString name = outputs ? tr("Outputs") : group.isEmpty() ? tr("Other buffers") : group;
        const QString key = (outputs ? QStringLiteral("outputs") : QStringLiteral("group:")) + group;
        const int parent = add({Kind::group, -1, top++, -1, -1, key, name});
        for (std::size_t b = 0; b < readings_.buffers.size(); ++b) {
            const auto& buffer = readings_.buffers[b];
            if (!in_group(buffer, outputs, group)) continue;
            const QString label = buffer.label.isEmpty() ? text(buffer.key) : buffer.label;
            const int row = add({Kind::buffer, parent, 0, int(b), -1, text(buffer.key), label});
            for (int c = 0; buffer.channels > 1 && c < buffer.channels; ++c)
                add({Kind::channel, row, 0, int(b), c, QStringLiteral("%1#%2").arg(text(buffer.key)).arg(c),
                     channel_name(buffer.semantic, buffer.channels, c)});
        }
        outputs = false;
    }
    return nodes;
}

void InspectorModel::set_readings(Readings readings) {
    world_known_ = world_known_ || !readings.world.empty();
    readings_ = std::move(readings);
    for (auto& buffer : readings_.buffers) {
        int& known = channels_[buffer.key];
        if (buffer.channels == 0) buffer.channels = known;
        known = buffer.channels;
    }
    for (const auto& buffer : readings_.buffers)
        if (buffer.available) wanted_.remove(text(buffer.key));
    std::vector<Node> nodes = build();
    const bool same = std::equal(nodes.begin(), nodes.end(), nodes_.begin(), nodes_.end(),
                                 [](const Node& a, const Node& b) {
                                     return a.kind == b.kind && a.key == b.key && a.parent == b.parent;
                                 });
    if (same) {
        nodes_ = std::move(nodes);
        announce();
        return;
    }
    beginResetModel();
    nodes_ = std::move(nodes);
    top_.clear();
    for (std::size_t n = 0; n < nodes_.size(); ++n)
        if (nodes_[n].parent < 0) top_.push_back(int(n));
    endResetModel();
}

void InspectorModel::set_pins(std::vector<QPoint> pins) {
    if (pins == pins_) return;
    const bool same_columns = pins.size() == pins_.size();
    if (!same_columns) beginResetModel();
    pins_ = std::move(pins);
    if (!same_columns) return endResetModel();
    announce();
    emit headerDataChanged(Qt::Horizontal, first_pin_column, columnCount() - 1);
}

void InspectorModel::mark_wanted(const QString& key) {
    wanted_.insert(key);
    announce();
}

int InspectorModel::not_computed() const {
    return int(std::count_if(readings_.buffers.begin(), readings_.buffers.end(),
                             [](const auto& buffer) { return !buffer.available; }));
}

void InspectorModel::announce() {
    const auto tell = [this](const std::vector<int>& siblings) {
        if (siblings.empty()) return;
        const int last = int(siblings.size()) - 1;
        emit dataChanged(createIndex(0, 0, quintptr(siblings.front())),
                         createIndex(last, columnCount() - 1, quintptr(siblings.back())));
    };
    tell(top_);
    for (const Node& node : nodes_) tell(node.children);
}

QModelIndex InspectorModel::index_of(const QString& key) const {
    for (std::size_t n = 0; n < nodes_.size(); ++n)
        if (nodes_[n].key == key) return createIndex(nodes_[n].row, 0, quintptr(n));
    return {};
}

const std::vector<int>& InspectorModel::children(const QModelIndex& parent) const {
    return parent.isValid() ? node(parent).children : top_;
}

QModelIndex InspectorModel::index(int row, int column, const QModelIndex& parent) const {
    if (!hasIndex(row, column, parent)) return {};
    return createIndex(row, column, quintptr(children(parent)[std::size_t(row)]));
}

QModelIndex InspectorModel::parent(const QModelIndex& child) const {
    if (!child.isValid() || node(child).parent < 0) return {};
    const int parent = node(child).parent;
    return createIndex(nodes_[std::size_t(parent)].row, 0, quintptr(parent));
}

int InspectorModel::rowCount(const QModelIndex& parent) const {
    return parent.column() > 0 ? 0 : int(children(parent).size());
}

int InspectorModel::columnCount(const QModelIndex&) const {
    return first_pin_column + int(pins_.size());
}

InspectorFilter::InspectorFilter(QObject* parent) : QSortFilterProxyModel(parent) {
    setRecursiveFilteringEnabled(true);
    setAutoAcceptChildRows(true);
}

void InspectorFilter::set_text(const QString& text) {
    text_ = text.simplified();
    for (const auto letters : {Letters::all, Letters::some}) {
        letters_ = letters;
        invalidateFilter();
        if (has_buffer()) break;
    }
}

/// Beside the rows that always stay.
bool InspectorFilter::has_buffer() const {
    for (int i = 0; i < rowCount(); ++i)
        if (hasChildren(index(i, 0))) return true;
    return false;
}

bool InspectorFilter::filterAcceptsRow(int row, const QModelIndex& parent) const {
    if (text_.isEmpty()) return true;
    const QModelIndex at = sourceModel()->index(row, InspectorModel::name_column, parent);
    const QString key = at.data(InspectorModel::key_role).toString();
    if (!parent.isValid() && (key == QStringLiteral("position") || key == QStringLiteral("world")))
        return true;                                   // where the numbers are from is always of use
    if (at.parent().parent().isValid()) return false;  // channels follow their buffer
    return fit_of(text_, at.data().toString(), {key, parent.data().toString()}, letters_) > 0;
}

}  // namespace ir::widgets
