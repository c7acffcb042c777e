#include "widgets/pipeline/pipeline_panel.h"

#include <QCheckBox>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QPainter>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSplitter>
#include <QStackedWidget>
#include <QToolButton>
#include <QTreeView>
#include <QVBoxLayout>
#include <algorithm>

#include "widgets/panels/controls.h"
#include "widgets/panels/rows_panel.h"
#include "widgets/pipeline/pixel_changes.h"
#include "widgets/plot/plot_painter.h"
#include "widgets/style/theme.h"

namespace ir::widgets {
namespace {

/// What the colours of passes and of buffers mean.
class HeatLegend : public QWidget {
  public:
    HeatLegend() : style_(&window_style()) {
        setObjectName(QStringLiteral("heat-legend"));
        setToolTip(
            tr("The stronger the colour, the larger is a pass's part of the frame's time, and a "
               "buffer's of its memory"));
        follow_theme(this, [this] {
            style_ = &window_style();
            update();
        });
    }
    QSize sizeHint() const override {
        int width = 0;
        for (const auto& text : texts()) width += fontMetrics().horizontalAdvance(text) + bar_width + 3 * gap;
        return {width, fontMetrics().height()};
    }
    QSize minimumSizeHint() const override { return {0, sizeHint().height()}; }

  protected:
    void paintEvent(QPaintEvent*) override {
        if (width() < sizeHint().width()) return;  // half of it would be no legend
        QPainter painter(this);
        int x = gap;
        for (const bool is_pass : {true, false}) {
            for (int i = 0; i < bar_width; ++i)
                painter.fillRect(x + i, height() / 2 - 4, 1, 8,
                                 colour_of(heat_colour(*style_, is_pass, double(i) / bar_width)));
            x += bar_width + gap;
            const auto text = texts()[is_pass ? 0 : 1];
            painter.setPen(palette().color(QPalette::WindowText));
            painter.drawText(QRect(x, 0, width(), height()), Qt::AlignLeft | Qt::AlignVCenter, text);
            x += fontMetrics().horizontalAdvance(text) + 2 * gap;
        }
    }

  private:
    static constexpr int bar_width = 40, gap = 5;
    static QStringList texts() { return {tr("time"), tr("memory")}; }
    const PlotStyle* style_;
};

/// The pixel's lines have half of it at most, and the graph what they do not need.
void share_room(RowsPanel& changes) {
    auto& split = *static_cast<QSplitter*>(changes.parentWidget()->parentWidget());
    const int line = changes.view()->header()->sizeHint().height();
    const int needed = (changes.model().rowCount() + 3) * line;  // the pixel's name, headings, a margin
    const int all = split.height(), below = std::min(needed, all / 2);
    split.setSizes({all - below, below});
}

}  // namespace

PipelinePanel::PipelinePanel(QWidget* parent)
    : QWidget(parent),
      view_(new PipelineView),
      changes_(new RowsPanel(change_headings(), tr("No pass has written an image of the picture's pixels."))),
      pages_(new QStackedWidget) {
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(make_bar());
    written_ = new QLabel;
    written_->setObjectName(QStringLiteral("written"));
    written_->setTextFormat(Qt::RichText);
    written_->setTextInteractionFlags(Qt::TextBrowserInteraction);
    written_->setWordWrap(true);
    written_->setContentsMargins(8, 2, 8, 4);
    connect(written_, &QLabel::linkActivated, this, &PipelinePanel::buffer_wanted);
    layout->addWidget(written_);
    const auto empty = make_empty_page();
    empty_ = empty.text;
    empty.button->hide();
    auto* split = new QSplitter(Qt::Vertical);
    split->addWidget(view_);
    split->addWidget(make_changes());
    split->setCollapsible(0, false);
    pages_->addWidget(split);
    pages_->addWidget(empty.page);
    layout->addWidget(pages_, 1);
    connect(view_, &PipelineView::pass_clicked, this, [this](const QString& name) {
        emit step_wanted(name == QString::fromStdString(fields_.step) ? QString() : name);
    });
    connect(view_, &PipelineView::buffer_clicked, this, &PipelinePanel::buffer_wanted);
    connect(view_, &PipelineView::step_wanted, this, &PipelinePanel::step);
    connect(view_, &PipelineView::failed, this, [this](const QString& error) {
        empty_->setText(error);
        pages_->setCurrentIndex(1);
    });
    set_fields({.why_empty = tr("No frame.")});
}

QWidget* PipelinePanel::make_bar() {
    auto* bar = new QWidget;
    auto* row = new QHBoxLayout(bar);
    row->setContentsMargins(4, 2, 4, 2);
    row->setSpacing(2);
    back_ = add_icon_button(row, "pass-before", "step-back", tr("Buffers as before this pass (up arrow)"));
    forward_ =
        add_icon_button(row, "pass-next", "step-forward", tr("Buffers after the next pass (down arrow)"));
    whole_ = add_button(row, "whole-frame", nullptr, tr("Whole frame"));
    whole_->setToolTip(tr("Buffers as the frame leaves them"));
    whole_->setAutoRaise(false);
    row->addSpacing(8);
    where_ = make_cut_label("step");
    row->addWidget(where_, 1);
    row->addWidget(new HeatLegend);
    skipped_ = new QCheckBox(tr("Skipped"));
    skipped_->setObjectName(QStringLiteral("skipped"));
    skipped_->setToolTip(
        tr("All passes and buffers that nobody looks at; else grey marks count the passes, and a click on "
           "one shows them"));
    row->addWidget(skipped_);
    fit_ = add_icon_button(row, "fit-pipeline", "fit", tr("Show all (0)"));
    export_ = add_icon_button(row, "export-pipeline", "export", tr("Write the graph as SVG …"));
    connect(back_, &QToolButton::clicked, this, [this] { step(-1); });
    connect(forward_, &QToolButton::clicked, this, [this] { step(1); });
    connect(whole_, &QToolButton::clicked, this, [this] { emit step_wanted({}); });
    connect(skipped_, &QCheckBox::toggled, this, &PipelinePanel::skipped_chosen);
    connect(view_, &PipelineView::skipped_clicked, skipped_, [this] { skipped_->setChecked(true); });
    connect(fit_, &QToolButton::clicked, view_, &PipelineView::fit);
    connect(export_, &QToolButton::clicked, this, &PipelinePanel::export_wanted);
    return bar;
}

QWidget* PipelinePanel::make_changes() {
    traced_ = new QWidget;
    auto* layout = new QVBoxLayout(traced_);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    auto* row = new QHBoxLayout;
    row->setContentsMargins(6, 2, 4, 2);
    pixel_ = make_cut_label("traced-pixel");
    row->addWidget(pixel_, 1);
    auto* end = add_icon_button(row, "end-trace", "cancel", tr("Trace no pixel any longer"));
    connect(end, &QToolButton::clicked, this, &PipelinePanel::trace_ended);
    layout->addLayout(row);
    layout->addWidget(changes_, 1);
    changes_->view()->setRootIsDecorated(false);
    connect(changes_, &RowsPanel::row_clicked, this, [this](const QString& key) {
        const auto at = key.section(QLatin1Char(':'), 0, 0).toULongLong();
        const auto changes = fields_.changes.pixel_changes;  // answers may change the fields
        if (at >= changes.size()) return;
        emit buffer_wanted(QString::fromStdString(changes[at].key));
        emit step_wanted(QString::fromStdString(changes[at].pass));
    });
    return traced_;
}

bool PipelinePanel::shows_skipped() const {
    return skipped_->isChecked();
}

void PipelinePanel::set_shows_skipped(bool on) {
    const QSignalBlocker quiet(skipped_);
    skipped_->setChecked(on);
}

std::vector<std::string> PipelinePanel::passes() const {
    std::vector<std::string> names;
    for (const auto& node : fields_.pipeline.nodes)
        if (node.is_pass && !node.rows.front().skipped) names.push_back(node.rows.front().key);
    return names;
}

void PipelinePanel::step(int by) {
    const auto names = passes();
    const int count = int(names.size());
    if (count == 0) return;
    const auto found = std::find(names.begin(), names.end(), fields_.step);
    const int now = found == names.end() ? count : int(found - names.begin());
    const int next = (now + by + count + 1) % (count + 1);  // the last place is the whole frame
    emit step_wanted(next == count ? QString() : QString::fromStdString(names[std::size_t(next)]));
}

void PipelinePanel::set_fields(const PipelineFields& fields) {
    fields_ = fields;
    const bool has_frame = fields.why_empty.isEmpty();
    for (auto* button : {back_, forward_, fit_, export_}) button->setEnabled(has_frame);
    whole_->setEnabled(has_frame && !fields.step.empty());
    const auto names = passes();
    const auto found = std::find(names.begin(), names.end(), fields.step);
    where_->setText(found == names.end() ? QString()
                                         : tr("after pass %1 of %2, “%3”")
                                               .arg(found - names.begin() + 1)
                                               .arg(names.size())
                                               .arg(QString::fromStdString(fields.step)));
    where_->setToolTip(where_->text());
    QStringList links;
    for (const auto& [label, key] : fields.written)
        links << QStringLiteral("<a href='%1'>%2</a>").arg(key.toHtmlEscaped(), label.toHtmlEscaped());
    written_->setVisible(has_frame && !links.isEmpty());
    written_->setText(tr("The view's buffer is not written yet. This pass has written: %1")
                          .arg(links.join(QStringLiteral(", "))));
    view_->set_pipeline(fields.pipeline, fields.pictures);
    const auto& why_not = has_frame ? view_->problem() : fields.why_empty;
    pages_->setCurrentIndex(why_not.isEmpty() ? 0 : 1);
    empty_->setText(why_not);
    view_->set_marked(QString::fromStdString(fields.step), QString::fromStdString(fields.shown));
    traced_->setVisible(fields.traced.has_value());
    if (fields.traced)
        pixel_->setText(
            tr("What passes did to pixel %1, %2").arg(fields.traced->x()).arg(fields.traced->y()));
    auto rows = change_rows(fields.changes);
    const bool has_other_count = int(rows.size()) != changes_->model().rowCount();
    changes_->set_rows(std::move(rows));
    if (has_other_count) share_room(*changes_);
}

}  // namespace ir::widgets
