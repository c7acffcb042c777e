#include <QAction>
#include <QHBoxLayout>
#include <QLineEdit>
#include <QMenu>
#include <QToolButton>

#include "projects/analyses.h"
#include "widgets/document/makers.h"
#include "widgets/document/project_model.h"
#include "widgets/document/project_nodes.h"
#include "widgets/document/project_panel.h"
#include "widgets/document/project_tree.h"
#include "widgets/style/icons.h"

namespace ir::widgets {

QAction* ProjectPanel::add_action(const char* name, const QString& text, const char* drawing,
                                  const QKeySequence& key, std::function<void()> run) {
    // The key stands in the text only: as a shortcut it would be ambiguous with the window's own.
    const QString key_text = key.toString(QKeySequence::NativeText);
    auto* action = new QAction(icon(drawing), text + QLatin1Char('\t') + key_text, this);
    action->setObjectName(QLatin1String(name));
    action->setIconText(text);
    action->setProperty("tip", QStringLiteral("%1 (%2)").arg(text, key_text));
    connect(action, &QAction::triggered, this, [run = std::move(run)] { run(); });
    view_->add_key(key, action);
    actions_.insert(QLatin1String(name), action);
    return action;
}

void ProjectPanel::make_actions() {
    add_action("duplicate", tr("Duplicate"), "copy", QKeySequence(Qt::CTRL | Qt::Key_D),
               [this] { duplicate_selected(); });
    add_action("rename", tr("Rename"), "rename", QKeySequence(Qt::Key_F2), [this] { rename_selected(); });
    add_action("up", tr("Move up"), "up", QKeySequence(Qt::ALT | Qt::Key_Up), [this] { move_selected(-1); });
    add_action("down", tr("Move down"), "down", QKeySequence(Qt::ALT | Qt::Key_Down),
               [this] { move_selected(1); });
    add_action("remove", tr("Remove"), "clear", QKeySequence(Qt::Key_Delete), [this] { remove_selected(); });
    add_action("add", tr("Add"), "add", QKeySequence(Qt::Key_Insert), [this] { show_add_menu(); });
    connect(add_menu_, &QMenu::aboutToShow, this, &ProjectPanel::fill_add_menu);
}

QHBoxLayout* ProjectPanel::button_row() {
    auto* row = new QHBoxLayout;
    row->setContentsMargins(6, 0, 6, 0);
    row->setSpacing(1);
    row->addWidget(filter_line_, 1);
    row->addSpacing(4);
    const auto add_button = [&](const char* name) {
        auto* button = new QToolButton(this);
        button->setObjectName(QStringLiteral("button:") + QLatin1String(name));
        button->setDefaultAction(actions_.value(QLatin1String(name)));
        button->setToolButtonStyle(Qt::ToolButtonIconOnly);
        button->setAutoRaise(true);
        button->setAccessibleName(button->defaultAction()->iconText());
        row->addWidget(button);
        return button;
    };
    add_button_ = add_button("add");
    for (const char* name : {"duplicate", "rename", "up", "down", "remove"}) add_button(name);
    return row;
}

QString ProjectPanel::why_not(const QString& action) const {
    if (!has_project_) return tr("No project is open.");
    if (read_only_) return why_read_only_;
    if (action == QLatin1String("add")) return {};
    const ItemRef item = selected();
    if (!item.is_valid()) return tr("Select an item first.");
    if (action == QLatin1String("rename"))
        return item.index < 0 ? QString() : tr("A %1 has no name of its own.").arg(kind_word(item.kind));
    if (item.kind == ItemKind::project) return tr("That is the project itself.");
    const QModelIndex index = model_->index_of(item);
    const int count = model_->rowCount(index.parent());
    if (action == QLatin1String("up") && index.row() == 0) return tr("It is the first already.");
    if (action == QLatin1String("down") && index.row() == count - 1) return tr("It is the last already.");
    if (action == QLatin1String("remove") && item.kind == ItemKind::part && count == 1)
        return tr("A scene needs at least one file; remove the scene instead.");
    return {};
}

void ProjectPanel::update_actions() {
    for (auto* action : std::as_const(actions_)) {
        const QString reason = why_not(action->objectName());
        const QString tip = action->property("tip").toString();
        action->setEnabled(reason.isEmpty());
        action->setToolTip(
            reason.isEmpty() ? tip
                             : QStringLiteral("<p>%1</p><p><i>%2</i></p>").arg(tip, reason.toHtmlEscaped()));
    }
}

void ProjectPanel::show_menu(const QPoint& position) {
    QMenu menu(this);
    const ItemKind kind = model_->kind(filter_->mapToSource(view_->indexAt(position)));
    fill_add_menu();
    if (selected().is_valid() && kind != ItemKind::none) {
        for (const char* name : {"rename", "duplicate", "up", "down", "remove"})
            menu.addAction(actions_.value(QLatin1String(name)));
        menu.addSeparator();
        emit menu_opening(selected(), &menu);
    }
    if (actions_.value(QStringLiteral("add"))->isEnabled()) {
        const auto entries = add_menu_->actions();
        for (auto* entry : entries)
            if (entry->data().toInt() == int(kind) || kind == ItemKind::none || kind == ItemKind::project)
                menu.addAction(entry);
        const ItemRef owner = selected().owner();
        for (auto* entry : entries)  // what the scene or set itself may hold more of
            if (owner.kind != kind && entry->data().toInt() == int(owner.kind)) menu.addAction(entry);
        for (auto* entry : entries) {
            const bool is_part = entry->data().toInt() == int(ItemKind::part) && kind == ItemKind::scene;
            const bool is_light =
                entry->data().toInt() == int(ItemKind::light) && kind == ItemKind::light_set;
            if ((is_part || is_light) && selected().is_valid()) menu.addAction(entry);
        }
    }
    if (!menu.isEmpty()) menu.exec(view_->viewport()->mapToGlobal(position));
}

void ProjectPanel::show_add_menu() {
    add_menu_->popup(add_button_->mapToGlobal(add_button_->rect().bottomLeft()));
}

void ProjectPanel::fill_add_menu() {
    add_menu_->clear();
    const auto entry = [this](ItemKind kind, const QString& text, const char* drawing,
                              std::function<void()> run) {
        auto* action = add_menu_->addAction(icon(drawing), text);
        action->setData(int(kind));
        action->setObjectName(QStringLiteral("add:") + kind_word(kind));
        connect(action, &QAction::triggered, this, [run = std::move(run)] { run(); });
    };
    const auto ask = [this](ItemKind kind, const ItemRef& owner = {}) {
        return [this, kind, owner] {
            select_new_ = true;
            emit add_wanted(kind, owner);
            select_new_ = false;
        };
    };
    entry(ItemKind::experiment, tr("Experiment …"), "experiment", ask(ItemKind::experiment));
    entry(ItemKind::comparison, tr("Comparison"), "comparison",
          [this] { edit(makers::add_comparison(), true); });
    entry(ItemKind::scene, tr("Scene …"), "scene", ask(ItemKind::scene));
    entry(ItemKind::camera, tr("Camera from the view"), "camera", ask(ItemKind::camera));
    entry(ItemKind::light_set, tr("Set of lights"), "lights",
          [this] { edit(makers::add_light_set(), true); });
    entry(ItemKind::image, tr("Foreign image …"), "image", ask(ItemKind::image));
    const ItemRef owner = selected().owner();
    const auto chosen = [owner](ItemKind kind) {
        return owner.kind == kind ? owner.id.toStdString() : std::string();
    };
    entry(ItemKind::motion, tr("Motion of a camera"), "motion",
          [=, this] { edit(makers::add_motion(chosen(ItemKind::camera)), true); });
    const int index = std::max(0, selected().index);
    entry(ItemKind::motion, tr("Motion of a light"), "motion",
          [=, this] { edit(makers::add_light_motion(chosen(ItemKind::light_set), index), true); });
    entry(ItemKind::motion, tr("Motion of a file of a scene"), "motion",
          [=, this] { edit(makers::add_part_motion(chosen(ItemKind::scene), index), true); });
    entry(ItemKind::sweep, tr("Sweep"), "sweep",
          [=, this] { edit(makers::add_sweep(chosen(ItemKind::experiment)), true); });
    entry(ItemKind::plot, tr("Plot of the error"), "plot",
          [=, this] { edit(makers::add_plot(chosen(ItemKind::experiment)), true); });
    for (const auto& kind : projects::analysis_kinds())
        entry(ItemKind::analysis, tr("Analysis: %1").arg(QString::fromStdString(kind.label).toLower()),
              "analysis", [=, this, key = kind.key] {
                  edit(makers::add_analysis(*registry_, key, chosen(ItemKind::experiment)), true);
              });
    if (owner.kind == ItemKind::scene)
        entry(ItemKind::part, tr("File to this scene …"), "part", ask(ItemKind::part, owner));
    if (owner.kind != ItemKind::light_set) return;
    using Type = projects::LightSpec::Type;
    for (const Type type : {Type::point, Type::spot, Type::directional, Type::rect, Type::disk})
        entry(ItemKind::light, tr("%1 to this set").arg(light_name(type)), "light",
              [this, owner, type] { edit(makers::add_light(owner.id.toStdString(), type), true); });
}

}  // namespace ir::widgets
