#include "widgets/sweeps/contact_sheet.h"

#include <QAbstractItemDelegate>
#include <QAbstractProxyModel>
#include <QApplication>
#include <QItemSelection>
#include <QKeyEvent>
#include <QPainter>
#include <QScrollBar>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>
#include <utility>

#include "widgets/style/icons.h"

namespace ir::widgets {
namespace {

constexpr int cell_margin = 5, cell_gap = 3, text_lines = 2;
constexpr double closest = 1.0 / 64;  ///< of a picture's side

class Cells : public QAbstractItemDelegate {
  public:
    explicit Cells(ContactSheet* sheet) : QAbstractItemDelegate(sheet), sheet_(*sheet) {}
    void paint(QPainter* painter, const QStyleOptionViewItem& option,
               const QModelIndex& index) const override {
        sheet_.paint_cell(*painter, option, index);
    }
    QSize sizeHint(const QStyleOptionViewItem&, const QModelIndex&) const override {
        return sheet_.gridSize();
    }

  private:
    const ContactSheet& sheet_;
};

/// As large as it can be in the box, in its middle.
QRectF fitted(const QRectF& box, double aspect) {
    const double height = std::min(box.height(), box.width() * aspect), width = height / aspect;
    return {box.center().x() - width / 2, box.center().y() - height / 2, width, height};
}

}  // namespace

ContactSheet::ContactSheet(const SweepModel& model, QWidget* parent) : QListView(parent), model_(model) {
    setObjectName(QStringLiteral("sheet"));
    setAccessibleName(tr("Contact sheet"));
    setAccessibleDescription(
        tr("Arrows walk, Enter loads a variation's setting, plus and minus zoom all "
           "pictures, 0 shows all of them"));
    setViewMode(IconMode);
    setMovement(Static);
    setResizeMode(Adjust);
    setUniformItemSizes(true);
    setVerticalScrollMode(ScrollPerPixel);
    setSelectionMode(ExtendedSelection);
    setEditTriggers(NoEditTriggers);
    setFrameShape(NoFrame);
    setBackgroundRole(QPalette::Base);
    setAutoFillBackground(true);
    setItemDelegate(new Cells(this));
    connect(&pictures_, &SheetPictures::arrived, this, [this] {
        ask_for_seen();
        viewport()->update();
    });
    fit_grid();
}

void ContactSheet::set_shows(Shows shows) {
    shows_ = shows;
    fit_grid();
}

void ContactSheet::set_picture_width(int width) {
    width_ = std::clamp(width, min_width, max_width);
    fit_grid();
}

void ContactSheet::set_told_column(int column) {
    told_ = column;
    viewport()->update();
}

void ContactSheet::fit_grid() {
    const int pictures = shows_ == Shows::both ? 2 : 1;
    const QSize size(pictures * width_ + (pictures - 1) * cell_gap + 2 * cell_margin,
                     int(std::lround(width_ * aspect_)) + text_lines * fontMetrics().lineSpacing() +
                         2 * cell_margin + cell_gap);
    if (size != gridSize()) setGridSize(size);
    scheduleDelayedItemsLayout();
    viewport()->update();
}

/// How many of the cells that have room beside each other stand there; 0: all.
int ContactSheet::columns(int room) const {
    const int axes = model_.rows().axes, count = model() ? model()->rowCount() : 0;
    if (axes < 2) return 0;
    const auto are_beside = [&](int a, int b) {
        const auto &of_a = line(model()->index(a, 0)).cells, &of_b = line(model()->index(b, 0)).cells;
        return std::equal(of_a.begin(), of_a.begin() + axes - 1, of_b.begin());
    };
    int values = 1;  // of the last axis
    while (values < count && are_beside(0, values)) ++values;
    if (values < 2 || values >= room || count % values) return 0;
    const auto value = [&](int row) { return line(model()->index(row, 0)).cells[std::size_t(axes) - 1]; };
    for (int row = 0; row < count; ++row)
        if (!are_beside(row - row % values, row) || !(value(row % values) == value(row))) return 0;
    const bool is_all_seen = count / values * gridSize().height() <= viewport()->height();
    return is_all_seen ? values : room / values * values;
}

void ContactSheet::doItemsLayout() {
    const int width = this->width() - 2 * frameWidth() - verticalScrollBar()->sizeHint().width();
    const int cell = gridSize().width(), used = columns(width / cell);
    const int margin = used > 0 ? std::max(0, width - used * cell - cell / 2) : 0;
    if (margin != viewportMargins().right()) setViewportMargins(0, 0, margin, 0);
    QListView::doItemsLayout();
}

const SweepLine& ContactSheet::line(const QModelIndex& index) const {
    return model_.line(static_cast<const QAbstractProxyModel*>(model())->mapToSource(index).row());
}

std::vector<SheetRequest> ContactSheet::requests(const SweepLine& line) const {
    if (line.picture.isEmpty()) return {};
    std::vector<SheetRequest> wanted;
    if (shows_ != Shows::differences) wanted.push_back({line.picture, {}, line.version});
    if (shows_ != Shows::pictures && !line.reference.isEmpty())
        wanted.push_back({line.picture, line.reference, line.version});
    return wanted;
}

std::pair<int, int> ContactSheet::seen_rows() const {
    const int count = model() ? model()->rowCount() : 0;
    const auto box = [this](int row) { return visualRect(model()->index(row, modelColumn())); };
    // Rows stand in the order of their places: the first that ends below the upper edge.
    int low = 0, high = count;
    while (low < high) {
        const int middle = (low + high) / 2;
        box(middle).bottom() < 0 ? low = middle + 1 : high = middle;
    }
    int end = low;
    while (end < count && box(end).top() < viewport()->height()) ++end;
    return {low, end};
}

void ContactSheet::ask_for_seen() {
    if (!model() || !isVisible()) return;
    const auto [first, end] = seen_rows();
    std::vector<SheetRequest> wanted;
    for (int row = first; row < end; ++row)
        for (auto& each : requests(line(model()->index(row, modelColumn()))))
            wanted.push_back(std::move(each));
    // Cells have the shape of the first picture.
    for (const auto& each : wanted)
        if (const auto* picture = pictures_.find(each)) {
            const double aspect = std::clamp(double(picture->height()) / picture->width(), 0.25, 2.0);
            if (std::abs(aspect - std::exchange(aspect_, aspect)) > 0.01) fit_grid();
            break;
        }
    pictures_.want(std::move(wanted));
}

void ContactSheet::paintEvent(QPaintEvent* event) {
    ask_for_seen();
    QListView::paintEvent(event);
}

void ContactSheet::resizeEvent(QResizeEvent* event) {
    QListView::resizeEvent(event);
    fit_grid();
}

std::pair<QRect, QRect> ContactSheet::boxes(const QModelIndex& index) const {
    const QRect cell(visualRect(index).topLeft(), gridSize());
    const QRect first(cell.left() + cell_margin, cell.top() + cell_margin, width_,
                      int(std::lround(width_ * aspect_)));
    return {first, shows_ == Shows::both ? first.translated(width_ + cell_gap, 0) : QRect()};
}

void ContactSheet::paint_cell(QPainter& painter, const QStyleOptionViewItem& option,
                              const QModelIndex& index) const {
    const auto& shown = line(index);
    const QRect cell(option.rect.topLeft(), gridSize());
    painter.save();
    painter.setClipRect(cell);
    const bool is_selected = option.state & QStyle::State_Selected;
    if (is_selected) painter.fillRect(cell.adjusted(1, 1, -1, -1), palette().color(QPalette::Highlight));
    if (currentIndex().row() == index.row() && hasFocus()) {
        painter.setPen(QPen(palette().color(QPalette::Text), 1));
        painter.drawRect(cell.adjusted(1, 1, -2, -2));
    }
    const auto [first, second] = boxes(index);
    const auto wanted = requests(shown);
    const auto draw = [&](const QRect& box, const SheetRequest* request, const QString& otherwise) {
        painter.fillRect(box, palette().color(QPalette::Window));
        if (const auto* picture = request ? pictures_.find(*request) : nullptr) {
            const QRectF source(part_.x() * picture->width(), part_.y() * picture->height(),
                                part_.width() * picture->width(), part_.height() * picture->height());
            const QRectF target = fitted(box, double(picture->height()) / picture->width());
            painter.setRenderHint(QPainter::SmoothPixmapTransform, source.width() > target.width());
            return painter.drawImage(target, *picture, source);
        }
        const auto problem = request ? pictures_.problem(*request) : otherwise;
        painter.setPen(palette().color(QPalette::PlaceholderText));
        painter.drawText(box.adjusted(4, 4, -4, -4), Qt::AlignCenter | Qt::TextWordWrap,
                         request && problem.isEmpty() ? tr("Reading …") : problem);
    };
    const auto none = !shown.problem.isEmpty() ? shown.problem
                      : shown.state == SweepLine::State::done || shown.state == SweepLine::State::stale
                          ? tr("no picture was kept")
                          : state_text(shown.state);
    const auto no_reference = shown.picture.isEmpty() ? none : tr("no reference");
    const bool has_difference = !wanted.empty() && !wanted.back().reference.isEmpty();
    if (shows_ != Shows::differences) draw(first, wanted.empty() ? nullptr : &wanted.front(), none);
    if (shows_ != Shows::pictures)
        draw(shows_ == Shows::both ? second : first, has_difference ? &wanted.back() : nullptr, no_reference);

    const int line_height = fontMetrics().lineSpacing();
    QRect text(cell.left() + cell_margin, first.bottom() + 1 + cell_gap, cell.width() - 2 * cell_margin,
               line_height);
    painter.setPen(palette().color(is_selected ? QPalette::HighlightedText : QPalette::Text));
    // Of a long name the values alone.
    auto caption = shown.name;
    if (fontMetrics().horizontalAdvance(caption) > text.width()) {
        QStringList values;
        for (int i = 0; i < model_.rows().axes && i < int(shown.cells.size()); ++i)
            values << shown.cells[std::size_t(i)].text;
        caption = values.join(QStringLiteral(" · "));
    }
    painter.drawText(text, Qt::AlignLeft, fontMetrics().elidedText(caption, Qt::ElideMiddle, text.width()));
    text.translate(0, line_height);
    if (shown.state == SweepLine::State::stale || shown.state == SweepLine::State::failed ||
        shown.state == SweepLine::State::running) {
        const auto mark = index.data(Qt::DecorationRole).value<QIcon>();
        mark.paint(&painter, QRect(text.left(), text.top(), line_height, line_height));
        text.setLeft(text.left() + line_height + cell_gap);
    }
    if (told_ <= 0) return painter.restore();
    const auto told = index.siblingAtColumn(told_);
    const auto heading = model()->headerData(told_, Qt::Horizontal).toString();
    const auto value = told.data().toString();
    if (!is_selected) painter.setPen(palette().color(QPalette::PlaceholderText));
    if (!value.isEmpty())
        painter.drawText(
            text, Qt::AlignLeft,
            fontMetrics().elidedText(heading + QLatin1Char(' ') + value, Qt::ElideRight, text.width()));
    painter.restore();
}

void ContactSheet::set_part(QRectF part) {
    const double side = std::clamp(part.width(), closest, 1.0);
    part.setSize({side, side});
    part.moveLeft(std::clamp(part.left(), 0.0, 1 - side));
    part.moveTop(std::clamp(part.top(), 0.0, 1 - side));
    if (part == part_) return;
    part_ = part;
    viewport()->update();
}

void ContactSheet::zoom(double factor, QPointF about) {
    const double side = std::clamp(part_.width() / factor, closest, 1.0);
    const QPointF place = part_.topLeft() + about * part_.width();
    set_part(QRectF(place - about * side, QSizeF(side, side)));
}

void ContactSheet::show_all() {
    set_part({0, 0, 1, 1});
}

QPointF ContactSheet::place_in_picture(QPoint at) const {
    const auto index = indexAt(at);
    if (!index.isValid()) return {0.5, 0.5};
    const auto [first, second] = boxes(index);
    const QRectF box = second.contains(at) ? second : first;
    return {std::clamp((at.x() - box.left()) / box.width(), 0.0, 1.0),
            std::clamp((at.y() - box.top()) / box.height(), 0.0, 1.0)};
}

void ContactSheet::wheelEvent(QWheelEvent* event) {
    if (!(event->modifiers() & Qt::ControlModifier)) return QListView::wheelEvent(event);
    zoom(std::exp2(event->angleDelta().y() / 240.0), place_in_picture(event->position().toPoint()));
    event->accept();
}

void ContactSheet::select(const QModelIndex& index, Qt::KeyboardModifiers modifiers) {
    using S = QItemSelectionModel;
    if (modifiers & Qt::ControlModifier) return selectionModel()->setCurrentIndex(index, S::Toggle | S::Rows);
    if (!(modifiers & Qt::ShiftModifier) || !currentIndex().isValid())
        return selectionModel()->setCurrentIndex(index, S::ClearAndSelect | S::Rows);
    const auto from = currentIndex().siblingAtColumn(modelColumn());
    const auto [low, high] = std::minmax({from.row(), index.row()});
    selectionModel()->select(QItemSelection(from.siblingAtRow(low), from.siblingAtRow(high)),
                             S::ClearAndSelect | S::Rows);
}

void ContactSheet::mousePressEvent(QMouseEvent* event) {
    const auto under = indexAt(event->position().toPoint());
    if (event->button() == Qt::RightButton && under.isValid()) {  // the menu is about what lies there
        if (selectionModel()->isSelected(under))
            selectionModel()->setCurrentIndex(under, QItemSelectionModel::NoUpdate);
        else
            select(under, {});
    }
    if (event->button() != Qt::LeftButton && event->button() != Qt::MiddleButton) return event->ignore();
    pressed_ = dragged_ = event->position().toPoint();
    is_pressed_ = true;
    is_dragging_ = event->button() == Qt::MiddleButton;
}

void ContactSheet::mouseMoveEvent(QMouseEvent* event) {
    if (!is_pressed_) return;
    const auto at = event->position().toPoint();
    is_dragging_ |= (at - pressed_).manhattanLength() >= QApplication::startDragDistance();
    if (!is_dragging_) return;
    const QPointF moved(QPointF(at - dragged_) / width_);
    dragged_ = at;
    set_part(part_.translated(-moved.x() * part_.width(), -moved.y() / aspect_ * part_.height()));
}

void ContactSheet::mouseReleaseEvent(QMouseEvent* event) {
    if (!std::exchange(is_pressed_, false) || std::exchange(is_dragging_, false)) return;
    const auto index = indexAt(event->position().toPoint());
    if (!index.isValid()) return;
    const auto id = line(index).id;
    select(index, event->modifiers());
    if (!(event->modifiers() & (Qt::ControlModifier | Qt::ShiftModifier))) emit variation_chosen(id);
}

/// Keys of the sheet that are the window's, too.
bool ContactSheet::event(QEvent* event) {
    if (event->type() == QEvent::Wheel) {  // beside the cells of a grid, too
        wheelEvent(static_cast<QWheelEvent*>(event));
        return true;
    }
    if (event->type() == QEvent::ShortcutOverride) {
        const int key = static_cast<QKeyEvent*>(event)->key();
        if (key == Qt::Key_Plus || key == Qt::Key_Equal || key == Qt::Key_Minus || key == Qt::Key_0) {
            event->accept();
            return true;
        }
    }
    return QListView::event(event);
}

void ContactSheet::keyPressEvent(QKeyEvent* event) {
    switch (event->key()) {
        case Qt::Key_Plus:
        case Qt::Key_Equal:
            return zoom(std::sqrt(2.0));
        case Qt::Key_Minus:
            return zoom(std::sqrt(0.5));
        case Qt::Key_0:
            return show_all();
        case Qt::Key_Return:
        case Qt::Key_Enter:
            if (currentIndex().isValid()) emit variation_chosen(line(currentIndex()).id);
            return;
        default:
            QListView::keyPressEvent(event);
    }
}

}  // namespace ir::widgets
