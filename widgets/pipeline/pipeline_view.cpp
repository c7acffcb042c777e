#include "widgets/pipeline/pipeline_view.h"

#include <QApplication>
#include <QContextMenuEvent>
#include <QGraphicsItem>
#include <QHelpEvent>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QPainterPath>
#include <QScrollBar>
#include <QStyleOptionGraphicsItem>
#include <QToolTip>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>
#include <utility>

#include "renderers/core/error.h"
#include "widgets/plot/plot_painter.h"
#include "widgets/style/theme.h"

namespace ir::widgets {
namespace {

constexpr double edge_room = 12, least_scale = 0.1, most_scale = 4, wheel_factor = 1.2, least_legible = 0.7;

class PaintedPipeline : public QGraphicsItem {
  public:
    explicit PaintedPipeline(const PipelineView& view) : view_(view) {}
    void set_size(const QSizeF& size) {
        prepareGeometryChange();
        size_ = size;
    }
    QRectF boundingRect() const override {
        return QRectF(QPointF(), size_).adjusted(-edge_room, -edge_room, edge_room, edge_room);
    }
    void paint(QPainter* painter, const QStyleOptionGraphicsItem* option, QWidget*) override {
        view_.paint_pipeline(*painter, option->exposedRect);
    }

  private:
    const PipelineView& view_;
    QSizeF size_;
};

QRectF rect_of(const PlacedPipeline::Box& box) {
    return {box.x, box.y, box.width, box.height};
}

QPointF point_of(const PlacedPipeline::Point& point) {
    return {point.x, point.y};
}

}  // namespace

PipelineView::PipelineView(QWidget* parent) : QGraphicsView(parent), style_(&window_style()) {
    setScene(new QGraphicsScene(this));
    auto* item = new PaintedPipeline(*this);
    painted_ = item;
    scene()->addItem(item);
    setFrameShape(NoFrame);
    follow_theme(this, [this] {
        style_ = &window_style();
        setBackgroundBrush(colour_of(style_->background));
    });
    setAlignment(Qt::AlignHCenter | Qt::AlignTop);
    setTransformationAnchor(AnchorUnderMouse);
    setMouseTracking(true);
    viewport()->setMouseTracking(true);
    setFocusPolicy(Qt::StrongFocus);
    setMinimumSize(160, 120);
    setAccessibleName(tr("Passes and buffers of the frame"));
    setAccessibleDescription(tr("Up and down step through the passes, plus and minus zoom, 0 shows all"));
}

void PipelineView::set_pipeline(const Pipeline& pipeline, const Pictures& pictures) {
    pictures_ = pictures;
    const bool is_known = has_same_shape(pipeline, wanted_);
    if (!is_known) problem_.clear();
    wanted_ = pipeline;
    if (has_same_shape(pipeline, shown_)) {
        shown_ = pipeline;
        return painted_->update();
    }
    // Each frame asks: what cannot be laid out is not tried, nor told, again.
    if (!is_known || (!job_.is_running() && problem_.isEmpty())) place();
}

void PipelineView::place() {
    job_.start([this, pipeline = wanted_](const std::atomic<bool>&) -> std::function<void()> {
        try {
            auto placed = place_pipeline(pipeline, true);
            return [this, pipeline, placed = std::move(placed)]() mutable {
                show_placed(pipeline, std::move(placed));
            };
        } catch (const Error& error) {
            return [this, pipeline, text = QString::fromUtf8(error.what())] { tell_problem(pipeline, text); };
        }
    });
}

void PipelineView::show_placed(const Pipeline& pipeline, PlacedPipeline placed) {
    if (has_same_shape(shown_, wanted_)) return;  // what was asked for meanwhile is what is shown
    const bool is_first = shown_.nodes.empty();
    placed_ = std::move(placed);
    shown_ = has_same_shape(pipeline, wanted_) ? wanted_ : pipeline;
    auto* item = static_cast<PaintedPipeline*>(painted_);
    item->set_size({placed_.width, placed_.height});
    scene()->setSceneRect(item->boundingRect());
    item->update();
    if (is_first && !shown_.nodes.empty()) begin();
}

void PipelineView::begin() {
    const double scale = std::clamp(viewport()->width() / scene()->sceneRect().width(), least_legible, 1.0);
    setTransform(QTransform::fromScale(scale, scale));
    verticalScrollBar()->setValue(verticalScrollBar()->minimum());
}

void PipelineView::tell_problem(const Pipeline& pipeline, const QString& problem) {
    if (!has_same_shape(pipeline, wanted_)) return;  // it is not asked for any more
    problem_ = problem;
    emit failed(problem);
}

void PipelineView::set_marked(const QString& pass, const QString& buffer) {
    if (pass_ == pass && buffer_ == buffer) return;
    const bool is_other_pass = std::exchange(pass_, pass) != pass;
    buffer_ = buffer;
    painted_->update();
    if (is_other_pass && !pass.isEmpty()) scroll_to(pass);
}

PipelineView::Found PipelineView::row_at(const QPointF& place) const {
    for (std::size_t n = 0; n < placed_.rows.size(); ++n)
        for (std::size_t r = 0; r < placed_.rows[n].size(); ++r)
            if (rect_of(placed_.rows[n][r]).contains(place))
                return {&shown_.nodes[n], &shown_.nodes[n].rows[r], placed_.rows[n][r]};
    return {};
}

PipelineView::Found PipelineView::row_of(const QString& key) const {
    const auto wanted = key.toStdString();
    for (std::size_t n = 0; n < placed_.rows.size(); ++n)
        for (std::size_t r = 0; r < placed_.rows[n].size(); ++r)
            if (shown_.nodes[n].rows[r].key == wanted)
                return {&shown_.nodes[n], &shown_.nodes[n].rows[r], placed_.rows[n][r]};
    return {};
}

QRect PipelineView::place_of(const QString& key) const {
    const auto found = row_of(key);
    return found.row ? mapFromScene(rect_of(found.box)).boundingRect() : QRect();
}

void PipelineView::scroll_to(const QString& key) {
    if (const auto found = row_of(key); found.row)
        ensureVisible(rect_of(found.box), 30, viewport()->height() / 4);
}

void PipelineView::fit() {
    const auto all = scene()->sceneRect();
    if (all.isEmpty()) return;
    const double scale =
        std::min({1.0, viewport()->width() / all.width(), viewport()->height() / all.height()});
    setTransform(QTransform::fromScale(std::max(least_scale, scale), std::max(least_scale, scale)));
}

void PipelineView::zoom(double factor) {
    const double scale = std::clamp(transform().m11() * factor, least_scale, most_scale);
    setTransform(QTransform::fromScale(scale, scale));
}

void PipelineView::mousePressEvent(QMouseEvent* event) {
    if (event->button() != Qt::LeftButton && event->button() != Qt::MiddleButton) return event->ignore();
    pressed_ = dragged_ = event->pos();
    is_dragging_ = false;
}

void PipelineView::mouseMoveEvent(QMouseEvent* event) {
    if (event->buttons() & (Qt::LeftButton | Qt::MiddleButton)) {
        is_dragging_ |= (event->pos() - pressed_).manhattanLength() >= QApplication::startDragDistance();
        if (!is_dragging_) return;
        const auto way = event->pos() - std::exchange(dragged_, event->pos());
        horizontalScrollBar()->setValue(horizontalScrollBar()->value() - way.x());
        verticalScrollBar()->setValue(verticalScrollBar()->value() - way.y());
        return;
    }
    viewport()->setCursor(row_at(mapToScene(event->pos())).row ? Qt::PointingHandCursor : Qt::ArrowCursor);
}

void PipelineView::mouseReleaseEvent(QMouseEvent* event) {
    if (event->button() != Qt::LeftButton || std::exchange(is_dragging_, false)) return;
    const auto found = row_at(mapToScene(event->pos()));
    if (!found.row) return;
    const auto key = QString::fromStdString(found.row->key);  // answers may change what is shown
    if (!found.node->is_pass) return emit buffer_clicked(key);
    found.row->skipped ? emit skipped_clicked() : emit pass_clicked(key);
}

void PipelineView::wheelEvent(QWheelEvent* event) {
    if (!(event->modifiers() & Qt::ControlModifier)) return QGraphicsView::wheelEvent(event);
    zoom(event->angleDelta().y() > 0 ? wheel_factor : 1 / wheel_factor);
    event->accept();
}

void PipelineView::keyPressEvent(QKeyEvent* event) {
    switch (event->key()) {
        case Qt::Key_Up:
            return emit step_wanted(-1);
        case Qt::Key_Down:
            return emit step_wanted(1);
        case Qt::Key_Plus:
            return zoom(wheel_factor);
        case Qt::Key_Minus:
            return zoom(1 / wheel_factor);
        case Qt::Key_0:
            return fit();
        default:
            QGraphicsView::keyPressEvent(event);
    }
}

void PipelineView::contextMenuEvent(QContextMenuEvent* event) {
    const bool is_mouse = event->reason() == QContextMenuEvent::Mouse;
    const auto found = is_mouse          ? row_at(mapToScene(event->pos()))
                       : pass_.isEmpty() ? row_of(buffer_)
                                         : row_of(pass_);
    if (!found.row) return;
    const auto key = QString::fromStdString(found.row->key);
    const QPoint place = is_mouse ? event->globalPos() : viewport()->mapToGlobal(place_of(key).center());
    found.node->is_pass ? emit pass_menu_wanted(key, place) : emit buffer_menu_wanted(key, place);
}

bool PipelineView::viewportEvent(QEvent* event) {
    if (event->type() != QEvent::ToolTip) return QGraphicsView::viewportEvent(event);
    const auto* help = static_cast<QHelpEvent*>(event);
    const auto found = row_at(mapToScene(help->pos()));
    if (found.row)
        QToolTip::showText(help->globalPos(), QString::fromStdString(found.row->doc), this);
    else
        QToolTip::hideText();
    return true;
}

void PipelineView::paint_pipeline(QPainter& painter, const QRectF& exposed) const {
    painter.setRenderHints(QPainter::Antialiasing | QPainter::TextAntialiasing |
                           QPainter::SmoothPixmapTransform);
    auto font = painter.font();
    font.setPixelSize(int(PlacedPipeline::font));
    painter.setFont(font);
    for (std::size_t i = 0; i < placed_.lines.size(); ++i) paint_line(painter, i);
    bool is_later = false;  // passes stand first, in their order
    for (std::size_t n = 0; n < placed_.boxes.size(); ++n) {
        const auto& node = shown_.nodes[n];
        const bool is_after = node.is_pass && is_later;
        if (node.is_pass && node.rows.front().key == pass_.toStdString()) is_later = true;
        const auto box = rect_of(placed_.boxes[n]);
        if (!box.intersects(exposed)) continue;
        for (std::size_t r = 0; r < node.rows.size(); ++r)
            paint_row(painter, node, node.rows[r], placed_.rows[n][r], is_after);
        painter.setPen(
            QPen(colour_of(node.rows.front().skipped || is_after ? style_->grid : style_->dim), 1));
        painter.setBrush(Qt::NoBrush);
        const double radius = node.is_pass ? PlacedPipeline::padding : 0;
        painter.drawRoundedRect(box, radius, radius);
    }
    painter.setPen(QPen(colour_of(style_->selection), 2));
    painter.setBrush(Qt::NoBrush);
    for (const auto& key : {pass_, buffer_})
        if (const auto found = row_of(key); found.row) painter.drawRect(rect_of(found.box));
}

void PipelineView::paint_line(QPainter& painter, std::size_t i) const {
    const auto& line = placed_.lines[i];
    const auto& edge = shown_.edges[i];
    if (line.points.size() < 4) return;
    QPainterPath path(point_of(line.points.front()));
    for (std::size_t k = 1; k + 2 < line.points.size(); k += 3)
        path.cubicTo(point_of(line.points[k]), point_of(line.points[k + 1]), point_of(line.points[k + 2]));
    const auto colour = colour_of(edge.skipped ? style_->grid : style_->dim);
    QPen pen(colour, 1);
    if (edge.kind == Pipeline::Edge::Kind::remembers) pen.setDashPattern({4, 3});
    painter.setPen(pen);
    painter.setBrush(Qt::NoBrush);
    painter.drawPath(path);
    const auto end = point_of(line.points.back()), tip = point_of(line.tip);
    const auto way = tip - end;
    const double length = std::hypot(way.x(), way.y());
    if (length < 0.1) return;
    const QPointF across(-way.y() * 3 / length, way.x() * 3 / length);
    painter.setPen(Qt::NoPen);
    painter.setBrush(colour);
    painter.drawPolygon(QPolygonF({tip, end + across, end - across}));
}

void PipelineView::paint_row(QPainter& painter, const Pipeline::Node& node, const Pipeline::Row& row,
                             const PlacedPipeline::Box& box, bool is_later) const {
    const auto place = rect_of(box);
    const bool is_dim = row.skipped || is_later;
    painter.setPen(Qt::NoPen);
    painter.setBrush(colour_of(is_dim ? style_->background : heat_colour(*style_, node.is_pass, row.heat)));
    const double radius = node.is_pass ? PlacedPipeline::padding : 0;
    painter.drawRoundedRect(place, radius, radius);
    auto text = place.adjusted(PlacedPipeline::padding, 0, -PlacedPipeline::padding, 0);
    if (row.pictured) {
        const QRectF frame(text.left(), place.center().y() - PlacedPipeline::picture_height / 2,
                           PlacedPipeline::picture_width, PlacedPipeline::picture_height);
        text.setLeft(frame.right() + 4);
        if (const auto found = pictures_.find(row.key); found != pictures_.end() && !found->second.isNull()) {
            const auto size = QSizeF(found->second.size()).scaled(frame.size(), Qt::KeepAspectRatio);
            painter.drawImage(QRectF(frame.center() - QPointF(size.width(), size.height()) / 2, size),
                              found->second);
        }
    }
    painter.setPen(colour_of(is_dim ? mixed(style_->background, style_->dim, 0.7) : style_->text));
    painter.drawText(text, Qt::AlignLeft | Qt::AlignVCenter, QString::fromStdString(row.text));
    painter.drawText(text, Qt::AlignRight | Qt::AlignVCenter, QString::fromStdString(row.measured));
}

}  // namespace ir::widgets
