#include "app/gui/document_dock.h"

#include <QCoreApplication>
#include <QFileDialog>
#include <QFileInfo>
#include <QSplitter>
#include <QStandardPaths>
#include <QVBoxLayout>

#include "app/engine/camera_pose.h"
#include "app/gui/dialog_folder.h"
#include "app/gui/text_of.h"
#include "projects/scene_files.h"
#include "widgets/document/makers.h"

namespace ir::gui {
namespace {

namespace edits = projects::edits;
using projects::Project;
using widgets::ItemKind;
using widgets::ItemRef;

const char* scene_filter = QT_TRANSLATE_NOOP("ir::gui::DocumentDock", "Scenes (*.gltf *.glb);;All files (*)");
const char* image_filter = QT_TRANSLATE_NOOP(
    "ir::gui::DocumentDock", "Images (*.exr *.hdr *.png *.jpg *.jpeg *.tif *.tiff);;All files (*)");

/// The command line that belongs to this program, as a terminal finds it.
QString command_line_program() {
    const auto name = QStringLiteral("interreflect-cli");
    const QFileInfo beside(QCoreApplication::applicationDirPath() + QLatin1Char('/') + name);
    const QFileInfo found(QStandardPaths::findExecutable(name));
    return !beside.exists() || found == beside ? name : beside.absoluteFilePath();
}

}  // namespace

DocumentDock::DocumentDock(Session& session, SceneShelf& scenes, Workspace& workspace, QWidget* parent)
    : QWidget(parent),
      session_(session),
      scenes_(scenes),
      workspace_(workspace),
      tree_(new widgets::ProjectPanel),
      editor_(new widgets::ItemEditor) {
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    auto* split = new QSplitter(Qt::Vertical);
    split->addWidget(tree_);
    split->addWidget(editor_);
    split->setSizes({1, 1});
    column->addWidget(split);
    std::vector<widgets::Option> modes;
    for (const auto mode : widgets::all_modes())
        if (widgets::compares(mode))
            modes.push_back({text_of(widgets::to_key(mode)), widgets::mode_name(mode), {}});
    editor_->set_comparison_modes(modes);
    editor_->set_view_pose([this] { return session_.camera().pose(); });
    connect_panels();
    connect(&session_, &Session::document_changed, this, &DocumentDock::update_document);
    connect(&session_, &Session::project_replaced, this, &DocumentDock::update_document);
    connect(&session_, &Session::experiment_selected, this, [this] {
        if (const auto* chosen = session_.experiment()) tree_->set_current_experiment(text_of(chosen->id));
    });
    connect(&session_.files(), &ProjectFiles::files_changed, this, &DocumentDock::update_files);
    connect(&scenes_, &SceneShelf::changed, this, &DocumentDock::update_facts);
}

void DocumentDock::connect_panels() {
    const auto edit = [this](const widgets::EditMaker& make) { session_.edit(make); };
    const auto finish = [this] { session_.end_gesture(); };
    connect(tree_, &widgets::ProjectPanel::edit_wanted, this, edit);
    connect(tree_, &widgets::ProjectPanel::gesture_finished, this, finish);
    connect(editor_, &widgets::ItemEditor::edit_wanted, this, edit);
    connect(editor_, &widgets::ItemEditor::gesture_finished, this, finish);
    connect(tree_, &widgets::ProjectPanel::item_selected, editor_, &widgets::ItemEditor::show_item);
    connect(tree_, &widgets::ProjectPanel::item_activated, this, &DocumentDock::activate);
    connect(tree_, &widgets::ProjectPanel::add_wanted, this, &DocumentDock::add);
    connect(editor_, &widgets::ItemEditor::browse_wanted, this, &DocumentDock::browse);
    connect(editor_, &widgets::ItemEditor::add_wanted, this, &DocumentDock::add);
}

void DocumentDock::update_document() {
    setEnabled(session_.has_project());
    if (!session_.has_project()) {
        tree_->clear();
        return editor_->clear();
    }
    const auto& open = session_.open_project();
    const auto why = read_only_text(open);
    tree_->set_project(session_.document(), session_.registry(), open.is_read_only(), why);
    editor_->set_project(session_.document(), session_.registry(), open.is_read_only(), why);
    editor_->set_command_line({command_line_program(), text_of(open.folder().string()), !open.is_dirty()});
    if (const auto* chosen = session_.experiment()) tree_->set_current_experiment(text_of(chosen->id));
    update_files();
}

void DocumentDock::update_files() {
    if (!session_.has_project()) return;
    const auto& open = session_.open_project();
    QSet<QString> stale;
    for (const auto& id : open.stale_experiments()) stale.insert(text_of(id));
    tree_->set_stale(stale);
    QHash<QString, QString> problems;
    const auto look = [&](const ItemRef& item, const projects::FileStatus& status) {
        if (status.state == projects::FileState::missing)
            problems.insert(item.key(), tr("%1 is missing").arg(text_of(status.source)));
        if (status.state == projects::FileState::changed)
            problems.insert(item.key(), tr("%1 has changed").arg(text_of(status.source)));
    };
    for (const auto& scene : session_.document().scenes)
        for (std::size_t i = 0; i < scene.parts.size(); ++i)
            look({ItemKind::part, text_of(scene.id), int(i)},
                 projects::status(scene.parts[i], open.folder(), &open.contents()));
    for (const auto& image : session_.document().images)
        look({ItemKind::image, text_of(image.id)}, projects::status(image, open.folder(), &open.contents()));
    tree_->set_problems(problems);
}

void DocumentDock::update_facts() {
    widgets::SceneFacts facts;
    const auto* chosen = session_.experiment();
    const auto* summary = scenes_.current();
    if (chosen && summary) {
        facts.scene = text_of(chosen->scene);
        for (const auto& camera : summary->camera_values) {
            facts.cameras << text_of(camera.name);
            facts.poses.emplace(text_of(camera.name), engine::pose_of(camera));
        }
        for (const auto& variants : summary->variants) {
            auto& names = facts.variants.emplace_back();
            for (const auto& name : variants) names << text_of(name);
        }
        std::vector<widgets::MaterialFacts> materials;
        for (const auto& name : summary->materials) materials.push_back({text_of(name)});
        facts.materials.assign(scenes_.parts().size(), materials);
    }
    editor_->set_scene_facts(facts);
}

void DocumentDock::activate(const ItemRef& item) {
    const auto id = item.id.toStdString();
    switch (item.kind) {
        case ItemKind::experiment:
            workspace_.views().show_owner(id);
            return session_.select_experiment(id);
        case ItemKind::image:
            return workspace_.views().show_owner("image:" + id);
        case ItemKind::comparison:
            if (const auto* comparison = projects::find_item(session_.document().comparisons, id))
                workspace_.open_comparison(*comparison);
            return;
        default:
            return use_in_experiment(item);
    }
}

/// Looks through this camera, lights with this set, goes to this scene.
void DocumentDock::use_in_experiment(const ItemRef& item) {
    const auto* chosen = session_.experiment();
    if (!chosen) return;
    const std::string experiment = chosen->id, id = item.owner().id.toStdString();
    session_.edit([&](const Project& project) {
        switch (item.kind) {
            case ItemKind::camera:
                return edits::set_camera_of(project, experiment, id);
            case ItemKind::light_set:
            case ItemKind::light:
                return edits::set_lights_of(project, experiment, id);
            case ItemKind::scene:
            case ItemKind::part:
                return edits::set_scene_of(project, experiment, id);
            default:
                return projects::EditPtr();
        }
    });
}

std::string DocumentDock::source_of(const std::string& file) const {
    return projects::is_builtin(file) ? file
                                      : projects::relative_source(file, session_.open_project().folder());
}

std::string DocumentDock::choose_scene_file() {
    const QString file =
        QFileDialog::getOpenFileName(this, tr("Choose a scene"), dialog_folder(session_), tr(scene_filter));
    remember_folder_of(file);
    return file.toStdString();
}

std::string DocumentDock::choose_image_file(const QString& title) {
    const QString file = QFileDialog::getOpenFileName(this, title, dialog_folder(session_), tr(image_filter));
    remember_folder_of(file);
    return file.toStdString();
}

void DocumentDock::add_scene() {
    const auto file = choose_scene_file();
    if (!file.empty()) session_.files().add_scene(file);
}

void DocumentDock::add_image() {
    const auto file = choose_image_file(tr("Add an image of another renderer"));
    if (file.empty()) return;
    if (session_.files().add_image(file))
        select({ItemKind::image, text_of(session_.document().images.back().id)});
}

void DocumentDock::add_comparison() {
    auto comparison = workspace_.as_comparison();
    const bool added = session_.edit([&](const Project& project) {
        comparison.id = projects::free_id_in(project.comparisons, "comparison");
        return edits::add(project, comparison);
    });
    if (added) select({ItemKind::comparison, text_of(comparison.id)});
}

void DocumentDock::add_experiment() {
    const auto* method = session_.method();
    if (!method) method = session_.first_method();
    if (!method) return;
    const auto* now = session_.experiment();
    std::string added;
    const bool is_added = session_.edit([&](const Project& project) {
        const std::string scene = now ? now->scene : project.scenes.empty() ? "" : project.scenes.front().id;
        auto fresh = edits::new_experiment(project, session_.registry(), method->id, "", scene,
                                           now ? now->camera : "");
        if (now) fresh.lights = now->lights;
        added = fresh.id;
        return edits::add(project, fresh);
    });
    if (is_added) session_.select_experiment(added);
}

void DocumentDock::add(ItemKind kind, const ItemRef& owner) {
    switch (kind) {
        case ItemKind::scene:
            return add_scene();
        case ItemKind::part:
            if (const auto file = choose_scene_file(); !file.empty())
                session_.edit([&](const Project& project) {
                    return widgets::makers::add_part(owner.id.toStdString(), source_of(file))(project);
                });
            return;
        case ItemKind::camera:
            return session_.camera().bookmark();
        case ItemKind::experiment:
            return add_experiment();
        case ItemKind::image:
            return add_image();
        default:
            return;
    }
}

void DocumentDock::browse(const ItemRef& item) {
    const auto id = item.id.toStdString();
    if (item.kind == ItemKind::part) {
        if (const auto file = choose_scene_file(); !file.empty())
            session_.edit([&](const Project& project) {
                return widgets::makers::set_part_source(id, item.index, source_of(file))(project);
            });
    } else if (item.kind == ItemKind::image) {
        if (const auto file = choose_image_file(tr("Choose an image")); !file.empty())
            session_.edit([&](const Project& project) {
                return widgets::makers::set_image_source(id, source_of(file))(project);
            });
    } else if (item.kind == ItemKind::light_set) {
        if (const auto file = choose_image_file(tr("Choose an environment map")); !file.empty())
            session_.edit([&](const Project& project) {
                return widgets::makers::set_environment_map(id, source_of(file))(project);
            });
    }
}

}  // namespace ir::gui
