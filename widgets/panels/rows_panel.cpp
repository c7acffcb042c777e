#include "widgets/panels/rows_panel.h"

#include <QAction>
#include <QApplication>
#include <QClipboard>
#include <QHeaderView>
#include <QKeyEvent>
#include <QLineEdit>
#include <QVBoxLayout>
#include <algorithm>
#include <functional>

namespace ir::widgets {
namespace {

/// Of a panel's width that names take before values.
constexpr double name_part = 0.45;

}  // namespace

RowsPanel::RowsPanel(const QStringList& headings, const QString& empty_text, QWidget* parent)
    : QWidget(parent),
      model_(new RowsModel(headings, this)),
      view_(new EmptyTreeView(empty_text, this)),
      empty_text_(empty_text) {
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(view_);
    view_->setModel(model_);
    view_->setAlternatingRowColors(true);
    view_->setSelectionMode(QAbstractItemView::ExtendedSelection);
    view_->setEditTriggers(QAbstractItemView::NoEditTriggers);
    view_->setExpandsOnDoubleClick(false);
    view_->setIndentation(12);
    view_->header()->setStretchLastSection(false);
    view_->header()->setSectionResizeMode(QHeaderView::ResizeToContents);
    view_->header()->setSectionResizeMode(0, QHeaderView::Interactive);
    view_->header()->setMinimumSectionSize(36);
    view_->header()->setResizeContentsPrecision(-1);  // rows that are scrolled away count
    view_->viewport()->installEventFilter(this);
    connect(view_->header(), &QHeaderView::sectionResized, this, [this](int section, int, int) {
        if (section > 0) fit_columns();
    });
    view_->setTextElideMode(Qt::ElideRight);
    connect(view_, &QTreeView::clicked, this,
            [this](const QModelIndex& at) { emit row_clicked(at.data(RowsModel::key_role).toString()); });
    connect(view_, &QTreeView::activated, this,
            [this](const QModelIndex& at) { emit row_activated(at.data(RowsModel::key_role).toString()); });
    const auto remember = [this](const QModelIndex& at, bool open) {
        if (!restoring_) open_[at.data(RowsModel::key_role).toString()] = open;
    };
    const auto follow_folding = [this, remember](const QModelIndex& at, bool open) {
        remember(at, open);
        fit_columns();
    };
    connect(view_, &QTreeView::expanded, this,
            [follow_folding](const QModelIndex& at) { follow_folding(at, true); });
    connect(view_, &QTreeView::collapsed, this,
            [follow_folding](const QModelIndex& at) { follow_folding(at, false); });
    connect(model_, &QAbstractItemModel::modelReset, this, [this] {
        restoring_ = true;
        restore_folding({});
        restoring_ = false;
        search();
    });
    auto* copy_action = new QAction(tr("Copy"), view_);
    copy_action->setShortcut(QKeySequence::Copy);
    copy_action->setShortcutContext(Qt::WidgetShortcut);
    connect(copy_action, &QAction::triggered, this, &RowsPanel::copy);
    view_->addAction(copy_action);
    view_->setContextMenuPolicy(Qt::ActionsContextMenu);
}

void RowsPanel::set_rows(std::vector<Row> rows) {
    model_->set_rows(std::move(rows));
    fit_columns();
}

void RowsPanel::set_searchable(const QString& hint) {
    search_ = new QLineEdit(this);
    search_->setObjectName(QStringLiteral("search"));
    search_->setPlaceholderText(hint);
    search_->setAccessibleName(hint);
    search_->setClearButtonEnabled(true);
    search_->installEventFilter(this);
    static_cast<QVBoxLayout*>(layout())->insertWidget(0, search_);
    connect(search_, &QLineEdit::textChanged, this, &RowsPanel::search);
    connect(search_, &QLineEdit::returnPressed, this, [this] {
        const auto found = best_fit();
        if (!found.isValid()) return;
        view_->setCurrentIndex(found);
        emit row_clicked(found.data(RowsModel::key_role).toString());
    });
}

void RowsPanel::search() {
    if (!search_) return;
    const QString query = search_->text().simplified();
    restoring_ = true;
    bool is_any = false;
    for (const auto letters : {Letters::all, Letters::some})
        if (!is_any) is_any = show_fitting({}, query, letters);
    query.isEmpty() ? restore_folding({}) : view_->expandAll();
    restoring_ = false;
    view_->set_empty_text(query.isEmpty() ? empty_text_ : nothing_fits());
}

/// How a row fits, by what is seen of it, its key and the groups that it is in.
int RowsPanel::fit(const QModelIndex& row, Letters letters) const {
    QStringList others{row.data(RowsModel::key_role).toString()};
    for (auto above = row.parent(); above.isValid(); above = above.parent())
        others << above.data().toString();
    return fit_of(search_->text(), row.data().toString(), others, letters);
}

/// Whether one is shown.
bool RowsPanel::show_fitting(const QModelIndex& parent, const QString& query, Letters letters) {
    bool is_any = false;
    for (int i = 0; i < model_->rowCount(parent); ++i) {
        const auto row = model_->index(i, 0, parent);
        const bool is_shown = show_fitting(row, query, letters) || query.isEmpty() || fit(row, letters) > 0;
        view_->setRowHidden(i, parent, !is_shown);
        is_any |= is_shown;
    }
    return is_any;
}

/// The one that fits best, without children of its own, as those are groups.
QModelIndex RowsPanel::best_fit() const {
    QModelIndex best;
    int most = 0;
    const std::function<void(const QModelIndex&)> look = [&](const QModelIndex& parent) {
        for (int i = 0; i < model_->rowCount(parent); ++i) {
            if (view_->isRowHidden(i, parent)) continue;
            const auto row = model_->index(i, 0, parent);
            look(row);
            if (const int its = fit(row, Letters::some); !model_->hasChildren(row) && its > most) {
                most = its;
                best = row;
            }
        }
    };
    look({});
    return best;
}

void RowsPanel::set_picture_size(QSize size) {
    view_->setIconSize(size);
}

bool RowsPanel::eventFilter(QObject* watched, QEvent* event) {
    if (watched == search_) {
        const bool is_key = event->type() == QEvent::KeyPress || event->type() == QEvent::ShortcutOverride;
        const int key = is_key ? static_cast<QKeyEvent*>(event)->key() : 0;
        if (key == Qt::Key_Escape && !search_->text().isEmpty()) {
            event->accept();
            if (event->type() == QEvent::KeyPress) search_->clear();
            return true;
        }
        if (key == Qt::Key_Down && event->type() == QEvent::KeyPress) {
            view_->setFocus();
            return true;
        }
        return QWidget::eventFilter(watched, event);
    }
    // The viewport, not the panel: scroll bars come and go.
    if (event->type() == QEvent::Resize) fit_columns();
    return QWidget::eventFilter(watched, event);
}

/// Names are no wider than they need where all columns have room. Else they have their part, and what is left
/// by as many values as are seen whole. Where not even the first value is, it is seen in part.
void RowsPanel::fit_columns() {
    const QAbstractItemView* view = view_;
    const int needed = std::max(view->sizeHintForColumn(0), view_->header()->sectionSizeHint(0));
    const int room = view_->viewport()->width();
    int beside = room - std::max(name_width_, std::min(needed, int(name_part * room)));
    int width = room, whole = 0;
    for (int c = 1; c < model_->columnCount() && view_->header()->sectionSize(c) <= beside; ++c, ++whole) {
        beside -= view_->header()->sectionSize(c);
        width -= view_->header()->sectionSize(c);
    }
    if (whole == 0 && model_->columnCount() > 1) width -= beside;
    if (whole == model_->columnCount() - 1) width = std::min(needed, width);
    view_->setColumnWidth(0, std::max(name_width_, width));
}

void RowsPanel::restore_folding(const QModelIndex& parent) {
    for (int i = 0; i < model_->rowCount(parent); ++i) {
        const QModelIndex row = model_->index(i, 0, parent);
        if (!model_->hasChildren(row)) continue;
        const auto known = open_.find(row.data(RowsModel::key_role).toString());
        const bool folded = row.data(RowsModel::folded_role).toBool();
        view_->setExpanded(row, known == open_.end() ? !folded : *known);
        restore_folding(row);
    }
}

void RowsPanel::copy() {
    QStringList lines;
    for (const QModelIndex& row : view_->selectionModel()->selectedRows()) {
        QStringList cells;
        for (int c = 0; c < model_->columnCount(); ++c) cells << row.siblingAtColumn(c).data().toString();
        lines << cells.join(QLatin1Char('\t'));
    }
    QApplication::clipboard()->setText(lines.join(QLatin1Char('\n')));
}

}  // namespace ir::widgets
