#include "widgets/inspect/inspector_panel.h"

#include <QCheckBox>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QScrollBar>
#include <QToolButton>
#include <QTreeView>
#include <algorithm>

#include "widgets/style/icons.h"

namespace ir::widgets {

InspectorPanel::InspectorPanel(QWidget* parent)
    : QWidget(parent),
      model_(new InspectorModel(this)),
      filter_(new InspectorFilter(this)),
      view_(new QTreeView(this)) {
    filter_->setSourceModel(model_);
    make_view();
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(make_bar());
    surface_ = new QLabel(this);
    surface_->setObjectName(QStringLiteral("surface"));
    surface_->setTextFormat(Qt::PlainText);
    surface_->setWordWrap(true);
    surface_->setContentsMargins(8, 2, 8, 4);
    surface_->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
    surface_->hide();
    layout->addWidget(surface_);
    layout->addWidget(view_, 1);
    compute_all_ = new QCheckBox(tr("Compute everything"), this);
    compute_all_->setObjectName(QStringLiteral("compute-all"));
    compute_all_->setToolTip(
        tr("Keeps every buffer of the method, also those that nothing shows. Costs time and memory."));
    connect(compute_all_, &QCheckBox::clicked, this, &InspectorPanel::compute_all_chosen);
    auto* foot = new QHBoxLayout;
    foot->setContentsMargins(8, 3, 8, 3);
    foot->addWidget(compute_all_);
    foot->addStretch(1);
    missing_ = new QLabel(this);
    missing_->setEnabled(false);
    foot->addWidget(missing_);
    layout->addLayout(foot);
    update_controls();
}

QWidget* InspectorPanel::make_bar() {
    auto* bar = new QWidget(this);
    auto* row = new QHBoxLayout(bar);
    row->setContentsMargins(4, 3, 4, 3);
    row->setSpacing(4);
    search_ = new QLineEdit(bar);
    search_->setObjectName(QStringLiteral("filter"));
    search_->setPlaceholderText(tr("Filter"));
    search_->setClearButtonEnabled(true);
    search_->setAccessibleName(tr("Filter the buffers by name"));
    connect(search_, &QLineEdit::textChanged, this, [this](const QString& text) {
        filter_->set_text(text);
        restore_all();
    });
    row->addWidget(search_, 1);
    const auto button = [&](const char* name, const QString& text, const char* icon_name) {
        auto* result = new QToolButton(bar);
        result->setObjectName(QLatin1String(name));
        result->setText(text);
        if (icon_name) result->setIcon(icon(icon_name));
        result->setAutoRaise(true);
        row->addWidget(result);
        return result;
    };
    pin_ = button("pin", tr("Pin"), nullptr);
    connect(pin_, &QToolButton::clicked, this, &InspectorPanel::pin_cursor);
    explain_ = button("explain", tr("Explain"), nullptr);
    connect(explain_, &QToolButton::clicked, this, [this] {
        if (const auto pixel = chosen_pixel()) emit explain_wanted(*pixel);
    });
    auto* copy = button("copy", tr("Copy"), "copy");
    copy->setToolTip(tr("Copy all values"));
    copy->setAccessibleName(copy->toolTip());
    copy->setPopupMode(QToolButton::InstantPopup);
    auto* menu = new QMenu(copy);
    menu->addAction(tr("Copy as text"), this, &InspectorPanel::copy_text);
    menu->addAction(tr("Copy as CSV"), this, &InspectorPanel::copy_csv);
    copy->setMenu(menu);
    clear_ = button("clear", tr("Remove all pins"), "clear");
    connect(clear_, &QToolButton::clicked, this, &InspectorPanel::pins_cleared);
    return bar;
}

void InspectorPanel::make_view() {
    view_->setModel(filter_);
    view_->setObjectName(QStringLiteral("values"));
    view_->setAlternatingRowColors(true);
    view_->setUniformRowHeights(true);
    view_->setSelectionMode(QAbstractItemView::ExtendedSelection);
    view_->setEditTriggers(QAbstractItemView::NoEditTriggers);
    view_->setExpandsOnDoubleClick(false);
    view_->setIndentation(14);
    view_->setIconSize({14, 14});
    view_->setMouseTracking(true);
    view_->header()->setStretchLastSection(false);
    view_->header()->setSectionResizeMode(QHeaderView::Interactive);
    view_->header()->setMinimumSectionSize(48);
    view_->header()->setSectionsClickable(true);
    view_->header()->setHighlightSections(false);
    view_->header()->setDefaultAlignment(Qt::AlignLeft | Qt::AlignVCenter);
    view_->setContextMenuPolicy(Qt::CustomContextMenu);
    view_->header()->setContextMenuPolicy(Qt::CustomContextMenu);
    view_->viewport()->installEventFilter(this);
    view_->installEventFilter(this);
    connect(view_->header(), &QHeaderView::sectionClicked, this, [this](int column) {
        if (column >= InspectorModel::first_pin_column)
            show_column_menu(
                column, view_->header()->mapToGlobal(QPoint(view_->header()->sectionViewportPosition(column),
                                                            view_->header()->height())));
    });
    connect(view_->header(), &QWidget::customContextMenuRequested, this, [this](QPoint at) {
        const int column = view_->header()->logicalIndexAt(at);
        if (column > 0) show_column_menu(column, view_->header()->mapToGlobal(at));
    });
    connect(view_, &QWidget::customContextMenuRequested, this, &InspectorPanel::show_menu);
    connect(view_, &QTreeView::clicked, this, &InspectorPanel::clicked);
    connect(view_, &QTreeView::activated, this, &InspectorPanel::activated);
    connect(view_->selectionModel(), &QItemSelectionModel::currentChanged, this,
            &InspectorPanel::update_controls);
    const auto remember = [this](const QModelIndex& at, bool open) {
        if (!restoring_) open_[at.data(InspectorModel::key_role).toString()] = open;
    };
    connect(view_, &QTreeView::expanded, this, [remember](const QModelIndex& at) { remember(at, true); });
    connect(view_, &QTreeView::collapsed, this, [remember](const QModelIndex& at) { remember(at, false); });
    connect(model_, &QAbstractItemModel::modelAboutToBeReset, this, &InspectorPanel::remember_place);
    connect(filter_, &QAbstractItemModel::modelReset, this, [this] {
        if (search_) filter_->set_text(search_->text());  // other buffers may fit with all letters
        restore_all();
    });
}

void InspectorPanel::set_readings(Readings readings) {
    model_->set_readings(std::move(readings));
    update_controls();
}

void InspectorPanel::set_pins(const std::vector<QPoint>& pins) {
    model_->set_pins(pins);
    fit_columns();
    update_controls();
}

void InspectorPanel::set_compute_all(bool on) {
    compute_all_->setChecked(on);
}

void InspectorPanel::set_surface(const QString& text) {
    surface_->setText(text);
    surface_->setVisible(!text.isEmpty());
}

void InspectorPanel::update_controls() {
    const bool cursor = model_->readings().cursor.has_value();
    pin_->setEnabled(cursor);
    pin_->setToolTip(cursor ? tr("Give the pixel under the cursor a column of its own")
                            : tr("Point at a pixel of a view first"));
    const auto chosen = chosen_pixel();
    explain_->setEnabled(chosen.has_value());
    explain_->setToolTip(chosen ? tr("Have the method explain pixel %1, %2").arg(chosen->x()).arg(chosen->y())
                                : tr("Point at a pixel of a view first, or choose a pin's column"));
    clear_->setEnabled(!model_->pins().empty());
    clear_->setToolTip(clear_->isEnabled() ? tr("Remove all pins") : tr("There are no pins"));
    clear_->setAccessibleName(tr("Remove all pins"));
    const int missing = model_->not_computed();
    const QString text = missing ? tr("%n not computed", nullptr, missing) : QString();
    if (missing_->text() != text) missing_->setText(text);
}

std::optional<QPoint> InspectorPanel::chosen_pixel() const {
    const int column = view_->currentIndex().column();
    if (column >= InspectorModel::first_pin_column) return model_->place_of(column);
    return model_->readings().cursor;
}

void InspectorPanel::point_at(QPoint at) {
    const QModelIndex index = view_->indexAt(at);
    const bool link = index.column() == InspectorModel::cursor_column &&
                      !index.data(InspectorModel::available_role).toBool();
    view_->viewport()->setCursor(link ? Qt::PointingHandCursor : Qt::ArrowCursor);
}

void InspectorPanel::fit_columns() {
    auto& header = *view_->header();
    const int numbers = view_->fontMetrics().horizontalAdvance(QStringLiteral("0.0000 0.0000 0.0000")) + 26;
    const int columns = filter_->columnCount();
    while (int(sized_.size()) < columns) {
        const int column = int(sized_.size());
        if (column > 0) header.resizeSection(column, numbers);
        sized_.push_back(true);
    }
    sized_.resize(std::size_t(columns));
    int others = 0;
    for (int c = 1; c < columns; ++c) others += header.sectionSize(c);
    header.resizeSection(0, std::clamp(view_->viewport()->width() - others, 120, 260));
}

void InspectorPanel::remember_place() {
    current_ = view_->currentIndex().data(InspectorModel::key_role).toString();
    current_column_ = view_->currentIndex().column();
    scrolled_ = view_->verticalScrollBar()->value();
}

void InspectorPanel::restore_all() {
    restoring_ = true;
    restore({});
    restoring_ = false;
    fit_columns();
    if (!current_.isEmpty() && !view_->currentIndex().isValid()) {
        const QModelIndex row = filter_->mapFromSource(model_->index_of(current_));
        if (row.isValid())
            view_->setCurrentIndex(
                row.siblingAtColumn(std::min(current_column_, filter_->columnCount() - 1)));
    }
    view_->verticalScrollBar()->setValue(scrolled_);
}

void InspectorPanel::restore(const QModelIndex& parent) {
    for (int i = 0; i < filter_->rowCount(parent); ++i) {
        const QModelIndex row = filter_->index(i, 0, parent);
        if (!filter_->hasChildren(row)) continue;
        const auto known = open_.find(row.data(InspectorModel::key_role).toString());
        // Groups are open and buffers shut until somebody says otherwise.
        view_->setExpanded(row, known == open_.end() ? !parent.isValid() : *known);
        restore(row);
    }
}

}  // namespace ir::widgets
