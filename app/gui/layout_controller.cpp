#include "app/gui/layout_controller.h"

#include <QAction>
#include <QInputDialog>
#include <QMainWindow>
#include <QMenu>
#include <QMessageBox>
#include <QSettings>

#include "app/gui/text_of.h"
#include "app/gui/workspace.h"

namespace ir::gui {
namespace {

const QString group = QStringLiteral("window/layouts"), prefix = QStringLiteral("layout-");
constexpr int max_name = 60;
constexpr auto modifiers = Qt::CTRL | Qt::ALT | Qt::SHIFT;

}  // namespace

LayoutController::LayoutController(QMainWindow& window, DockLayout& docks, Workspace& workspace,
                                   Actions& actions, bool remember)
    : QObject(&window),
      window_(window),
      docks_(docks),
      workspace_(workspace),
      actions_(actions),
      remember_(remember),
      menu_(new QMenu(tr("&Layouts"), &window)),
      removed_(new QMenu(tr("&Remove"), menu_)) {
    actions_.add("layout-default", tr("&Default layout"), nullptr,
                 {QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_L)}, [this] {
                     end_pictures_alone();
                     docks_.restore_default();
                 });
    int number = 0;
    for (const auto& [name, title, doc] : DockLayout::entries()) {
        auto* action =
            actions_.add(prefix + name, tr("Layout: %1").arg(title), nullptr,
                         {QKeySequence(modifiers | Qt::Key(Qt::Key_1 + number++))}, [this, name = name] {
                             end_pictures_alone();
                             docks_.apply(name);
                         });
        if (!doc.isEmpty()) action->setToolTip(doc);
    }
    actions_
        .add("layout-keep", tr("&Keep this layout …"), nullptr, {QKeySequence(modifiers | Qt::Key_0)},
             [this] { ask_for_name(); })
        ->setData(tr("Panels and views as they stand, for all projects"));
    alone_ =
        actions_.add_switch("pictures-alone", tr("Pictures alon&e"), nullptr, {QKeySequence(Qt::Key_F11)},
                            false, [this](bool on) { show_pictures_alone(on); });
    if (remember_) {
        QSettings settings;
        const int count = settings.beginReadArray(group);
        for (int i = 0; i < count; ++i) {
            settings.setArrayIndex(i);
            const auto name = settings.value("name").toString();
            if (!name.isEmpty())
                own_[name] = {settings.value("docks").toByteArray(), settings.value("views").toByteArray()};
        }
    }
    docks_.set_compare([this] { return compare(); });
    menu_->setToolTipsVisible(true);
    connect(menu_, &QMenu::aboutToShow, this, &LayoutController::fill_menu);
    fill_menu();
}

/// Side by side, unless the active view compares already; false: there is nothing to compare.
bool LayoutController::compare() {
    auto& views = workspace_.views();
    if (views.pictures().owners().size() < 2) return false;
    if (!widgets::compares(views.active_state().mode)) views.set_mode(widgets::ViewMode::side_by_side);
    return true;
}

void LayoutController::keep(const QString& name) {
    const auto clean = name.simplified().left(max_name);
    if (clean.isEmpty()) return;
    own_[clean] = {docks_.save(), workspace_.area().save()};
    write();
}

void LayoutController::apply(const QString& name) {
    const auto found = own_.constFind(name);
    if (found == own_.constEnd()) return;
    end_pictures_alone();
    workspace_.area().restore(found->views);
    docks_.load(found->docks);
}

void LayoutController::remove(const QString& name) {
    own_.remove(name);
    write();
}

void LayoutController::ask_for_name() {
    auto* dialog = new QInputDialog(&window_);
    dialog->setObjectName(QStringLiteral("layout-name"));
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setWindowTitle(tr("Keep this layout"));
    dialog->setLabelText(tr("Name (a layout that has it is replaced)"));
    dialog->setComboBoxEditable(true);
    dialog->setComboBoxItems(names());
    dialog->setTextValue({});
    connect(dialog, &QInputDialog::textValueSelected, this, &LayoutController::keep);
    dialog->open();
}

void LayoutController::ask_to_remove(const QString& name) {
    const auto answer = QMessageBox::question(&window_, tr("Layouts"), tr("Remove the layout %1?").arg(name));
    if (answer == QMessageBox::Yes) remove(name);
}

void LayoutController::end_pictures_alone() {
    alone_->setChecked(false);
}

void LayoutController::show_pictures_alone(bool alone) {
    if (!alone) return docks_.load(before_);
    before_ = docks_.save();
    docks_.hide_all();
}

void LayoutController::fill_menu() {
    menu_->clear();
    actions_.fill(menu_, "layout-default |");
    for (const auto& entry : DockLayout::entries()) menu_->addAction(actions_.find(prefix + entry.name));
    menu_->addSeparator();
    for (const auto& name : own_.keys()) menu_->addAction(in_menu(name), this, [this, name] { apply(name); });
    removed_->clear();
    removed_->setEnabled(!own_.isEmpty());
    for (const auto& name : own_.keys())
        removed_->addAction(in_menu(name) + "…", this, [this, name] { ask_to_remove(name); });
    menu_->addAction(actions_.find("layout-keep"));
    menu_->addMenu(removed_);
}

void LayoutController::write() const {
    if (!remember_) return;
    QSettings settings;
    settings.remove(group);
    settings.beginWriteArray(group);
    int i = 0;
    for (auto own = own_.constBegin(); own != own_.constEnd(); ++own) {
        settings.setArrayIndex(i++);
        settings.setValue("name", own.key());
        settings.setValue("docks", own->docks);
        settings.setValue("views", own->views);
    }
    settings.endArray();
}

}  // namespace ir::gui
