#include "widgets/analysis/analysis_panel.h"

#include <QAction>
#include <QComboBox>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QMenu>
#include <QProgressBar>
#include <QPushButton>
#include <QScrollArea>
#include <QSignalBlocker>
#include <QSlider>
#include <QSplitter>
#include <QStackedWidget>
#include <QToolButton>
#include <algorithm>

#include "widgets/style/icons.h"

namespace ir::widgets {
namespace {

QHBoxLayout* row_in(QWidget* widget, const QMargins& margins) {
    auto* row = new QHBoxLayout(widget);
    row->setContentsMargins(margins);
    row->setSpacing(4);
    return row;
}

}  // namespace

AnalysisPanel::AnalysisPanel(ImageView::Surface surface, QWidget* parent)
    : QWidget(parent), chart_(new PlotPanel), split_(new QSplitter), pages_(new QStackedWidget) {
    chart_->header().hide();  // its place is this panel's own head
    split_->addWidget(make_picture_column(surface));
    split_->addWidget(chart_);
    split_->setStretchFactor(0, 2);
    split_->setStretchFactor(1, 3);
    split_->setSizes({400, 600});     // parts of the width
    auto* content = new QScrollArea;  // in a low panel picture and chart keep their height
    content->setFrameShape(QFrame::NoFrame);
    content->setWidget(split_);
    content->setWidgetResizable(true);
    pages_->addWidget(empty_.page);
    pages_->addWidget(content);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    column->addWidget(make_head());
    column->addWidget(pages_, 1);
    column->addWidget(make_foot());
    const auto follow = [this](const QString& id) {
        const auto key = id.section(QLatin1Char(':'), 0, 0);
        if (find(key) && key != shown()) {
            show_picture(key);
            emit picture_chosen(key);
        }
    };
    connect(chart_, &PlotPanel::selected_changed, this, follow);
    connect(chart_, &PlotPanel::point_activated, this, follow);
    show_run();
}

QWidget* AnalysisPanel::make_head() {
    auto* head = new QWidget;
    auto* row = row_in(head, {4, 3, 4, 3});
    analyses_ = add_list(row, "analysis", tr("Analysis"), 8);
    connect(analyses_, &QComboBox::activated, this,
            [this](int index) { emit analysis_chosen(analyses_->itemData(index).toString()); });
    new_ = add_icon_button(row, "new", "add", tr("New analysis"));
    new_->setPopupMode(QToolButton::InstantPopup);
    new_->setMenu(new QMenu(new_));
    connect(empty_.button, &QPushButton::clicked, this, &AnalysisPanel::take_offer);
    edit_ = add_icon_button(row, "edit", "rename", tr("Edit what is asked"));
    connect(edit_, &QToolButton::clicked, this, &AnalysisPanel::edit_wanted);
    run_ = add_button(row, "run", "rerun", tr("Run"));
    connect(run_, &QToolButton::clicked, this,
            [this] { fields_.runs ? emit cancel_wanted() : emit run_wanted(); });
    progress_ = add_progress(row);
    doing_ = make_cut_label("doing", Qt::ElideMiddle);
    row->addWidget(doing_, 3);
    files_ = add_button(row, "files", "export", tr("Export"));
    files_->setPopupMode(QToolButton::InstantPopup);
    auto* menu = new QMenu(files_);
    menu->addAction(icon("table"), tr("Table (CSV) …"), this, &AnalysisPanel::csv_wanted)
        ->setObjectName(QStringLiteral("export-csv"));
    menu->addAction(tr("Chart (SVG) …"), this, &AnalysisPanel::svg_wanted)
        ->setObjectName(QStringLiteral("export-svg"));
    files_->setMenu(menu);
    return head;
}

QWidget* AnalysisPanel::make_picture_column(ImageView::Surface surface) {
    auto* widget = new QWidget;
    auto* column = new QVBoxLayout(widget);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    auto* tools = new QWidget;
    auto* row = row_in(tools, {4, 0, 4, 2});
    pictures_ = add_list(row, "picture", tr("Picture"), 10, 2);
    connect(pictures_, &QComboBox::activated, this, [this] { choose_picture(shown()); });
    value_ = make_cut_label("value");
    row->addWidget(value_, 1);
    column->addWidget(tools);
    view_ = new ImageView(nullptr, surface);
    view_->set_legend(true);
    view_->setMinimumSize(160, 100);
    connect(view_, &ImageView::cursor_moved, this, &AnalysisPanel::show_value);
    column->addWidget(view_, 1);
    slider_ = new QSlider(Qt::Horizontal);
    slider_->setObjectName(QStringLiteral("frame"));
    slider_->setPageStep(4);
    slider_->setToolTip(tr("Goes through the frames: drag, or arrows, Home and End"));
    slider_->setAccessibleName(tr("Frame"));
    connect(slider_, &QSlider::valueChanged, this,
            [this](int index) { choose_picture(pictures_->itemData(index).toString()); });
    column->addWidget(slider_);
    return widget;
}

/// A person does.
void AnalysisPanel::choose_picture(const QString& key) {
    show_picture(key);
    emit picture_chosen(key);
}

QWidget* AnalysisPanel::make_foot() {
    auto* foot = new QWidget;
    auto* row = row_in(foot, {6, 2, 6, 3});
    foot_icon_ = new QLabel;
    show_icon(foot_icon_, "warning", 14);
    row->addWidget(foot_icon_);
    foot_ = make_cut_label("foot");
    row->addWidget(foot_, 1);
    return foot;
}

void AnalysisPanel::fill_kinds() {
    auto* menu = new_->menu();
    menu->setToolTipsVisible(true);
    if (int(fields_.kinds.size()) == menu->actions().size()) return;
    menu->clear();
    for (const auto& kind : fields_.kinds) {
        auto* action = menu->addAction(kind.label, this, [this, id = kind.id] { emit new_wanted(id); });
        action->setObjectName(QStringLiteral("new:") + kind.id);
        action->setToolTip(kind.tooltip);
    }
}

void AnalysisPanel::set_fields(const AnalysisFields& fields) {
    const auto before = shown();
    const bool has_other_pictures = fields.pictures != fields_.pictures;
    fields_ = fields;
    fill_kinds();
    show_options(analyses_, fields.analyses, fields.analysis);
    show_page();
    chart_->show_data(fields.data, tr("The answer has no bars; the lines below say why."));
    if (has_other_pictures) {
        std::vector<Option> options;
        for (const auto& each : fields.pictures) options.push_back({each.key, each.label, each.doc});
        show_options(pictures_, options, find(before) || options.empty() ? before : options.front().id);
        show_chosen_picture();
    }
    show_run();
}

/// Before there is an answer: what may be done about it.
void AnalysisPanel::show_page() {
    if (!fields_.empty.isEmpty()) {
        const bool can_add = fields_.analyses.empty() && fields_.why_read_only.isEmpty();
        empty_.show(fields_.empty, can_add ? tr("New analysis …") : QString());
    } else {
        empty_.show(fields_.waiting, fields_.runs                    ? QString()
                                     : fields_.why_not_run.isEmpty() ? tr("Run")
                                                                     : tr("Edit"));
    }
    pages_->setCurrentIndex(fields_.empty.isEmpty() && has_answer() ? 1 : 0);
}

void AnalysisPanel::take_offer() {
    if (!fields_.empty.isEmpty()) return new_->showMenu();
    fields_.why_not_run.isEmpty() ? emit run_wanted() : emit edit_wanted();
}

void AnalysisPanel::show_run() {
    const bool runs = fields_.runs;
    const auto busy = runs ? tr("An analysis runs.") : fields_.why_read_only;
    new_->setEnabled(fields_.why_read_only.isEmpty() && !runs);
    new_->setToolTip(tip_with(tr("New question about the chosen experiment"), busy));
    edit_->setEnabled(!fields_.analysis.isEmpty());
    run_->setText(runs ? tr("Cancel") : tr("Run"));
    run_->setAccessibleName(run_->text());
    run_->setIcon(icon(runs ? "cancel" : "rerun"));
    run_->setEnabled(runs || fields_.why_not_run.isEmpty());
    run_->setToolTip(runs ? tr("Stop; the answer before stays (Esc)")
                          : tip_with(tr("Render what the answer takes"), fields_.why_not_run));
    progress_->setVisible(runs);
    progress_->setValue(int(1000 * std::clamp(fields_.fraction, 0.0, 1.0)));
    doing_->setVisible(runs);
    doing_->setText(fields_.doing);
    doing_->setToolTip(fields_.doing);
    files_->setEnabled(fields_.data.count() > 0);
    files_->setToolTip(tip_with(tr("Write the table or the chart"),
                                fields_.data.count() > 0 ? QString() : tr("There is no answer yet.")));
    foot_->setText(fields_.foot);
    foot_->setToolTip(fields_.foot_tip.isEmpty() ? fields_.foot : fields_.foot_tip);
    foot_icon_->setVisible(fields_.is_warning);
}

const AnswerPicture* AnalysisPanel::find(const QString& key) const {
    const auto found = std::ranges::find(fields_.pictures, key, &AnswerPicture::key);
    return found == fields_.pictures.end() ? nullptr : &*found;
}

QString AnalysisPanel::shown() const {
    return pictures_->currentData().toString();
}

void AnalysisPanel::show_picture(const QString& key) {
    const int index = pictures_->findData(key);
    if (index < 0) return;
    pictures_->setCurrentIndex(index);
    show_chosen_picture();
}

void AnalysisPanel::show_chosen_picture() {
    const auto* chosen = find(shown());
    pictures_->setToolTip(chosen ? chosen->doc : QString());
    {
        const QSignalBlocker quiet(slider_);
        slider_->setRange(0, std::max(0, pictures_->count() - 1));
        slider_->setValue(pictures_->currentIndex());
    }
    slider_->setVisible(fields_.are_frames && chosen);
    value_->clear();
    if (!chosen) return view_->set_picture(nullptr);
    if (chosen->picture->size() != QSize(view_->image().width, view_->image().height)) {
        view_->set_picture(chosen->picture);
        view_->fit();
    } else {
        view_->set_picture(chosen->picture);
    }
    view_->set_display(chosen->display);
    show_bar(chosen->key);
}

/// Its own bar, unless one of those that are about it is chosen already.
void AnalysisPanel::show_bar(const QString& key) {
    const auto is_about = [&](const QString& id) { return id.section(QLatin1Char(':'), 0, 0) == key; };
    if (is_about(chart_->selected())) return;
    for (const auto& [point, series] : fields_.data.in_reading_order())
        if (const auto id = QString::fromStdString(point->id); is_about(id)) return chart_->select(id);
}

void AnalysisPanel::show_value(QPoint pixel) {
    const auto* chosen = find(shown());
    const auto inside = chosen ? place_text(*chosen->picture, pixel) : QString();
    if (inside.isEmpty()) return value_->clear();
    const auto& image = *chosen->picture->image;
    QStringList numbers;
    for (int c = 0; c < image.channels; ++c) numbers << short_number(image.at(pixel.x(), pixel.y(), c));
    const auto name = category_label(chosen->picture->categories, image.at(pixel.x(), pixel.y()));
    value_->setText(inside.simplified() + QStringLiteral("  ") +
                    (name.empty() ? numbers.join(QLatin1Char(' ')) : QString::fromStdString(name)));
}

/// Esc belongs to the window, too, which cancels rendering with it.
bool AnalysisPanel::event(QEvent* event) {
    if (event->type() == QEvent::ShortcutOverride && fields_.runs &&
        static_cast<QKeyEvent*>(event)->key() == Qt::Key_Escape) {
        event->accept();
        return true;
    }
    return QWidget::event(event);
}

void AnalysisPanel::keyPressEvent(QKeyEvent* event) {
    if (event->key() == Qt::Key_Escape && fields_.runs) return emit cancel_wanted();
    QWidget::keyPressEvent(event);
}

/// Side by side where there is room for it.
void AnalysisPanel::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    const auto wanted = width() > height() ? Qt::Horizontal : Qt::Vertical;
    if (split_->orientation() != wanted) split_->setOrientation(wanted);
}

}  // namespace ir::widgets
