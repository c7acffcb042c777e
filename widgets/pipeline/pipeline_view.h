#pragma once

#include <QGraphicsView>
#include <QImage>
#include <map>
#include <string>

#include "renderers/plot/placed_pipeline.h"
#include "widgets/models/newest_job.h"

namespace ir::widgets {

/// A frame as a graph: passes by time, buffers by memory, each to be clicked. It is laid out away from the
/// window's thread.
class PipelineView : public QGraphicsView {
    Q_OBJECT
  public:
    using Pictures = std::map<std::string, QImage>;

    explicit PipelineView(QWidget* parent = nullptr);
    /// Pictures by the keys of buffers. What has the shape of what is shown is drawn at once in its places.
    void set_pipeline(const Pipeline& pipeline, const Pictures& pictures);
    /// The pass after which buffers are shown (empty: the whole frame), and the buffer that a view shows.
    void set_marked(const QString& pass, const QString& buffer);
    bool is_placing() const { return job_.is_running(); }
    /// Why what was asked for last cannot be laid out; empty: it can, or nobody knows yet.
    const QString& problem() const { return problem_; }
    /// Where a pass or buffer is drawn, in the viewport's coordinates; empty: nowhere.
    QRect place_of(const QString& key) const;
    void scroll_to(const QString& key);

    /// Painted by the scene's item.
    void paint_pipeline(QPainter& painter, const QRectF& exposed) const;

  public slots:
    /// All of it, but not larger than in files.
    void fit();
    void zoom(double factor);

  signals:
    void pass_clicked(const QString& name);
    void skipped_clicked();  ///< a pass that did not run, or the mark of some
    void buffer_clicked(const QString& key);
    /// Of what is under the cursor, or by a key of the pass that is marked, else of the buffer.
    void pass_menu_wanted(const QString& name, QPoint global_position);
    void buffer_menu_wanted(const QString& key, QPoint global_position);
    /// Up, down: to the pass before, to the next one.
    void step_wanted(int passes);
    void failed(const QString& error);

  protected:
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void wheelEvent(QWheelEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    void contextMenuEvent(QContextMenuEvent* event) override;
    bool viewportEvent(QEvent* event) override;

  private:
    struct Found {
        const Pipeline::Node* node = nullptr;
        const Pipeline::Row* row = nullptr;
        PlacedPipeline::Box box;
    };
    Found row_at(const QPointF& place) const;
    Found row_of(const QString& key) const;
    void place();
    void show_placed(const Pipeline& pipeline, PlacedPipeline placed);
    /// At the top, as wide as there is room for as long as texts can be read.
    void begin();
    void tell_problem(const Pipeline& pipeline, const QString& problem);
    void paint_line(QPainter& painter, std::size_t edge) const;
    void paint_row(QPainter& painter, const Pipeline::Node& node, const Pipeline::Row& row,
                   const PlacedPipeline::Box& box, bool is_later) const;

    const PlotStyle* style_;
    Pipeline wanted_, shown_;
    PlacedPipeline placed_;
    Pictures pictures_;
    QString pass_, buffer_, problem_;
    QGraphicsItem* painted_ = nullptr;
    QPoint pressed_, dragged_;
    bool is_dragging_ = false;
    NewestJob job_;  // last member: its thread uses nothing of this, its answers do
};

}  // namespace ir::widgets
