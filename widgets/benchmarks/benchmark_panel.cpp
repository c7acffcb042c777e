#include "widgets/benchmarks/benchmark_panel.h"

#include <QAction>
#include <QApplication>
#include <QClipboard>
#include <QComboBox>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QKeyEvent>
#include <QLabel>
#include <QMenu>
#include <QProgressBar>
#include <QSpinBox>
#include <QToolButton>
#include <algorithm>

#include "renderers/core/limits.h"
#include "widgets/panels/controls.h"
#include "widgets/panels/empty_tree_view.h"
#include "widgets/parameters/number_field.h"
#include "widgets/style/icons.h"

namespace ir::widgets {

BenchmarkPanel::BenchmarkPanel(QWidget* parent)
    : QWidget(parent),
      model_(new BenchmarkModel(this)),
      order_(new NumberOrder(BenchmarkModel::sort_role, this)) {
    make_view();
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    column->addWidget(make_head());
    column->addWidget(view_, 1);
    column->addWidget(make_foot());
    connect(model_, &BenchmarkModel::choice_changed, this,
            [this] { emit variants_chosen(chosen_variants()); });
    show_run();
}

QWidget* BenchmarkPanel::make_head() {
    auto* head = new QWidget;
    auto* row = new QHBoxLayout(head);
    row->setContentsMargins(4, 3, 4, 3);
    row->setSpacing(4);
    benchmarks_ = add_list(row, "benchmark", tr("Benchmark"), 10, 3);
    places_ = add_list(row, "place", tr("Scene and camera"), 10, 3);
    connect(benchmarks_, &QComboBox::activated, this,
            [this](int index) { emit benchmark_chosen(benchmarks_->itemData(index).toString()); });
    connect(places_, &QComboBox::activated, this,
            [this](int index) { emit place_chosen(places_->itemData(index).toString()); });
    repeats_ = new QSpinBox;
    repeats_->setObjectName(QStringLiteral("repeats"));
    repeats_->setRange(1, max_repeats);
    repeats_->setSuffix(tr(" ×"));
    repeats_->setToolTip(tr("Warm runs of which the median counts, after one cold run"));
    repeats_->setAccessibleName(tr("Repeats"));
    repeats_->setKeyboardTracking(false);
    leave_letters_to_shortcuts(repeats_);
    connect(repeats_, &QSpinBox::valueChanged, this, &BenchmarkPanel::repeats_chosen);
    row->addWidget(repeats_);
    run_ = add_button(row, "run", "rerun", tr("Run"));
    connect(run_, &QToolButton::clicked, this,
            [this] { fields_.is_running ? emit cancel_wanted() : emit run_wanted(); });
    progress_ = add_progress(row);
    doing_ = make_cut_label("doing");
    row->addWidget(doing_, 4);
    export_ = add_button(row, "export", "export", tr("Export"));
    export_->setPopupMode(QToolButton::InstantPopup);
    auto* menu = new QMenu(export_);
    menu->addAction(icon("table"), tr("Table (CSV) …"), this, &BenchmarkPanel::csv_wanted)
        ->setObjectName(QStringLiteral("export-csv"));
    menu->addAction(tr("All numbers (JSON) …"), this, &BenchmarkPanel::json_wanted)
        ->setObjectName(QStringLiteral("export-json"));
    export_->setMenu(menu);
    return head;
}

void BenchmarkPanel::make_view() {
    order_->setSourceModel(model_);
    view_ = new EmptyTreeView({});
    view_->setModel(order_);
    view_->setObjectName(QStringLiteral("benchmark-table"));
    view_->setAccessibleName(tr("Variants of the benchmark"));
    view_->setRootIsDecorated(false);
    view_->setUniformRowHeights(true);
    view_->setAlternatingRowColors(true);
    view_->setAllColumnsShowFocus(true);
    view_->setSelectionMode(QAbstractItemView::ExtendedSelection);
    view_->setEditTriggers(QAbstractItemView::NoEditTriggers);
    auto* header = view_->header();
    header->setSortIndicatorClearable(true);  // the third click brings back the benchmark's order
    header->setSortIndicator(-1, Qt::AscendingOrder);
    view_->setSortingEnabled(true);
    header->setStretchLastSection(false);
    header->setSectionResizeMode(QHeaderView::ResizeToContents);
    header->setMinimumSectionSize(48);
    connect(order_, &QAbstractItemModel::modelReset, this, &BenchmarkPanel::span_problems);
    connect(order_, &QAbstractItemModel::layoutChanged, this, &BenchmarkPanel::span_problems);
    connect(order_, &QAbstractItemModel::dataChanged, this, &BenchmarkPanel::span_problems);
    const auto add = [this](const char* name, const QString& text, auto run) {
        auto* action = new QAction(text, this);
        action->setObjectName(QLatin1String(name));
        connect(action, &QAction::triggered, this, run);
        view_->addAction(action);
        return action;
    };
    auto* copy = add("copy", tr("&Copy as text"), [this] { QApplication::clipboard()->setText(text()); });
    copy->setIcon(icon("copy"));
    copy->setShortcut(QKeySequence::Copy);
    copy->setShortcutContext(Qt::WidgetShortcut);
    copy->setToolTip(tr("Copy the chosen rows, or all, with headings"));
    add("check-all", tr("Check &all variants"), [this] { choose_all(true); });
    add("check-none", tr("Check &none"), [this] { choose_all(false); });
    view_->setContextMenuPolicy(Qt::ActionsContextMenu);
}

QWidget* BenchmarkPanel::make_foot() {
    auto* foot = new QWidget;
    auto* row = new QHBoxLayout(foot);
    row->setContentsMargins(6, 2, 6, 3);
    row->setSpacing(4);
    foot_icon_ = new QLabel;
    show_icon(foot_icon_, "warning", 14);
    row->addWidget(foot_icon_);
    foot_ = make_cut_label("foot");
    row->addWidget(foot_, 1);
    return foot;
}

void BenchmarkPanel::set_fields(const BenchmarkFields& fields) {
    fields_ = fields;
    show_options(benchmarks_, fields.benchmarks, fields.benchmark);
    show_options(places_, fields.places, fields.place);
    const QSignalBlocker silent(repeats_);
    repeats_->setValue(fields.repeats);
    model_->set_fixed(fields.is_running);
    model_->set_table(fields.table);
    view_->set_empty_text(fields.empty);
    show_run();
}

void BenchmarkPanel::show_run() {
    const bool runs = fields_.is_running;
    const auto busy = runs ? tr("The benchmark runs.") : QString();
    const auto doc = benchmarks_->currentData(Qt::ToolTipRole).toString();
    benchmarks_->setToolTip(doc.isEmpty() ? tr("Which benchmark runs") : doc);
    places_->setToolTip(tip_with(tr("Where it runs: in its own scene, or in the scene of the experiment that "
                                    "is chosen, with its camera and lights"),
                                 busy));
    for (QWidget* each : {static_cast<QWidget*>(benchmarks_), static_cast<QWidget*>(places_),
                          static_cast<QWidget*>(repeats_)})
        each->setEnabled(!runs);
    run_->setText(runs ? tr("Cancel") : tr("Run"));
    run_->setAccessibleName(run_->text());
    run_->setIcon(icon(runs ? "cancel" : "rerun"));
    run_->setEnabled(runs || fields_.why_not_run.isEmpty());
    run_->setToolTip(runs ? tr("Stop; rows that are there stay (Esc)")
                          : tip_with(tr("Measure the checked variants, and the peers with them. What renders "
                                        "meanwhile in the views makes times longer"),
                                     fields_.why_not_run));
    progress_->setVisible(runs);
    progress_->setValue(int(1000 * std::clamp(fields_.fraction, 0.0, 1.0)));
    doing_->setText(runs ? fields_.doing : QString());
    doing_->setToolTip(doing_->text());
    doing_->setVisible(runs);
    export_->setEnabled(fields_.has_numbers);
    export_->setToolTip(tip_with(tr("Write the numbers to a file"),
                                 fields_.has_numbers ? QString() : tr("There are none yet.")));
    foot_->setText(fields_.foot);
    foot_->setToolTip(fields_.foot_tip.isEmpty() ? fields_.foot : fields_.foot_tip);
    foot_icon_->setVisible(fields_.is_warning);
    foot_icon_->setToolTip(fields_.foot_tip);
}

/// What failed says why across all columns.
void BenchmarkPanel::span_problems() {
    for (int row = 0; row < order_->rowCount(); ++row) {
        const int line = order_->mapToSource(order_->index(row, 0)).row();
        const bool failed = model_->table().lines[std::size_t(line)].state == BenchmarkLine::State::failed;
        if (view_->isFirstColumnSpanned(row, {}) != failed) view_->setFirstColumnSpanned(row, {}, failed);
    }
}

QStringList BenchmarkPanel::chosen_variants() const {
    QStringList labels;
    for (const auto& line : model_->table().lines)
        if (!line.is_peer && line.is_chosen) labels << line.label;
    return labels;
}

void BenchmarkPanel::choose_all(bool chosen) {
    if (fields_.is_running) return;
    auto table = model_->table();
    for (auto& line : table.lines) line.is_chosen = chosen;
    model_->set_table(std::move(table));
    emit variants_chosen(chosen_variants());
}

QString BenchmarkPanel::text() const {
    return rows_as_text(*order_, *view_->selectionModel());
}

/// Esc belongs to the window, too, which cancels rendering with it.
bool BenchmarkPanel::event(QEvent* event) {
    if (event->type() == QEvent::ShortcutOverride && fields_.is_running &&
        static_cast<QKeyEvent*>(event)->key() == Qt::Key_Escape) {
        event->accept();
        return true;
    }
    return QWidget::event(event);
}

void BenchmarkPanel::keyPressEvent(QKeyEvent* event) {
    if (event->key() == Qt::Key_Escape && fields_.is_running) return emit cancel_wanted();
    QWidget::keyPressEvent(event);
}

}  // namespace ir::widgets
