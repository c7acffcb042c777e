#include "widgets/sweeps/sweep_panel.h"

#include <QAction>
#include <QApplication>
#include <QCheckBox>
#include <QClipboard>
#include <QComboBox>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QKeyEvent>
#include <QLabel>
#include <QMenu>
#include <QProgressBar>
#include <QPushButton>
#include <QScrollArea>
#include <QSlider>
#include <QStackedWidget>
#include <QTabBar>
#include <QToolButton>
#include <algorithm>
#include <utility>

#include "renderers/plot/plot_scale.h"
#include "widgets/panels/controls.h"
#include "widgets/panels/empty_tree_view.h"
#include "widgets/parameters/number_field.h"
#include "widgets/style/icons.h"

namespace ir::widgets {
namespace {

QHBoxLayout* row_in(QWidget* widget) {
    auto* row = new QHBoxLayout(widget);
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(4);
    return row;
}

}  // namespace

SweepPanel::SweepPanel(QWidget* parent)
    : QWidget(parent),
      model_(new SweepModel(this)),
      order_(new NumberOrder(SweepModel::sort_role, this)),
      sheet_(new ContactSheet(*model_)),
      table_(new EmptyTreeView({})),
      plot_(new PlotView),
      pages_(new QStackedWidget),
      tabs_pages_(new QStackedWidget),
      tools_(new QStackedWidget),
      tabs_(new QTabBar) {
    order_->setSourceModel(model_);
    sheet_->setModel(order_);
    make_table();
    no_plot_ = new QLabel;
    no_plot_->setObjectName(QStringLiteral("no-plot"));
    no_plot_->setAlignment(Qt::AlignCenter);
    no_plot_->setWordWrap(true);
    no_plot_->setAttribute(Qt::WA_TransparentForMouseEvents);
    (new QVBoxLayout(plot_))->addWidget(no_plot_);
    auto* plot_page = new QScrollArea;  // in a low panel it keeps its height
    plot_page->setFrameShape(QFrame::NoFrame);
    plot_page->setWidget(plot_);
    plot_page->setWidgetResizable(true);
    for (QWidget* each :
         {static_cast<QWidget*>(sheet_), static_cast<QWidget*>(table_), static_cast<QWidget*>(plot_page)})
        tabs_pages_->addWidget(each);
    auto* content = new QWidget;
    auto* inner = new QVBoxLayout(content);
    inner->setContentsMargins(0, 0, 0, 0);
    inner->setSpacing(0);
    inner->addWidget(make_tools());
    inner->addWidget(tabs_pages_, 1);
    inner->addWidget(make_foot());
    connect(empty_.button, &QPushButton::clicked, this,
            [this] { fields_.sweep.isEmpty() ? emit new_wanted() : emit axis_wanted(); });
    pages_->addWidget(empty_.page);
    pages_->addWidget(content);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    column->addWidget(make_head());
    column->addWidget(pages_, 1);
    link_selection();
    show_run();
}

QWidget* SweepPanel::make_head() {
    auto* head = new QWidget;
    auto* row = row_in(head);
    row->setContentsMargins(4, 3, 4, 3);
    sweeps_ = add_list(row, "sweep", tr("Sweep"), 8);
    connect(sweeps_, &QComboBox::activated, this,
            [this](int index) { emit sweep_chosen(sweeps_->itemData(index).toString()); });
    new_ = add_icon_button(row, "new", "add", tr("New sweep"));
    connect(new_, &QToolButton::clicked, this, &SweepPanel::new_wanted);
    edit_ = add_icon_button(row, "edit", "rename", tr("Edit what varies"));
    connect(edit_, &QToolButton::clicked, this, &SweepPanel::edit_wanted);
    judged_ = new QCheckBox(tr("Reference"));
    judged_->setObjectName(QStringLiteral("judged"));
    connect(judged_, &QCheckBox::toggled, this, &SweepPanel::judging_chosen);
    row->addWidget(judged_);
    run_ = add_button(row, "run", "rerun", tr("Run"));
    connect(run_, &QToolButton::clicked, this,
            [this] { fields_.run == SweepFields::Run::none ? emit run_wanted() : emit cancel_wanted(); });
    pause_ = add_button(row, "pause", "pause", tr("Pause"));
    connect(pause_, &QToolButton::clicked, this,
            [this] { emit pause_wanted(fields_.run == SweepFields::Run::running); });
    progress_ = add_progress(row);
    doing_ = make_cut_label("doing", Qt::ElideMiddle);
    row->addWidget(doing_, 3);
    files_ = add_button(row, "files", "export", tr("Results"));
    files_->setPopupMode(QToolButton::InstantPopup);
    files_->setToolTip(tr("Write the table or a report, or look at results of another folder"));
    auto* menu = new QMenu(files_);
    csv_ = menu->addAction(icon("table"), tr("Table (CSV) …"), this, &SweepPanel::csv_wanted);
    csv_->setObjectName(QStringLiteral("export-csv"));
    report_ = menu->addAction(tr("Report (HTML) …"), this, &SweepPanel::report_wanted);
    report_->setObjectName(QStringLiteral("report"));
    menu->addSeparator();
    menu->addAction(icon("open"), tr("Open results of a folder …"), this, &SweepPanel::folder_wanted)
        ->setObjectName(QStringLiteral("open-folder"));
    own_folder_ = menu->addAction(tr("Back to the project's results"), this, &SweepPanel::own_folder_wanted);
    own_folder_->setObjectName(QStringLiteral("own-folder"));
    files_->setMenu(menu);
    return head;
}

QWidget* SweepPanel::make_tools() {
    auto* bar = new QWidget;
    auto* row = row_in(bar);
    row->setContentsMargins(4, 0, 4, 2);
    tabs_->setObjectName(QStringLiteral("tabs"));
    tabs_->setDrawBase(false);
    tabs_->setExpanding(false);
    tabs_->addTab(tr("Sheet"));
    tabs_->addTab(tr("Table"));
    tabs_->addTab(tr("Plot"));
    tabs_->setFocusPolicy(Qt::TabFocus);
    row->addWidget(tabs_);
    tools_->addWidget(make_sheet_tools());
    tools_->addWidget(make_table_tools());
    tools_->addWidget(make_plot_tools());
    tools_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
    row->addWidget(tools_, 1);
    connect(tabs_, &QTabBar::currentChanged, this, [this](int tab) {
        tabs_pages_->setCurrentIndex(tab);
        tools_->setCurrentIndex(tab);
        emit tab_chosen(tab);
    });
    return bar;
}

QWidget* SweepPanel::make_sheet_tools() {
    auto* tools = new QWidget;
    auto* row = row_in(tools);
    shows_ = add_list(row, "shows", tr("What is shown of each variation"), 8);
    shows_->addItems({tr("Pictures"), tr("Differences"), tr("Both")});
    shows_->setItemData(1, tr("From the reference of each variation: red is more, blue is less"),
                        Qt::ToolTipRole);
    connect(shows_, &QComboBox::currentIndexChanged, this,
            [this](int shown) { sheet_->set_shows(ContactSheet::Shows(shown)); });
    sorting_ = add_list(row, "sorting", tr("By what variations are sorted"), 8);
    connect(sorting_, &QComboBox::activated, this, [this](int column) {
        table_->sortByColumn(column, is_descending() ? Qt::DescendingOrder : Qt::AscendingOrder);
    });
    descending_ = add_icon_button(row, "descending", "down", tr("Largest first"));
    descending_->setCheckable(true);
    connect(descending_, &QToolButton::clicked, this, [this](bool on) {
        table_->sortByColumn(std::max(0, sorting_->currentIndex()),
                             on ? Qt::DescendingOrder : Qt::AscendingOrder);
    });
    exposure_ = new NumberField;
    exposure_->setObjectName(QStringLiteral("exposure"));
    exposure_->setAccessibleName(tr("Exposure"));
    exposure_->setToolTip(tr("Stops that all pictures are brighter than the first one would be alone"));
    exposure_->setRange(-40, 40);
    exposure_->setSuffix(tr(" EV"));
    exposure_->setMaximumWidth(80);
    exposure_->show_value(0);
    connect(exposure_, &NumberField::chosen, this,
            [this](double stops) { sheet_->pictures().set_exposure(stops); });
    row->addWidget(exposure_);
    extent_ = new QLabel;
    extent_->setObjectName(QStringLiteral("extent"));
    extent_->setToolTip(tr("What the colours of all differences span"));
    row->addWidget(extent_);
    size_ = new QSlider(Qt::Horizontal);
    size_->setObjectName(QStringLiteral("size"));
    size_->setAccessibleName(tr("Size of the pictures"));
    size_->setToolTip(size_->accessibleName());
    size_->setRange(ContactSheet::min_width, ContactSheet::max_width);
    size_->setValue(ContactSheet::usual_width);
    size_->setMinimumWidth(50);
    size_->setMaximumWidth(140);
    connect(size_, &QSlider::valueChanged, sheet_, &ContactSheet::set_picture_width);
    row->addWidget(size_, 1);
    const auto show_look = [this] {
        const bool has_colours =
            sheet_->pictures().is_colour() && shows() != int(ContactSheet::Shows::differences);
        exposure_->setVisible(has_colours);
        const double extent = sheet_->pictures().extent();
        extent_->setVisible(shows() != int(ContactSheet::Shows::pictures) && extent > 0);
        extent_->setText(tr("± %1").arg(QString::fromStdString(plot_number(extent))));
    };
    connect(&sheet_->pictures(), &SheetPictures::arrived, this, show_look);
    connect(shows_, &QComboBox::currentIndexChanged, this, show_look);
    show_look();
    return tools;
}

QWidget* SweepPanel::make_table_tools() {
    auto* tools = new QWidget;
    auto* row = row_in(tools);
    columns_ = add_button(row, "columns", "table", tr("Columns"));
    columns_->setToolTip(tr("Which columns are shown"));
    columns_->setPopupMode(QToolButton::InstantPopup);
    columns_->setMenu(new QMenu(columns_));
    connect(columns_->menu(), &QMenu::aboutToShow, this, &SweepPanel::fill_column_menu);
    row->addStretch(1);
    auto* header = table_->header();
    header->setContextMenuPolicy(Qt::CustomContextMenu);
    connect(header, &QHeaderView::customContextMenuRequested, this, [this, header](const QPoint& at) {
        columns_->menu()->popup(header->viewport()->mapToGlobal(at));
    });
    return tools;
}

void SweepPanel::fill_column_menu() {
    auto* menu = columns_->menu();
    menu->clear();
    const auto& headings = model_->rows().headings;
    for (const auto& heading : headings) {
        auto* action = menu->addAction(heading);
        action->setCheckable(true);
        action->setChecked(!hidden_.contains(heading));
        connect(action, &QAction::toggled, this, [this, heading](bool on) {
            auto hidden = hidden_;
            on ? void(hidden.removeAll(heading)) : hidden.append(heading);
            hide_columns(hidden);
        });
    }
    menu->addSeparator();
    menu->addAction(tr("All"), this, [this] { hide_columns({}); })->setEnabled(!hidden_.isEmpty());
}

void SweepPanel::hide_columns(const QStringList& headings) {
    hidden_ = headings;
    const auto& known = model_->rows().headings;
    for (int column = 0; column < known.size(); ++column)
        table_->setColumnHidden(1 + column, hidden_.contains(known[column]));
}

QWidget* SweepPanel::make_plot_tools() {
    auto* tools = new QWidget;
    auto* row = row_in(tools);
    plots_ = add_list(row, "plot", tr("Against what"), 10);
    connect(plots_, &QComboBox::activated, this,
            [this](int index) { emit plot_chosen(plots_->itemData(index).toString()); });
    quantities_ = add_list(row, "quantity", tr("What is drawn"), 8);
    connect(quantities_, &QComboBox::activated, this,
            [this](int index) { emit quantity_chosen(quantities_->itemData(index).toString()); });
    row->addStretch(1);
    return tools;
}

QWidget* SweepPanel::make_foot() {
    auto* foot = new QWidget;
    auto* row = row_in(foot);
    row->setContentsMargins(6, 2, 6, 3);
    foot_icon_ = new QLabel;
    show_icon(foot_icon_, "warning", 14);
    row->addWidget(foot_icon_);
    foot_ = make_cut_label("foot");
    row->addWidget(foot_, 1);
    return foot;
}

void SweepPanel::make_table() {
    table_->setModel(order_);
    table_->setObjectName(QStringLiteral("table"));
    table_->setAccessibleName(tr("Variations of the sweep"));
    table_->setRootIsDecorated(false);
    table_->setUniformRowHeights(true);
    table_->setAlternatingRowColors(true);
    table_->setAllColumnsShowFocus(true);
    table_->setSelectionMode(QAbstractItemView::ExtendedSelection);
    table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
    auto* header = table_->header();
    header->setStretchLastSection(false);
    header->setMinimumSectionSize(36);
    header->setSortIndicator(0, Qt::AscendingOrder);
    table_->setSortingEnabled(true);
    auto* load = new QAction(tr("&Load this setting"), this);
    load->setObjectName(QStringLiteral("load"));
    connect(load, &QAction::triggered, this, [this] {
        const auto id = table_->currentIndex().data(SweepModel::id_role).toString();
        if (!id.isEmpty()) emit variation_chosen(id);
    });
    auto* copy = new QAction(icon("copy"), tr("&Copy as text"), this);
    copy->setObjectName(QStringLiteral("copy"));
    copy->setShortcut(QKeySequence::Copy);
    copy->setShortcutContext(Qt::WidgetShortcut);
    connect(copy, &QAction::triggered, this, [this] { QApplication::clipboard()->setText(text()); });
    for (QWidget* each : {static_cast<QWidget*>(table_), static_cast<QWidget*>(sheet_)}) {
        each->addActions({load, copy});
        each->setContextMenuPolicy(Qt::ActionsContextMenu);
    }
    connect(header, &QHeaderView::sortIndicatorChanged, this, [this] {
        awaited_.clear();
        show_sorting();
    });
}

void SweepPanel::link_selection() {
    sheet_->setSelectionModel(table_->selectionModel());
    connect(sheet_, &ContactSheet::variation_chosen, this, &SweepPanel::variation_chosen);
    connect(table_, &QTreeView::activated, this, [this](const QModelIndex& row) {
        emit variation_chosen(row.data(SweepModel::id_role).toString());
    });
    connect(plot_, &PlotView::activated, this, &SweepPanel::variation_chosen);
    connect(plot_, &PlotView::selected_changed, this, &SweepPanel::select);
    connect(table_->selectionModel(), &QItemSelectionModel::currentRowChanged, this,
            [this](const QModelIndex& row) {
                if (row.isValid()) plot_->select(row.data(SweepModel::id_role).toString());
            });
}

void SweepPanel::select(const QString& id) {
    const auto row = order_->mapFromSource(model_->index_of(id));
    if (!row.isValid() || row == table_->currentIndex()) return;
    table_->selectionModel()->setCurrentIndex(
        row, QItemSelectionModel::ClearAndSelect | QItemSelectionModel::Rows);
}

void SweepPanel::set_rows(SweepRows rows) {
    const bool has_other_columns = rows.headings != model_->rows().headings;
    const auto heading = sorted_by();
    const bool descending = is_descending();
    const auto id = table_->currentIndex().data(SweepModel::id_role).toString();
    model_->set_rows(std::move(rows));
    if (!has_other_columns) return select(id);
    const QSignalBlocker silent(sorting_);
    sorting_->clear();
    sorting_->addItem(tr("Sweep's order"));
    sorting_->addItems(model_->rows().headings);
    sort_by(heading, descending);
    for (int column = 0; column < model_->columnCount(); ++column) table_->resizeColumnToContents(column);
    hide_columns(hidden_);
    select(id);
}

void SweepPanel::set_fields(const SweepFields& fields) {
    fields_ = fields;
    show_options(sweeps_, fields.sweeps, fields.sweep);
    show_options(plots_, fields.plots, fields.plot);
    show_options(quantities_, fields.quantities, fields.quantity);
    const QSignalBlocker silent(judged_);
    judged_->setChecked(fields.is_judged);
    empty_.show(fields.empty, fields.button);
    pages_->setCurrentIndex(fields.empty.isEmpty() ? 1 : 0);
    sheet_->pictures().set_semantic(fields.semantic);
    if (!(plot_->data() == fields.data)) plot_->set_data(fields.data);
    no_plot_->setText(fields.why_no_plot);
    no_plot_->setVisible(fields.data.count() == 0);
    show_run();
}

void SweepPanel::show_run() {
    using Run = SweepFields::Run;
    const bool runs = fields_.run != Run::none;
    const auto busy = runs ? tr("The sweep runs.") : fields_.why_read_only;
    sweeps_->setEnabled(!fields_.sweeps.empty() && !runs);
    new_->setEnabled(fields_.why_read_only.isEmpty() && !runs);
    new_->setToolTip(tip_with(tr("New sweep of the chosen experiment"), busy));
    edit_->setEnabled(!fields_.sweep.isEmpty());
    judged_->setEnabled(!runs);
    judged_->setToolTip(tip_with(
        tr("Measure each variation against its ground truth, as Match takes it, and how long it takes "
           "when it is rendered once more"),
        runs ? busy : QString()));
    run_->setText(runs ? tr("Cancel") : tr("Run"));
    run_->setAccessibleName(run_->text());
    run_->setIcon(icon(runs ? "cancel" : "rerun"));
    run_->setEnabled(runs || fields_.why_not_run.isEmpty());
    run_->setToolTip(runs ? tr("Stop; variations that are there stay, and Run goes on with the others (Esc)")
                          : tip_with(fields_.run_tip, fields_.why_not_run));
    const bool goes_on = fields_.run == Run::pausing || fields_.run == Run::paused;
    pause_->setVisible(runs);
    pause_->setText(goes_on ? tr("Resume") : tr("Pause"));
    pause_->setAccessibleName(pause_->text());
    pause_->setIcon(icon(goes_on ? "play" : "pause"));
    pause_->setToolTip(goes_on ? tr("Go on with the next variation")
                               : tr("Wait when the variation that is being rendered is through; its times "
                                    "would be wrong otherwise"));
    progress_->setVisible(runs);
    progress_->setValue(int(1000 * std::clamp(fields_.fraction, 0.0, 1.0)));
    doing_->setVisible(runs);
    doing_->setText(fields_.doing);
    doing_->setToolTip(fields_.doing);
    const auto& lines = model_->rows().lines;
    csv_->setEnabled(!lines.empty());
    report_->setEnabled(!runs && std::any_of(lines.begin(), lines.end(), [](const SweepLine& line) {
        return line.state == SweepLine::State::done || line.state == SweepLine::State::stale;
    }));
    own_folder_->setEnabled(fields_.is_elsewhere);
    foot_->setText(fields_.foot);
    foot_->setToolTip(fields_.foot_tip.isEmpty() ? fields_.foot : fields_.foot_tip);
    foot_icon_->setVisible(fields_.is_warning);
}

void SweepPanel::set_tab(int tab) {
    tabs_->setCurrentIndex(std::clamp(tab, 0, tabs_->count() - 1));
}

int SweepPanel::tab() const {
    return tabs_->currentIndex();
}

void SweepPanel::set_shows(int shows) {
    shows_->setCurrentIndex(std::clamp(shows, 0, shows_->count() - 1));
}

int SweepPanel::shows() const {
    return shows_->currentIndex();
}

void SweepPanel::sort_by(const QString& heading, bool descending) {
    const int column = heading.isEmpty() ? 0 : 1 + int(model_->rows().headings.indexOf(heading));
    table_->sortByColumn(column, descending ? Qt::DescendingOrder : Qt::AscendingOrder);
    awaited_ = column == 0 ? heading : QString();
    show_sorting();
}

QString SweepPanel::sorted_by() const {
    if (!awaited_.isEmpty()) return awaited_;
    return model_->rows().headings.value(table_->header()->sortIndicatorSection() - 1);
}

bool SweepPanel::is_descending() const {
    return table_->header()->sortIndicatorOrder() == Qt::DescendingOrder;
}

/// The sheet's controls follow the table's header, and its captions what it is sorted by.
void SweepPanel::show_sorting() {
    const int column = std::max(0, table_->header()->sortIndicatorSection());
    if (sorting_) sorting_->setCurrentIndex(column);
    if (descending_) descending_->setChecked(is_descending());
    const int axes = model_->rows().axes;
    sheet_->set_told_column(std::min(std::max(column, axes + 1), model_->columnCount() - 1));
}

QString SweepPanel::text() const {
    return rows_as_text(*order_, *table_->selectionModel());
}

/// Esc belongs to the window, too, which cancels rendering with it.
bool SweepPanel::event(QEvent* event) {
    if (event->type() == QEvent::ShortcutOverride && fields_.run != SweepFields::Run::none &&
        static_cast<QKeyEvent*>(event)->key() == Qt::Key_Escape) {
        event->accept();
        return true;
    }
    return QWidget::event(event);
}

void SweepPanel::keyPressEvent(QKeyEvent* event) {
    if (event->key() == Qt::Key_Escape && fields_.run != SweepFields::Run::none) return emit cancel_wanted();
    QWidget::keyPressEvent(event);
}

}  // namespace ir::widgets
