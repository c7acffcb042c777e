#include "widgets/plot/plot_panel.h"

#include <QAction>
#include <QApplication>
#include <QClipboard>
#include <QHeaderView>
#include <QLabel>
#include <QListWidget>
#include <QPushButton>
#include <QResizeEvent>
#include <QScrollArea>
#include <QSplitter>
#include <QStackedWidget>
#include <QVBoxLayout>
#include <algorithm>
#include <functional>

#include "widgets/panels/empty_tree_view.h"
#include "widgets/style/icons.h"

namespace ir::widgets {
namespace {

constexpr int max_seen_lines = 4;  ///< that are seen at once

/// Lines that are wrapped, as high as they need until they are too many.
class Lines : public QListWidget {
  public:
    Lines() {
        setFrameShape(NoFrame);
        setIconSize(QSize(14, 14));
        setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);  // it would cover a single line
        setWordWrap(true);
        setTextElideMode(Qt::ElideNone);
        setResizeMode(Adjust);
        setVerticalScrollMode(ScrollPerPixel);
        setSelectionMode(ExtendedSelection);
    }
    void fit() {
        int wanted = 0;
        for (int i = 0; i < count(); ++i) wanted += visualItemRect(item(i)).height();
        const int line = fontMetrics().lineSpacing() + 4;
        setFixedHeight(std::clamp(wanted, line, max_seen_lines * line) + 4);
    }

  protected:
    void resizeEvent(QResizeEvent* event) override {
        QListWidget::resizeEvent(event);
        if (event->size().width() == event->oldSize().width()) return;
        doItemsLayout();
        fit();
    }
};

void add_copy(QWidget* widget, std::function<void()> run) {
    auto* copy = new QAction(QObject::tr("Copy"), widget);
    copy->setShortcut(QKeySequence::Copy);
    copy->setShortcutContext(Qt::WidgetShortcut);
    QObject::connect(copy, &QAction::triggered, widget, [run = std::move(run)] { run(); });
    widget->addAction(copy);
    widget->setContextMenuPolicy(Qt::ActionsContextMenu);
}

}  // namespace

PlotPanel::PlotPanel(QWidget* parent)
    : QWidget(parent),
      header_(new PlotHeader),
      view_(new PlotView),
      model_(new PlotTableModel(this)),
      sorted_(new QSortFilterProxyModel(this)),
      table_(new EmptyTreeView(tr("No points yet."))),
      pages_(new QStackedWidget) {
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    column->addWidget(header_);
    column->addWidget(pages_, 1);
    make_table();
    connect(empty_.button, &QPushButton::clicked, this, &PlotPanel::button_clicked);
    pages_->addWidget(empty_.page);
    pages_->addWidget(make_content());
    link_selection();
}

void PlotPanel::make_table() {
    sorted_->setSourceModel(model_);
    sorted_->setSortRole(PlotTableModel::sort_role);
    table_->setModel(sorted_);
    table_->setAccessibleName(tr("Points of the plot"));
    table_->setRootIsDecorated(false);
    table_->setUniformRowHeights(true);
    table_->setAlternatingRowColors(true);
    table_->setSelectionMode(QAbstractItemView::ExtendedSelection);
    table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
    table_->setSortingEnabled(true);
    table_->header()->setSortIndicator(-1, Qt::AscendingOrder);
    sorted_->sort(-1);
    table_->header()->setStretchLastSection(false);
    connect(table_->header(), &QHeaderView::sectionResized, this, [this] {
        has_own_widths_ |= table_->header()->underMouse() && QApplication::mouseButtons() & Qt::LeftButton;
    });
    table_->header()->setMinimumSectionSize(36);
    add_copy(table_, [this] {
        QStringList lines;
        for (const auto& row : table_->selectionModel()->selectedRows()) {
            QStringList cells;
            for (int c = 0; c < model_->columnCount(); ++c) cells << row.siblingAtColumn(c).data().toString();
            lines << cells.join(QLatin1Char('\t'));
        }
        QApplication::clipboard()->setText(lines.join(QLatin1Char('\n')));
    });
}

QWidget* PlotPanel::make_content() {
    auto* chart = new QWidget;
    auto* column = new QVBoxLayout(chart);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    scroll_ = new QScrollArea;
    scroll_->setFrameShape(QFrame::NoFrame);
    scroll_->setWidget(view_);
    scroll_->setWidgetResizable(true);
    scroll_->setMinimumSize(PlotView::min_size);
    column->addWidget(scroll_, 1);
    waiting_ = new QLabel(view_);
    waiting_->setObjectName(QStringLiteral("waiting"));
    waiting_->setAlignment(Qt::AlignCenter);
    waiting_->setWordWrap(true);
    waiting_->setAttribute(Qt::WA_TransparentForMouseEvents);
    point_ = new QLabel;
    point_->setObjectName(QStringLiteral("point"));
    point_->setContentsMargins(8, 2, 8, 3);
    point_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
    column->addWidget(point_);
    lines_ = new Lines;
    lines_->setObjectName(QStringLiteral("lines"));
    lines_->setAccessibleName(tr("Points that could not be measured, and notes"));
    add_copy(lines_, [this] {
        QStringList texts;
        for (const auto* item : lines_->selectedItems()) texts << item->text();
        QApplication::clipboard()->setText(texts.join(QLatin1Char('\n')));
    });
    column->addWidget(lines_);
    split_ = new QSplitter;
    split_->addWidget(chart);
    split_->addWidget(table_);
    split_->setStretchFactor(0, 3);
    split_->setStretchFactor(1, 2);
    return split_;
}

void PlotPanel::link_selection() {
    connect(view_, &PlotView::selected_changed, this, [this](const QString& id) {
        select_row(id);
        scroll_to_point();
        show_point();
        emit selected_changed(id);
    });
    connect(view_, &PlotView::activated, this, &PlotPanel::point_activated);
    connect(table_->selectionModel(), &QItemSelectionModel::currentRowChanged, this,
            [this](const QModelIndex& row) {
                if (linking_ || !row.isValid()) return;
                view_->select(row.data(PlotTableModel::id_role).toString());
                scroll_to_point();
                show_point();
                emit selected_changed(selected());
            });
    connect(table_, &QTreeView::activated, this, [this](const QModelIndex& row) {
        emit point_activated(row.data(PlotTableModel::id_role).toString());
    });
}

void PlotPanel::select_row(const QString& id) {
    linking_ = true;
    const auto row = sorted_->mapFromSource(model_->index_of(id));
    if (row.isValid()) {
        table_->setCurrentIndex(row);
        table_->scrollTo(row);
    } else {
        table_->clearSelection();
    }
    linking_ = false;
}

void PlotPanel::select(const QString& id) {
    view_->select(id);
    select_row(view_->selected());
    scroll_to_point();
    show_point();
}

void PlotPanel::scroll_to_point() {
    constexpr int around = 30;
    const auto at = view_->position_of(selected()).toPoint();
    if (!selected().isEmpty()) scroll_->ensureVisible(0, at.y(), 0, around);
}

void PlotPanel::show_point() {
    const auto* point = data().find(selected().toStdString());
    auto text = point ? QString::fromStdString(point->label) : QString();
    text.replace(QLatin1Char('\n'), QStringLiteral(" · "));
    point_->setText(text);
    point_->setToolTip(text);
}

void PlotPanel::show_lines() {
    QStringList lines;
    for (const auto* group : {&data().problems, &view_->drawing().plot().remarks, &data().notes})
        for (const auto& line : *group) lines << QString::fromStdString(line);
    QStringList shown;
    for (int i = 0; i < lines_->count(); ++i) shown << lines_->item(i)->text();
    if (lines != shown) {
        lines_->clear();
        for (int i = 0; i < lines.size(); ++i) {
            auto* item = new QListWidgetItem(
                icon(std::size_t(i) < data().problems.size() ? "warning" : "note"), lines[i], lines_);
            item->setToolTip(lines[i]);
        }
    }
    lines_->setVisible(!lines.isEmpty());
    static_cast<Lines*>(lines_)->fit();
}

void PlotPanel::show_empty(const QString& text, const QString& button) {
    empty_.show(text, button);
    pages_->setCurrentIndex(0);
}

bool PlotPanel::is_empty() const {
    return pages_->currentIndex() == 0;
}

void PlotPanel::show_data(const PlotData& data, const QString& waiting) {
    pages_->setCurrentIndex(1);
    if (!(data == view_->data())) {
        view_->set_data(data);
        linking_ = true;
        model_->set_data(data);
        linking_ = false;
        if (column_widths_of_ != data.headings) has_own_widths_ = false;
        if (!has_own_widths_) {
            column_widths_of_ = data.headings;
            for (int c = 0; c < model_->columnCount(); ++c) table_->resizeColumnToContents(c);
        }
        select_row(view_->selected());
    }
    waiting_->setText(waiting);
    waiting_->setVisible(data.count() == 0);
    waiting_->setGeometry(view_->rect().adjusted(60, 20, -20, -60));
    show_point();
    show_lines();
}

/// Side by side where there is room for it.
void PlotPanel::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    const auto wanted = width() > 620 && width() > height() ? Qt::Horizontal : Qt::Vertical;
    if (split_->orientation() != wanted) split_->setOrientation(wanted);
    waiting_->setGeometry(view_->rect().adjusted(60, 20, -20, -60));
}

}  // namespace ir::widgets
