#include <QColor>
#include <QFont>
#include <QIcon>
#include <QPainter>
#include <algorithm>
#include <cmath>

#include "renderers/core/value.h"
#include "renderers/image/channels.h"
#include "renderers/image/colour_map.h"
#include "widgets/image/display.h"
#include "widgets/inspect/inspector_model.h"
#include "widgets/style/rich_text.h"
#include "widgets/style/theme.h"

/// What the cells of the inspector show.
namespace ir::widgets {
namespace {

using Buffer = Readings::Buffer;

constexpr int max_in_a_cell = 4;

/// Ids and counts need all their digits.
QString number(float value, Semantic semantic) {
    const bool counts = semantic == Semantic::id || semantic == Semantic::count;
    if (counts && value == std::floor(value) && std::abs(value) < 1e9f)
        return QString::number(double(value), 'f', 0);
    return short_number(value);
}

/// The digits that read back as the same float.
QString full(float value) {
    return std::isfinite(value) ? QString::fromStdString(shortest_text(value)) : short_number(value);
}

template <class Print>
QString joined(const std::vector<float>& values, int max_count, Print print) {
    QStringList parts;
    for (std::size_t i = 0; i < values.size() && int(i) < max_count; ++i) parts << print(values[i]);
    QString result = parts.join(QLatin1Char(' '));
    if (int(values.size()) > max_count) result += QStringLiteral(" …");
    return result;
}

QPixmap swatch(const std::vector<float>& values) {
    const auto component = [&](std::size_t c) {
        const float v = values[c];
        return std::isfinite(v) ? int(srgb_from_linear(std::clamp(v, 0.0f, 1.0f)) * 255 + 0.5f) : 0;
    };
    QPixmap picture(10, 10);
    picture.fill(QColor(component(0), component(1), component(2)));
    return picture;
}

QVariant value_colour(const std::vector<float>& values) {
    if (std::any_of(values.begin(), values.end(), [](float v) { return std::isnan(v); }))
        return theme_colours().nan;
    if (std::any_of(values.begin(), values.end(), [](float v) { return std::isinf(v); }))
        return theme_colours().infinite;
    return {};
}

QString quoted(const QString& cell, QChar separator) {
    if (!cell.contains(separator) && !cell.contains(QLatin1Char('"')) && !cell.contains(QLatin1Char('\n')))
        return cell;
    return QLatin1Char('"') + QString(cell).replace(QLatin1Char('"'), QStringLiteral("\"\"")) +
           QLatin1Char('"');
}

void paint_mark(QPainter& painter, const QRectF& box, int number) {
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(Qt::NoPen);
    painter.setBrush(pin_colour(number));
    painter.drawEllipse(box.adjusted(0.5, 0.5, -0.5, -0.5));
    QFont font = painter.font();
    font.setBold(true);
    font.setPixelSize(int(box.height() * (number < 9 ? 0.72 : 0.56)));
    painter.setFont(font);
    painter.setPen(QColor(20, 20, 20));
    painter.drawText(box, Qt::AlignCenter, QString::number(number + 1));
}

}  // namespace

QColor pin_colour(int number) {
    // Okabe and Ito's palette for all kinds of colour vision, without black.
    static const QColor colours[] = {{230, 159, 0},   {86, 180, 233}, {0, 158, 115},  {240, 228, 66},
                                     {204, 121, 167}, {213, 94, 0},   {120, 140, 255}};
    return colours[std::size_t(number) % std::size(colours)];
}

QIcon pin_icon(int number) {
    QIcon icon;
    for (const int scale : {1, 2, 3}) {
        QPixmap picture(14 * scale, 14 * scale);
        picture.fill(Qt::transparent);
        QPainter painter(&picture);
        paint_mark(painter, QRectF(QPointF(), picture.size()), number);
        painter.end();
        picture.setDevicePixelRatio(scale);
        icon.addPixmap(picture);
    }
    return icon;
}

std::optional<QPoint> InspectorModel::place_of(int column) const {
    if (column == cursor_column) return readings_.cursor;
    const auto pin = std::size_t(column - first_pin_column);
    return column >= first_pin_column && pin < pins_.size() ? std::optional(pins_[pin]) : std::nullopt;
}

int InspectorModel::pixel_of(int column) const {
    const auto place = place_of(column);
    if (!place) return -1;
    const auto found = std::find(readings_.pixels.begin(), readings_.pixels.end(), *place);
    return found == readings_.pixels.end() ? -1 : int(found - readings_.pixels.begin());
}

std::vector<float> InspectorModel::values(const Node& node, int column) const {
    const int pixel = pixel_of(column);
    if (pixel < 0) return {};
    const auto number = std::size_t(pixel);
    if (node.kind == Node::Kind::world) {
        if (number >= readings_.world.size()) return {};
        const auto& at = readings_.world[number];
        return {at[0], at[1], at[2]};
    }
    if (node.buffer < 0) return {};
    const Buffer& buffer = readings_.buffers[std::size_t(node.buffer)];
    if (!buffer.available || number >= buffer.values.size()) return {};
    const auto& all = buffer.values[number];
    if (node.channel < 0) return all;
    return std::size_t(node.channel) < all.size() ? std::vector{all[std::size_t(node.channel)]}
                                                  : std::vector<float>{};
}

/// What the numbers of a whole pixel are the name of; null: they are amounts.
const Category* InspectorModel::category(const Node& node, const std::vector<float>& numbers) const {
    if (node.kind != Node::Kind::buffer || numbers.empty()) return nullptr;
    return category_at(numbers.data(), int(numbers.size()),
                       readings_.buffers[std::size_t(node.buffer)].categories);
}

QString InspectorModel::value_text(const Node& node, int column) const {
    if (node.kind == Node::Kind::group) return {};
    const auto place = place_of(column);
    if (node.kind == Node::Kind::position)
        return place ? QStringLiteral("%1, %2").arg(place->x()).arg(place->y()) : QStringLiteral("–");
    if (node.kind == Node::Kind::buffer && !readings_.buffers[std::size_t(node.buffer)].available) {
        if (column != cursor_column) return {};
        return wanted_.contains(node.key) ? tr("being computed …") : tr("not computed");
    }
    const auto numbers = values(node, column);
    if (numbers.empty()) return QStringLiteral("–");
    if (node.kind == Node::Kind::world && std::isnan(numbers[0])) return tr("background");
    const Semantic semantic =
        node.buffer < 0 ? Semantic::position : readings_.buffers[std::size_t(node.buffer)].semantic;
    const auto text = joined(numbers, max_in_a_cell, [semantic](float v) { return number(v, semantic); });
    const auto* name = category(node, numbers);
    return name ? text + QLatin1Char(' ') + QString::fromStdString(name->label) : text;
}

QString InspectorModel::tooltip(const Node& node) const {
    if (node.kind == Node::Kind::position) return tr("Column and row, from the upper left corner");
    if (node.kind == Node::Kind::world) return tr("Where the surface lies, in metres");
    if (node.buffer < 0) return {};
    const Buffer& buffer = readings_.buffers[std::size_t(node.buffer)];
    QStringList lines{QStringLiteral("<b>%1</b>").arg(buffer.label.toHtmlEscaped())};
    if (!buffer.doc.isEmpty()) lines << buffer.doc.toHtmlEscaped();
    QString kind = QString::fromStdString(to_string(buffer.semantic));
    if (!buffer.unit.isEmpty()) kind += tr(", in %1").arg(buffer.unit);
    lines << kind.toHtmlEscaped()
          << QStringLiteral("<tt>%1</tt>").arg(QString::fromStdString(buffer.key).toHtmlEscaped());
    if (!buffer.available)
        lines << tr("Not computed, because nothing shows it. Click “not computed” to have it computed.");
    return (thumbnails_ ? picture_text(thumbnails_(buffer.key)) : QString()) +
           lines.join(QStringLiteral("<br>"));
}

QVariant InspectorModel::value_data(const Node& node, int column, int role) const {
    if (role == Qt::DisplayRole) return value_text(node, column);
    const auto numbers = values(node, column);
    if (role == full_role) {
        if (node.kind == Node::Kind::position) return value_text(node, column);
        return joined(numbers, int(numbers.size()), full);
    }
    const bool buffer_row = node.kind == Node::Kind::buffer;
    if (role == Qt::ToolTipRole) {
        if (numbers.empty()) return tooltip(node);
        const QString digits = joined(numbers, int(numbers.size()), full);
        const QString unit = node.kind == Node::Kind::world
                                 ? QStringLiteral("m")
                                 : readings_.buffers[std::size_t(node.buffer)].unit;
        return unit.isEmpty() ? digits : digits + QLatin1Char(' ') + unit;
    }
    if (role == Qt::DecorationRole && numbers.size() < 3) {
        const auto* name = category(node, numbers);
        return name ? QVariant(colour_of(*name)) : QVariant();
    }
    if (role == Qt::DecorationRole && buffer_row && numbers.size() >= 3 &&
        is_colour(readings_.buffers[std::size_t(node.buffer)].semantic))
        return swatch(numbers);
    if (role == Qt::ForegroundRole) {
        if (node.kind == Node::Kind::buffer && !readings_.buffers[std::size_t(node.buffer)].available)
            return wanted_.contains(node.key) ? theme_colours().dim
                                              : QGuiApplication::palette().color(QPalette::Link);
        if (node.kind == Node::Kind::position) return {};
        const bool nowhere = node.kind == Node::Kind::world && !numbers.empty() && std::isnan(numbers[0]);
        return numbers.empty() || nowhere ? QVariant(theme_colours().dim) : value_colour(numbers);
    }
    if (role == Qt::TextAlignmentRole) return int(Qt::AlignLeft | Qt::AlignVCenter);
    return {};
}

QVariant InspectorModel::name_data(const Node& node, int role) const {
    const Buffer* buffer = node.buffer < 0 ? nullptr : &readings_.buffers[std::size_t(node.buffer)];
    switch (role) {
        case Qt::DisplayRole:
            return node.name;
        case Qt::ToolTipRole:
            return tooltip(node);
        case Qt::FontRole: {
            if (node.kind != Node::Kind::group) return {};
            QFont font;
            font.setBold(true);
            return font;
        }
        case Qt::ForegroundRole:
            return (buffer && !buffer->available) || node.kind == Node::Kind::channel
                       ? QVariant(theme_colours().dim)
                       : QVariant();
        default:
            return {};
    }
}

QVariant InspectorModel::data(const QModelIndex& index, int role) const {
    if (!index.isValid()) return {};
    const Node& at = node(index);
    if (role == key_role) return at.key;
    const Buffer* buffer = at.buffer < 0 ? nullptr : &readings_.buffers[std::size_t(at.buffer)];
    if (role == buffer_role) return buffer ? QString::fromStdString(buffer->key) : QString();
    if (role == available_role) return !buffer || buffer->available;
    return index.column() == name_column ? name_data(at, role) : value_data(at, index.column(), role);
}

QVariant InspectorModel::headerData(int section, Qt::Orientation orientation, int role) const {
    if (orientation != Qt::Horizontal || section < 0 || section >= columnCount()) return {};
    const int pin = section - first_pin_column;
    if (pin < 0) {
        if (role != Qt::DisplayRole) return {};
        return section == name_column ? tr("Buffer") : tr("Cursor");
    }
    const QPoint at = pins_[std::size_t(pin)];
    if (role == Qt::DecorationRole) return pin_icon(pin);
    if (role == Qt::DisplayRole) return tr("Pin %1").arg(pin + 1);
    if (role == Qt::ToolTipRole)
        return tr("Pinned pixel %1, %2. Click for what can be done with it.").arg(at.x()).arg(at.y());
    return {};
}

QString InspectorModel::to_text(QChar separator) const {
    const auto line = [separator](QStringList cells) {
        for (QString& cell : cells) cell = quoted(cell, separator);
        return cells.join(separator) + QLatin1Char('\n');
    };
    const auto cells = [this](const Node& node, QStringList start) {
        for (int column = cursor_column; column < columnCount(); ++column)
            start << value_data(node, column, full_role).toString();
        return start;
    };
    QStringList header{tr("group"), tr("buffer"), tr("channel"), tr("unit"), tr("cursor")};
    for (std::size_t pin = 0; pin < pins_.size(); ++pin) header << tr("pin %1").arg(pin + 1);
    QString result = line(header);
    for (const Node& node : nodes_) {
        if (node.kind == Node::Kind::group) continue;
        if (node.buffer < 0) {
            const QString unit = node.kind == Node::Kind::world ? QStringLiteral("m") : QStringLiteral("px");
            result += line(cells(node, {QString(), node.key, QString(), unit}));
            continue;
        }
        const Buffer& buffer = readings_.buffers[std::size_t(node.buffer)];
        if (!buffer.available || !node.children.empty()) continue;  // its channels follow
        const QString group = buffer.output ? QStringLiteral("outputs") : buffer.group;
        const QString channel = node.channel < 0 ? channel_name(buffer.semantic, 1, 0) : node.name;
        result += line(cells(node, {group, QString::fromStdString(buffer.key), channel, buffer.unit}));
    }
    return result;
}

}  // namespace ir::widgets
