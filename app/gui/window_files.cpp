#include <QFileDialog>
#include <QFileInfo>
#include <QMenu>
#include <QMessageBox>
#include <QStackedWidget>

#include "app/gui/main_window.h"
#include "projects/scene_files.h"
#include "projects/store.h"
#include "renderers/core/resources_path.h"

namespace ir::gui {
namespace {

constexpr int recent_limit = 10;
using Kind = widgets::BannerStack::Kind;

bool is_scene(const QString& path) {
    return path.startsWith(QStringLiteral("builtin:")) ||
           path.endsWith(QStringLiteral(".gltf"), Qt::CaseInsensitive) ||
           path.endsWith(QStringLiteral(".glb"), Qt::CaseInsensitive);
}

QStringList sample_projects() {
    QStringList result;
    try {
        for (const auto& entry : std::filesystem::directory_iterator(data_directory() / "samples"))
            if (entry.path().extension() == projects::folder_suffix)
                result << QString::fromStdString(entry.path().string());
    } catch (const std::exception&) {
        return {};  // an installation without samples: the page says so
    }
    result.sort();
    return result;
}

}  // namespace

bool MainWindow::run_file_step(const std::function<void()>& work, const QString& what) {
    try {
        work();
        banners_->hide_banner(QStringLiteral("file"));
        return true;
    } catch (const std::exception& error) {
        const QString line = QString::fromUtf8(error.what());
        messages_->add({Severity::error, "project", error.what()});
        banners_->show_banner(QStringLiteral("file"), Kind::error, QStringLiteral("%1: %2").arg(what, line));
        return false;
    }
}

bool MainWindow::open_path(const QString& path) {
    const bool opened = run_file_step(
        [&] {
            store_view_memory();
            const std::string text = path.toStdString();
            is_scene(path) ? session_.create_from_scene(text) : session_.open(text);
        },
        tr("Cannot open"));
    if (opened && !is_scene(path))
        add_recent(QString::fromStdString(session_.open_project().folder().string()));
    return opened;
}

void MainWindow::new_project() {
    if (!may_discard()) return;
    const QString file = QFileDialog::getOpenFileName(this, tr("New project from a scene"), {},
                                                      tr("Scenes (*.gltf *.glb);;All files (*)"));
    if (!file.isEmpty()) open_path(file);
}

void MainWindow::choose_project() {
    if (!may_discard()) return;
    const QString folder =
        QFileDialog::getExistingDirectory(this, tr("Open a project: choose a folder NAME.interreflect"));
    if (!folder.isEmpty()) open_path(folder);
}

bool MainWindow::save() {
    if (!session_.has_project()) return false;
    if (session_.open_project().folder().empty()) return save_as();
    store_view_memory();
    const bool saved = run_file_step([this] { session_.save(); }, tr("Cannot save"));
    if (saved) return true;
    banners_->show_banner(
        QStringLiteral("file"), Kind::error, banners_->text(QStringLiteral("file")),
        {{tr("Save as …"), [this] { save_as(); }},
         {tr("Overwrite"), [this] { run_file_step([this] { session_.save(true); }, tr("Cannot save")); }}});
    return false;
}

bool MainWindow::save_as() {
    if (!session_.has_project()) return false;
    QString path =
        QFileDialog::getSaveFileName(this, tr("Save the project as"), {}, tr("Projects (*.interreflect)"),
                                     nullptr, QFileDialog::DontConfirmOverwrite);
    if (path.isEmpty()) return false;
    path = QString::fromStdString(projects::folder_with_suffix(path.toStdString()).string());
    if (QFileInfo::exists(path) &&
        QMessageBox::question(this, tr("Save as"), tr("%1 exists. Replace the project in it?").arg(path)) !=
            QMessageBox::Yes)
        return false;
    store_view_memory();
    const bool saved = run_file_step([&] { session_.save_as(path.toStdString()); }, tr("Cannot save"));
    if (saved) add_recent(path);
    return saved;
}

bool MainWindow::may_discard() {
    session_.finish_camera_move();
    if (!session_.has_project() || !session_.open_project().is_dirty() ||
        session_.open_project().is_read_only())
        return true;
    const auto answer =
        QMessageBox::question(this, tr("Unsaved changes"), tr("Save the changes to the project first?"),
                              QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel);
    if (answer == QMessageBox::Save) return save();
    return answer == QMessageBox::Discard;
}

QStringList MainWindow::recent() const {
    return options_.remember ? QSettings().value(QStringLiteral("recent")).toStringList() : QStringList();
}

void MainWindow::add_recent(const QString& path) {
    if (!options_.remember) return;
    QStringList list = recent();
    list.removeAll(path);
    list.prepend(path);
    QSettings().setValue(QStringLiteral("recent"), list.mid(0, recent_limit));
    update_recent();
}

void MainWindow::update_recent() {
    recent_menu_->clear();
    for (const QString& path : recent())
        recent_menu_->addAction(path, this, [this, path] {
            if (may_discard()) open_path(path);
        });
    recent_menu_->setEnabled(!recent_menu_->isEmpty());
    welcome_->set_recent(recent());
    welcome_->set_samples(sample_projects());
}

void MainWindow::update_project_banners() {
    for (const char* name : {"read-only", "recovery", "scene", "check"})
        banners_->hide_banner(QLatin1String(name));
    if (!session_.has_project()) return;
    const auto& project = session_.open_project();
    if (project.is_read_only())
        banners_->show_banner(
            QStringLiteral("read-only"), Kind::warning,
            tr("Read-only: %1").arg(QString::fromStdString(project.read_only_reason())),
            {{tr("Save as …"), [this] { save_as(); }},
             {tr("Take over …"),
              [this] {
                  if (QMessageBox::question(this, tr("Take over"),
                                            tr("Open for writing although another process holds the "
                                               "project? Its unsaved changes may be lost.")) ==
                      QMessageBox::Yes)
                      session_.break_lock(), update_project_banners();
              }}},
            false);
    if (project.recovery())
        banners_->show_banner(
            QStringLiteral("recovery"), Kind::warning, QString::fromStdString(project.recovery()->summary),
            {{tr("Recover"), [this] { session_.take_recovery(), update_project_banners(); }},
             {tr("Discard"), [this] { session_.discard_recovery(), update_project_banners(); }}},
            false);
    update_scene_banner();
}

void MainWindow::update_scene_banner() {
    banners_->hide_banner(QStringLiteral("scene"));
    const auto* experiment = session_.experiment();
    const auto* scene =
        experiment ? projects::find_item(session_.document().scenes, experiment->scene) : nullptr;
    if (!scene) return;
    for (std::size_t i = 0; i < scene->parts.size(); ++i) {
        const auto status = projects::status(scene->parts[i], session_.open_project().folder());
        const QString source = QString::fromStdString(status.source);
        if (status.state == projects::FileState::missing)
            return banners_->show_banner(
                QStringLiteral("scene"), Kind::error,
                tr("The scene %1 is missing. The experiments that use it are kept.").arg(source),
                {{tr("Locate …"), [this, i] { locate_scene(i); }}}, false);
        if (status.state == projects::FileState::changed)
            return banners_->show_banner(
                QStringLiteral("scene"), Kind::warning,
                tr("The scene %1 has changed since the project was saved.").arg(source),
                {{tr("Accept"), [this] { accept_scene(); }},
                 {tr("Locate …"), [this, i] { locate_scene(i); }}});
    }
}

void MainWindow::locate_scene(std::size_t part) {
    const auto* experiment = session_.experiment();
    if (!experiment) return;
    const QString file = QFileDialog::getOpenFileName(this, tr("Locate the scene"), {},
                                                      tr("Scenes (*.gltf *.glb);;All files (*)"));
    if (file.isEmpty()) return;
    session_.edit([&](const projects::Project& project) {
        const auto* scene = projects::find_item(project.scenes, session_.experiment()->scene);
        return projects::edits::change_scene(
            project, projects::located(*scene, part, file.toStdString(), session_.open_project().folder()));
    });
    update_scene_banner();
}

void MainWindow::accept_scene() {
    session_.edit([&](const projects::Project& project) {
        const auto* scene = projects::find_item(project.scenes, session_.experiment()->scene);
        return projects::edits::change_scene(
            project, projects::with_current_hashes(*scene, session_.open_project().folder()));
    });
    update_scene_banner();
}

}  // namespace ir::gui
