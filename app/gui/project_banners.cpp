#include "app/gui/project_banners.h"

#include <QFileDialog>
#include <QMessageBox>
#include <algorithm>

#include "app/gui/dialog_folder.h"
#include "projects/check.h"
#include "projects/scene_files.h"

namespace ir::gui {
namespace {

using Kind = widgets::BannerStack::Kind;

/// What the banner was about is gone by now.
projects::EditPtr no_edit() {
    return nullptr;
}

}  // namespace

ProjectBanners::ProjectBanners(QWidget& window, Session& session, LivePictures& live,
                               widgets::BannerStack& banners)
    : window_(window), session_(session), live_(live), banners_(banners) {
    connect(&session_, &Session::document_changed, this, &ProjectBanners::update_scene);
    connect(&session_, &Session::document_changed, this, &ProjectBanners::update_shaders);
    connect(&session_.files(), &ProjectFiles::files_changed, this, &ProjectBanners::update_scene);
    connect(&session_, &Session::experiment_selected, this, &ProjectBanners::update_picture);
    connect(&live_, &LivePictures::state_changed, this, &ProjectBanners::update_picture);
}

void ProjectBanners::update() {
    for (const char* name : {"read-only", "recovery", "scene", "check", "sample", "shaders-of-others"})
        banners_.hide_banner(QLatin1String(name));
    if (!session_.has_project()) return;
    const auto& project = session_.open_project();
    if (project.is_read_only())
        banners_.show_banner(QStringLiteral("read-only"), Kind::warning,
                             tr("Read-only: %1").arg(QString::fromStdString(project.read_only_reason())),
                             {{tr("Save as …"), [this] { emit save_as_wanted(); }},
                              {tr("Take over …"), [this] { take_over(); }}},
                             false);
    if (project.recovery())
        banners_.show_banner(QStringLiteral("recovery"), Kind::warning,
                             QString::fromStdString(project.recovery()->summary),
                             {{tr("Recover"), [this] { session_.files().take_recovery(), update(); }},
                              {tr("Discard"), [this] { session_.files().discard_recovery(), update(); }}},
                             false);
    update_scene();
    update_shaders();
}

void ProjectBanners::take_over() {
    const auto answer = QMessageBox::question(&window_, tr("Take over"),
                                              tr("Open for writing although another process holds the "
                                                 "project? Its unsaved changes may be lost."));
    if (answer == QMessageBox::Yes) session_.files().break_lock(), update();
}

/// What others have changed in shaders runs where a person allows it.
void ProjectBanners::update_shaders() {
    const auto name = QStringLiteral("shaders-of-others");
    const auto waits = [this](const projects::Experiment& experiment) {
        return !projects::why_shaders_wait(session_.document(), experiment).empty();
    };
    const auto waiting =
        session_.has_project() ? std::ranges::count_if(session_.document().experiments, waits) : 0;
    if (waiting == 0) return banners_.hide_banner(name);
    const auto show = [this, waits] {
        const auto& experiments = session_.document().experiments;
        const auto first = std::ranges::find_if(experiments, waits);
        if (first != experiments.end()) session_.select_experiment(first->id);
        emit shaders_wanted();
    };
    const auto allow = [this] {
        session_.edit([](const projects::Project& project) {
            return projects::edits::set_shaders_allowed(project, true);
        });
        session_.end_gesture();
    };
    banners_.show_banner(
        name, Kind::warning,
        tr("This project comes from somebody else and changes shaders, which run on your "
           "graphics card. Experiments that do (%1) wait until you allow it; the tree marks them.")
            .arg(waiting),
        {{tr("Show"), show}, {tr("Allow"), allow}}, false);
}

/// The first scene of the document that is missing or has changed; missing ones first.
void ProjectBanners::update_scene() {
    banners_.hide_banner(QStringLiteral("scene"));
    if (!session_.has_project()) return;
    const auto& open = session_.open_project();
    for (const auto wanted : {projects::FileState::missing, projects::FileState::changed})
        for (const auto& scene : session_.document().scenes)
            for (std::size_t i = 0; i < scene.parts.size(); ++i) {
                const auto status = projects::status(scene.parts[i], open.folder(), &open.contents());
                if (status.state != wanted) continue;
                const QString source = QString::fromStdString(status.source);
                const auto locate = [this, id = scene.id, i] { locate_scene(id, i); };
                if (wanted == projects::FileState::missing)
                    return banners_.show_banner(
                        QStringLiteral("scene"), Kind::error,
                        tr("The scene %1 is missing. The experiments that use it are kept.").arg(source),
                        {{tr("Locate …"), locate}}, false);
                return banners_.show_banner(
                    QStringLiteral("scene"), Kind::warning,
                    tr("The scene %1 has changed since the project was saved.").arg(source),
                    {{tr("Accept"), [this, id = scene.id] { accept_scene(id); }}, {tr("Locate …"), locate}});
            }
}

void ProjectBanners::locate_scene(const std::string& id, std::size_t part) {
    const QString file =
        QFileDialog::getOpenFileName(&window_, tr("Locate the scene"), dialog_folder(session_),
                                     tr("Scenes (*.gltf *.glb);;All files (*)"));
    if (file.isEmpty()) return;
    remember_folder_of(file);
    session_.edit([&](const projects::Project& project) {
        const auto* scene = projects::find_item(project.scenes, id);
        if (!scene || part >= scene->parts.size()) return no_edit();
        return projects::edits::change(
            project, projects::located(*scene, part, file.toStdString(), session_.open_project().folder()));
    });
    session_.files().look_at_files();
    update_scene();
}

void ProjectBanners::accept_scene(const std::string& id) {
    session_.edit([&](const projects::Project& project) {
        const auto& open = session_.open_project();
        const auto* scene = projects::find_item(project.scenes, id);
        if (!scene) return no_edit();
        return projects::edits::change(
            project, projects::with_current_hashes(*scene, open.folder(), &open.contents()));
    });
    update_scene();
}

void ProjectBanners::update_picture() {
    using State = LivePictures::State;
    const auto* chosen = session_.experiment();
    const auto state = chosen ? live_.state(chosen->id) : State::absent;
    if (state == State::failed || state == State::blocked)
        banners_.show_banner(QStringLiteral("render"), Kind::error,
                             QString::fromStdString(live_.text(chosen->id)));
    else
        banners_.hide_banner(QStringLiteral("render"));
}

}  // namespace ir::gui
