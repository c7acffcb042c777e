#include "app/gui/finder.h"

#include <QAction>
#include <QDockWidget>
#include <QMenu>
#include <QPointer>
#include <QToolButton>
#include <algorithm>
#include <memory>

#include "app/gui/text_of.h"
#include "renderers/core/resources_path.h"
#include "renderers/scene/builtin/registry.h"
#include "widgets/document/project_nodes.h"
#include "widgets/models/report_rows.h"
#include "widgets/panels/action_text.h"
#include "widgets/panels/manual_window.h"
#include "widgets/style/icons.h"

namespace ir::gui {

using widgets::Findable;
using widgets::ItemKind;

Finder::Finder(QWidget& window, Session& session, const SceneShelf& scenes, Workspace& workspace,
               DocumentDock& document, ParameterDock& parameters, DockLayout& docks,
               LayoutController& layouts, FileController& files, Actions& actions)
    : window_(window),
      session_(session),
      scenes_(scenes),
      workspace_(workspace),
      document_(document),
      parameters_(parameters),
      docks_(docks),
      layouts_(layouts),
      files_(files),
      actions_(actions) {
    actions_.add("find", tr("&Find anything …"), nullptr, {QKeySequence(Qt::CTRL | Qt::Key_P)},
                 [this] { open(); });
}

void Finder::open() {
    auto* dialog =
        new widgets::FinderDialog(all(), tr("Find a buffer, a parameter, an action, a sample …"), &window_);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->open();
}

void Finder::show_parameter(const std::string& key) {
    docks_.raise("parameters");
    parameters_.show_parameter(key);
}

void Finder::go_to(const widgets::ItemRef& item) {
    docks_.raise("project");
    document_.select(item);
    document_.tree().activate(item);
}

std::vector<Findable> Finder::all() {
    std::vector<Findable> all;
    if (session_.has_project()) {
        add_buffers(all);
        add_parameters(all);
        add_items(all);
        add_cameras(all);
    }
    add_actions(all);
    add_layouts(all);
    if (session_.has_project()) add_panels(all);
    add_samples(all);
    add_pages(all);
    return all;
}

void Finder::add_buffers(std::vector<Findable>& all) {
    auto& views = workspace_.views();
    const auto& pictures = views.pictures();
    const auto owner = views.active_state().a.owner;
    for (const auto& output : pictures.outputs(owner)) {
        const auto key = text_of(output.key);
        all.push_back({tr("Buffer"), output.label, output.group, key + QLatin1Char('\n') + output.doc});
        all.back().icon = widgets::icon(widgets::sign_of(output.kind));
        all.back().picture = [this, owner, key = output.key] { return workspace_.thumbnail({owner, key}); };
        all.back().go = [this, key = output.key] { workspace_.views().show_output(key); };
    }
}

void Finder::add_parameters(std::vector<Findable>& all) {
    const auto* method = session_.method();
    if (!method) return;
    for (const auto& parameter : method->parameters) {
        all.push_back(
            {tr("Parameter"), text_of(parameter.label), text_of(parameter.key), text_of(parameter.doc)});
        all.back().icon = widgets::icon("parameter");
        all.back().go = [this, key = parameter.key] { show_parameter(key); };
    }
}

void Finder::add_items(std::vector<Findable>& all) {
    const auto nodes = widgets::project_nodes(session_.document(), session_.registry());
    for (const auto& group : nodes->children)
        for (const auto& node : group->children) {
            if (!node->item.is_valid()) continue;
            auto kind = widgets::kind_word(node->item.kind);
            kind[0] = kind[0].toUpper();
            all.push_back({kind, node->name, node->detail, node->tooltip});
            if (node->icon) all.back().icon = widgets::icon(node->icon);
            all.back().go = [this, item = node->item] { go_to(item); };
        }
}

/// Of the scene's file; those that an item of the project stands for are found as that item.
void Finder::add_cameras(std::vector<Findable>& all) {
    const auto* scene = scenes_.current();
    if (!scene) return;
    for (const auto& name : scene->cameras) {
        const auto& items = session_.document().cameras;
        if (std::ranges::any_of(items, [&](const auto& item) { return item.scene_camera == name; })) continue;
        all.push_back({tr("Camera"), text_of(name), tr("the scene's file"), tr("Looks through it")});
        all.back().icon = widgets::icon("camera");
        if (session_.open_project().is_read_only())
            all.back().why_not = read_only_text(session_.open_project());
        all.back().go = [this, name] {
            docks_.raise("parameters");
            parameters_.use_scene_camera(text_of(name));
        };
    }
}

void Finder::run_once_seen(const QString& panel, const std::function<void()>& run) {
    const auto waiting = std::make_shared<QMetaObject::Connection>();
    *waiting = connect(&docks_, &DockLayout::seen_changed, this, [this, panel, run, waiting] {
        if (!docks_.is_seen(panel)) return;
        disconnect(*waiting);
        run();
    });
    docks_.raise(panel);
}

/// What buttons of panels do, and what the menus of such buttons hold.
void Finder::add_panels(std::vector<Findable>& all) {
    const auto add = [&](const QDockWidget& dock, const QString& name, const QIcon& icon, const QString& also,
                         bool can_do, std::function<void()> run) {
        Findable found{tr("Action"), name, dock.windowTitle(), also};
        found.icon = icon.isNull() ? widgets::icon("action") : icon;
        // What is not seen is not kept up to date: it is asked once it is.
        const bool is_seen = docks_.is_seen(dock.objectName());
        if (is_seen && !can_do) found.why_not = tr("cannot be done now");
        found.go = [this, panel = dock.objectName(), is_seen, run = std::move(run)] {
            is_seen ? run() : run_once_seen(panel, run);
        };
        all.push_back(std::move(found));
    };
    for (const auto* dock : window_.findChildren<QDockWidget*>()) {
        if (!dock->widget()) continue;
        for (auto* button : widgets::actions_in(*dock->widget())) {
            const auto* menu = button->menu();
            if (!menu || menu->isEmpty())
                add(*dock, button->text(), button->icon(), button->toolTip(), button->isEnabled(),
                    [button = QPointer(button)] {
                        if (!button || !button->isEnabled()) return;
                        if (auto* filled = button->menu())
                            filled->popup(button->mapToGlobal(button->rect().bottomLeft()));
                        else
                            button->click();
                    });
            else
                for (auto* action : menu->actions())
                    if (!action->isSeparator() && !action->isCheckable() && !action->menu())
                        add(*dock,
                            QStringLiteral("%1: %2").arg(button->text(), widgets::plain_text(action->text())),
                            action->icon().isNull() ? button->icon() : action->icon(), action->toolTip(),
                            button->isEnabled() && action->isEnabled(), [action = QPointer(action)] {
                                if (action) action->trigger();
                            });
        }
    }
}

void Finder::add_actions(std::vector<Findable>& all) {
    for (auto* action : actions_.in_order()) {
        if (action->objectName() == QLatin1String("find")) continue;
        Findable found{tr("Action"), widgets::plain_text(action->text()), widgets::menu_title(*action),
                       action->toolTip(), widgets::keys_of(*action)};
        found.icon = action->icon().isNull() ? widgets::icon("action") : action->icon();
        if (!action->isEnabled()) found.why_not = tr("cannot be done now");
        found.go = [action] { action->trigger(); };
        all.push_back(std::move(found));
    }
}

/// A person's own; those of the program are actions.
void Finder::add_layouts(std::vector<Findable>& all) {
    for (const auto& name : layouts_.names()) {
        all.push_back({tr("Layout"), name, tr("your own")});
        all.back().icon = widgets::icon("views-4");
        all.back().go = [this, name] { layouts_.apply(name); };
    }
}

void Finder::add_samples(std::vector<Findable>& all) {
    for (const auto& scene : scene::builtin::descriptions()) {
        const auto source = QStringLiteral("builtin:") + text_of(scene.name);
        all.push_back({tr("Scene"), source, tr("new project"), text_of(scene.doc)});
        all.back().icon = widgets::icon("scene");
        all.back().go = [this, source] { files_.go_to(source); };
    }
    for (const auto& sample : files_.samples()) {
        all.push_back({tr("Sample"), sample.name, sample.group, sample.description});
        all.back().icon = widgets::icon("open");
        all.back().go = [this, path = sample.path] { files_.go_to(path); };
    }
}

void Finder::add_pages(std::vector<Findable>& all) {
    for (const auto& page : widgets::manual_pages(text_of(data_directory().string()))) {
        all.push_back({tr("Manual"), page.title, page.place, page.headings});
        all.back().icon = widgets::icon("part");
        all.back().go = [this, file = page.file] { emit page_wanted(file); };
    }
}

}  // namespace ir::gui
