#pragma once

#include <QPoint>
#include <QWidget>
#include <optional>

#include "widgets/pipeline/pipeline_view.h"

class QCheckBox;
class QLabel;
class QStackedWidget;
class QToolButton;

namespace ir::widgets {

struct EmptyPage;
class RowsPanel;

/// What the panel shows, as plain data.
struct PipelineFields {
    Pipeline pipeline = {};
    PipelineView::Pictures pictures = {};
    std::string step = {};   ///< pass after which buffers are shown; empty: the whole frame
    std::string shown = {};  ///< key of the buffer that a view shows
    /// What the pass of the step has written, as label and key, where the view shows nothing of it.
    std::vector<std::pair<QString, QString>> written = {};
    std::optional<QPoint> traced = {};  ///< pixel whose changes are listed
    FrameReport changes = {};           ///< of the frame in which it was traced
    QString why_empty = {};             ///< not empty: there is no frame
};

/// A frame as a graph, a way through it pass by pass, and what passes did to one pixel.
class PipelinePanel : public QWidget {
    Q_OBJECT
  public:
    explicit PipelinePanel(QWidget* parent = nullptr);
    /// Emits nothing.
    void set_fields(const PipelineFields& fields);
    bool shows_skipped() const;
    void set_shows_skipped(bool on);
    PipelineView& view() { return *view_; }
    RowsPanel& changes() { return *changes_; }

  signals:
    void step_wanted(const QString& pass);  ///< empty: the whole frame
    void buffer_wanted(const QString& key);
    void trace_ended();
    void export_wanted();
    void skipped_chosen(bool on);

  private:
    QWidget* make_bar();
    QWidget* make_changes();
    /// Through passes that ran; before the first and after the last is the whole frame.
    void step(int passes);
    std::vector<std::string> passes() const;

    PipelineFields fields_;
    PipelineView* view_;
    RowsPanel* changes_;
    QLabel *where_ = nullptr, *written_ = nullptr, *pixel_ = nullptr, *empty_ = nullptr;
    QToolButton *back_ = nullptr, *forward_ = nullptr, *whole_ = nullptr, *fit_ = nullptr, *export_ = nullptr;
    QCheckBox* skipped_ = nullptr;
    QWidget* traced_ = nullptr;
    QStackedWidget* pages_;
};

}  // namespace ir::widgets
