#include "widgets/inspect/buffer_table.h"

#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QScrollBar>
#include <QTableView>
#include <QToolButton>
#include <QTransposeProxyModel>
#include <algorithm>
#include <utility>

#include "renderers/core/error.h"
#include "widgets/style/icons.h"
#include "widgets/style/theme.h"

namespace ir::widgets {

BufferTable::BufferTable(QWidget* parent)
    : QWidget(parent), model_(new BufferModel(this)), fields_(new QTransposeProxyModel(this)) {
    view_ = make_view(model_, "elements");
    single_ = make_view(fields_, "fields");
    connect_view();
    auto* page = new QVBoxLayout(this);
    page->setContentsMargins(0, 0, 0, 0);
    page->setSpacing(0);
    title_ = new QLabel(this);
    title_->setContentsMargins(6, 4, 4, 4);
    title_->setMinimumWidth(1);
    page->addWidget(title_);
    page->addWidget(bar_ = make_bar());
    problem_ = new QLabel(this);
    problem_->setObjectName(QStringLiteral("problem"));
    problem_->setWordWrap(true);
    problem_->setContentsMargins(8, 2, 8, 4);
    set_themed_sheet(problem_, [](const ThemeColours& colours) {
        return QStringLiteral("color: %1;").arg(colours.error.name());
    });
    problem_->hide();
    page->addWidget(problem_);
    page->addWidget(view_, 1);
    page->addWidget(single_, 1);
    status_ = new QLabel(this);
    status_->setObjectName(QStringLiteral("status"));
    status_->setWordWrap(true);
    status_->setContentsMargins(8, 3, 8, 3);
    status_->setForegroundRole(QPalette::PlaceholderText);
    page->addWidget(status_);
    clear();
}

BufferTable::~BufferTable() {
    cancelled_ = true;
    worker_.finish();
}

QWidget* BufferTable::make_bar() {
    auto* bar = new QWidget(this);
    auto* row = new QHBoxLayout(bar);
    row->setContentsMargins(6, 0, 4, 4);
    row->setSpacing(4);
    filter_ = new QLineEdit(bar);
    filter_->setObjectName(QStringLiteral("filter"));
    filter_->setClearButtonEnabled(true);
    filter_->setAccessibleName(tr("Filter"));
    row->addWidget(filter_, 3);
    connect(filter_, &QLineEdit::editingFinished, this, &BufferTable::read_filter);
    connect(filter_, &QLineEdit::textChanged, this, [this](const QString& text) {
        if (text.isEmpty()) read_filter();  // the clear button
    });
    element_ = new QLineEdit(bar);
    element_->setObjectName(QStringLiteral("element"));
    element_->setPlaceholderText(tr("Go to #"));
    element_->setToolTip(tr("Number of an element to go to; Enter goes there"));
    element_->setAccessibleName(tr("Go to element"));
    row->addWidget(element_, 1);
    connect(element_, &QLineEdit::returnPressed, this, &BufferTable::jump);
    const auto button = [&](const char* name, const QString& tip, void (BufferTable::*slot)()) {
        auto* result = new QToolButton(bar);
        result->setObjectName(QLatin1String(name));
        result->setIcon(icon(name));
        result->setToolTip(tip);
        result->setAccessibleName(tip);
        result->setAutoRaise(true);
        connect(result, &QToolButton::clicked, this, slot);
        row->addWidget(result);
        return result;
    };
    copy_ = button("copy", tr("Copy the chosen rows"), &BufferTable::copy);
    save_ = button("save", tr("Save what is listed as CSV …"), &BufferTable::save_wanted);
    return bar;
}

QTableView* BufferTable::make_view(QAbstractItemModel* model, const char* name) {
    auto* view = new QTableView(this);
    view->setModel(model);
    view->setObjectName(QLatin1String(name));
    view->setAlternatingRowColors(true);
    view->setShowGrid(false);
    view->setWordWrap(false);
    view->setCornerButtonEnabled(false);
    view->setHorizontalScrollMode(QAbstractItemView::ScrollPerPixel);
    view->setTabKeyNavigation(false);
    view->verticalHeader()->setSectionResizeMode(QHeaderView::Fixed);
    view->verticalHeader()->setDefaultSectionSize(view->fontMetrics().height() + 5);
    view->horizontalHeader()->setHighlightSections(false);
    return view;
}

void BufferTable::connect_view() {
    view_->setSelectionBehavior(QAbstractItemView::SelectRows);
    view_->verticalHeader()->hide();
    auto* header = view_->horizontalHeader();
    header->setSectionResizeMode(QHeaderView::Interactive);
    header->setSectionsClickable(true);
    view_->installEventFilter(this);
    connect(header, &QHeaderView::sectionClicked, this, &BufferTable::sort_by);
    connect(view_->selectionModel(), &QItemSelectionModel::currentRowChanged, this,
            &BufferTable::chosen_by_person);
    connect(view_, &QTableView::activated, this,
            [this](const QModelIndex& at) { emit show_wanted(model_->element(at.row())); });
    single_->horizontalHeader()->hide();
    single_->horizontalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
    single_->verticalHeader()->setHighlightSections(false);
}

/// Of one element there is nothing to filter, to sort or to go to.
void BufferTable::show_one_or_many() {
    const bool single = reason_.isEmpty() && model_->buffer().elements == 1;
    bar_->setVisible(!single);
    view_->setVisible(!single);
    single_->setVisible(single);
    if (!single) return;
    if (fields_->sourceModel() != model_) fields_->setSourceModel(model_);
    single_->setRowHidden(0, true);  // its number
}

void BufferTable::set_buffer(const QString& name, BufferData buffer) {
    const bool same_fields = buffer.fields == model_->buffer().fields && reason_.isEmpty();
    reason_.clear();
    title_->setText(QStringLiteral("<b>%1</b>").arg(name.toHtmlEscaped()));
    title_->setToolTip(name);
    showing_ = true;
    // A column for each of millions of elements would take minutes.
    if (buffer.elements != 1) fields_->setSourceModel(nullptr);
    model_->set_buffer(std::move(buffer));
    showing_ = false;
    show_one_or_many();
    if (!same_fields) {
        listing_ = {};
        chosen_ = -1;
        filter_->clear();
        const auto& scalars = model_->reader().scalars();
        filter_->setPlaceholderText(
            scalars.empty() ? tr("Filter")
                            : tr("Filter: %1 > 0").arg(QString::fromStdString(scalars.front().name)));
        QStringList names;
        for (const auto& scalar : scalars) names << QString::fromStdString(scalar.name);
        filter_->setToolTip(tr("A field, one of = != < <= > >= and a number.\nFields: %1, element")
                                .arg(names.join(QStringLiteral(", "))));
        view_->horizontalHeader()->setSortIndicatorShown(false);
        fit_columns();
    }
    relist();
}

void BufferTable::clear(const QString& reason) {
    reason_ = reason.isEmpty() ? tr("No buffer is shown.") : reason;
    title_->clear();
    listing_ = {};
    chosen_ = -1;
    filter_->clear();
    model_->set_buffer({});
    show_one_or_many();
    relist();
}

void BufferTable::set_filter(const QString& text) {
    filter_->setText(text);
    read_filter();
}

void BufferTable::select_element(qint64 element) {
    chosen_ = element;
    show_chosen();
    update_status();
}

void BufferTable::show_chosen() {
    showing_ = true;
    const int row = model_->row_of(chosen_);
    if (row < 0)
        view_->clearSelection();
    else if (view_->currentIndex().row() != row || !view_->selectionModel()->isRowSelected(row)) {
        const int column = std::max(view_->currentIndex().column(), 0);
        view_->setCurrentIndex(model_->index(row, column));
        view_->scrollTo(model_->index(row, column), QAbstractItemView::PositionAtCenter);
    }
    showing_ = false;
}

void BufferTable::chosen_by_person() {
    if (showing_) return;
    chosen_ = model_->element(view_->currentIndex().row());
    update_status();
    emit element_selected(chosen_);
}

void BufferTable::fit_columns() {
    const QFontMetrics metrics = view_->fontMetrics();
    auto* header = view_->horizontalHeader();
    const int number = metrics.horizontalAdvance(QStringLiteral("-0.0000e-00")) + 14;
    for (int c = 0; c < model_->columnCount(); ++c) {
        const QString title = model_->headerData(c, Qt::Horizontal, Qt::DisplayRole).toString();
        const int min_width = c == 0 ? metrics.horizontalAdvance(QStringLiteral("00000000")) + 12 : number;
        header->resizeSection(c, std::max(min_width, metrics.horizontalAdvance(title) + 28));
    }
}

void BufferTable::set_stale(bool stale) {
    if (std::exchange(stale_, stale) != stale) update_status();
}

void BufferTable::update_status() {
    const bool there = reason_.isEmpty();
    for (QWidget* widget : {static_cast<QWidget*>(filter_), static_cast<QWidget*>(element_),
                            static_cast<QWidget*>(copy_), static_cast<QWidget*>(save_)})
        widget->setEnabled(there);
    if (!there) return status_->setText(reason_);
    const BufferData& buffer = model_->buffer();
    const QLocale locale(QLocale::English);
    const auto count = [&locale](quint64 n) { return locale.toString(n); };
    QStringList parts;
    if (listing_.filter || model_->listed())
        parts << tr("%1 of %2 elements").arg(count(quint64(model_->rowCount())), count(buffer.elements));
    else
        parts << (buffer.elements == 1 ? tr("1 element") : tr("%1 elements").arg(count(buffer.elements)));
    if (buffer.present() < buffer.elements)
        parts << tr("only the first %1 were sent").arg(count(buffer.present()));
    if (listing_.sorted_by >= 0 && !busy_ && quint64(model_->rowCount()) > max_sorted)
        parts << tr("not sorted: more than %1 elements, filter them first").arg(count(max_sorted));
    if (stale_) parts << tr("rendering …");
    if (busy_) parts << tr("listing …");
    if (chosen_ >= 0 && model_->row_of(chosen_) < 0 && !busy_)
        parts << (quint64(chosen_) >= buffer.present() ? tr("element %1 is not here").arg(chosen_)
                                                       : tr("element %1 is filtered out").arg(chosen_));
    status_->setText(parts.join(QStringLiteral("; ")));
}

}  // namespace ir::widgets
