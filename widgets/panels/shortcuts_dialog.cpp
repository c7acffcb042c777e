#include "widgets/panels/shortcuts_dialog.h"

#include <QDialogButtonBox>
#include <QHeaderView>
#include <QLineEdit>
#include <QTreeWidget>
#include <QVBoxLayout>

#include "widgets/panels/action_text.h"

namespace ir::widgets {
ShortcutsDialog::ShortcutsDialog(const QList<QAction*>& actions,
                                 const QList<QPair<QString, QString>>& gestures, QWidget* parent)
    : QDialog(parent), tree_(new QTreeWidget(this)) {
    setWindowTitle(tr("Keyboard shortcuts"));
    resize(640, 640);
    auto* search_line = new QLineEdit(this);
    search_line->setPlaceholderText(tr("Search for an action or a key"));
    search_line->setClearButtonEnabled(true);
    tree_->setHeaderLabels({tr("Action"), tr("Keys")});
    tree_->header()->setSectionResizeMode(0, QHeaderView::Stretch);
    tree_->header()->setSectionResizeMode(1, QHeaderView::ResizeToContents);
    tree_->header()->setStretchLastSection(false);
    tree_->setAlternatingRowColors(true);
    tree_->setRootIsDecorated(false);
    tree_->setUniformRowHeights(true);
    tree_->setEditTriggers(QAbstractItemView::NoEditTriggers);
    for (const auto* action : actions)
        if (!action->isSeparator() && !action->text().isEmpty() && !action->menu())
            add_line(menu_title(*action), plain_text(action->text()), keys_of(*action));
    for (const auto& [what, how] : gestures) add_line(tr("Mouse and held keys"), what, how);
    tree_->expandAll();
    connect(search_line, &QLineEdit::textChanged, this, &ShortcutsDialog::search);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, this);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    auto* layout = new QVBoxLayout(this);
    layout->addWidget(search_line);
    layout->addWidget(tree_);
    layout->addWidget(buttons);
    search_line->setFocus();
}

QTreeWidgetItem* ShortcutsDialog::group(const QString& title) {
    for (int i = 0; i < tree_->topLevelItemCount(); ++i)
        if (tree_->topLevelItem(i)->text(0) == title) return tree_->topLevelItem(i);
    auto* item = new QTreeWidgetItem(tree_, {title});
    QFont font = tree_->font();
    font.setBold(true);
    item->setFont(0, font);
    item->setFlags(Qt::ItemIsEnabled);
    item->setFirstColumnSpanned(true);
    return item;
}

void ShortcutsDialog::add_line(const QString& group_title, const QString& what, const QString& how) {
    auto* parent = group(group_title);
    for (int i = 0; i < parent->childCount(); ++i)
        if (parent->child(i)->text(0) == what && parent->child(i)->text(1) == how) return;
    auto* item = new QTreeWidgetItem(parent, {what, how});
    if (how.isEmpty()) item->setForeground(0, palette().color(QPalette::PlaceholderText));
}

void ShortcutsDialog::search(const QString& text) {
    for (int g = 0; g < tree_->topLevelItemCount(); ++g) {
        auto* parent = tree_->topLevelItem(g);
        const bool whole_group = parent->text(0).contains(text, Qt::CaseInsensitive);
        int shown = 0;
        for (int i = 0; i < parent->childCount(); ++i) {
            auto* item = parent->child(i);
            const bool fits = whole_group || item->text(0).contains(text, Qt::CaseInsensitive) ||
                              item->text(1).contains(text, Qt::CaseInsensitive);
            item->setHidden(!fits);
            shown += fits;
        }
        parent->setHidden(shown == 0);
    }
}

}  // namespace ir::widgets
