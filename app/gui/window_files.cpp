#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QMenu>
#include <QMessageBox>
#include <QStackedWidget>
#include <optional>

#include "app/gui/dialog_folder.h"
#include "app/gui/main_window.h"
#include "app/gui/write_picture.h"
#include "projects/store.h"
#include "renderers/core/error.h"

namespace ir::gui {
namespace {

using Kind = widgets::BannerStack::Kind;

bool is_scene(const QString& path) {
    return path.startsWith(QStringLiteral("builtin:")) ||
           path.endsWith(QStringLiteral(".gltf"), Qt::CaseInsensitive) ||
           path.endsWith(QStringLiteral(".glb"), Qt::CaseInsensitive);
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
    std::optional<projects::SampleCopy> copy;
    const bool opened = run_file_step(
        [&] {
            store_memory();
            const std::string text = path.toStdString();
            if (is_scene(path)) return session_.create_from_scene(text);
            if (Samples::contains(text)) copy = samples_.copy(text);
            session_.open(copy ? copy->folder : std::filesystem::path(text));
        },
        tr("Cannot open"));
    if (!opened) return false;
    if (!copy && !path.startsWith(QStringLiteral("builtin:"))) remember_folder_of(path);
    if (copy) say_copy(path, *copy);
    if (is_scene(path)) return true;
    recent_.add(QString::fromStdString(session_.open_project().folder().string()));
    update_recent();
    return true;
}

void MainWindow::say_copy(const QString& sample, const projects::SampleCopy& copy) {
    const auto folder = QString::fromStdString(copy.folder.string());
    if (!copy.is_changed) {
        const auto text = tr("Opened a copy of the sample, %1; the sample stays as it is.").arg(folder);
        messages_->add({Severity::note, "project", text.toStdString()});
        return status_->say(text);
    }
    const auto text = tr("This is your copy of the sample, as you left it: %1.").arg(folder);
    const auto newer = copy.is_outdated ? tr(" The sample itself has changed since.") : QString();
    banners_->show_banner(QStringLiteral("sample"), Kind::note, text + newer,
                          {{tr("Begin afresh"), [=, this] { begin_sample_afresh(sample, copy); }}});
}

/// The copy that somebody worked on stays, under another name.
void MainWindow::begin_sample_afresh(const QString& sample, const projects::SampleCopy& copy) {
    if (!may_discard()) return;
    QString aside;
    const auto put_aside = [&] { aside = QString::fromStdString(session_.put_aside(copy).string()); };
    if (!run_file_step(put_aside, tr("Cannot begin afresh"))) return;
    recent_.add(aside);
    if (open_path(sample)) status_->say(tr("What you had is kept in %1").arg(aside));
}

void MainWindow::new_project() {
    if (!may_discard()) return;
    const QString file =
        QFileDialog::getOpenFileName(this, tr("New project from a scene"), dialog_folder(session_),
                                     tr("Scenes (*.gltf *.glb);;All files (*)"));
    if (!file.isEmpty()) open_path(file);
}

void MainWindow::choose_project() {
    if (!may_discard()) return;
    const QString folder = QFileDialog::getExistingDirectory(
        this, tr("Open a project: choose a folder NAME.interreflect"), dialog_folder(session_));
    if (!folder.isEmpty()) open_path(folder);
}

bool MainWindow::save() {
    if (!session_.has_project()) return false;
    document_->commit();
    if (session_.open_project().folder().empty()) return save_as();
    store_memory();
    bool overwriting_helps = false;  // a full disk or a missing right stays what it is
    const auto work = [&] {
        try {
            session_.save();
        } catch (const projects::ChangedOnDisk&) {
            overwriting_helps = true;
            throw;
        }
    };
    if (run_file_step(work, tr("Cannot save"))) {
        save_thumbnail();
        status_->say(tr("Saved %1").arg(QString::fromStdString(session_.open_project().folder().string())));
        return true;
    }
    std::vector<widgets::BannerStack::Action> ways{{tr("Save as …"), [this] { save_as(); }}};
    if (overwriting_helps)
        ways.push_back(
            {tr("Overwrite"), [this] { run_file_step([this] { session_.save(true); }, tr("Cannot save")); }});
    banners_->show_banner(QStringLiteral("file"), Kind::error, banners_->text(QStringLiteral("file")), ways);
    return false;
}

bool MainWindow::save_as() {
    if (!session_.has_project()) return false;
    document_->commit();
    QString path = QFileDialog::getSaveFileName(this, tr("Save the project as"), dialog_folder(session_),
                                                tr("Projects (*.interreflect)"), nullptr,
                                                QFileDialog::DontConfirmOverwrite);
    if (path.isEmpty()) return false;
    path = QString::fromStdString(projects::folder_with_suffix(path.toStdString()).string());
    if (QFileInfo::exists(path) &&
        QMessageBox::question(this, tr("Save as"), tr("%1 exists. Replace the project in it?").arg(path)) !=
            QMessageBox::Yes)
        return false;
    store_memory();
    const bool saved = run_file_step([&] { session_.save_as(path.toStdString()); }, tr("Cannot save"));
    if (!saved) return false;
    remember_folder_of(path);
    save_thumbnail();
    recent_.add(path);
    update_recent();
    return true;
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

void MainWindow::store_memory() {
    if (!session_.has_project()) return;
    workspace_.save(session_.memory());
    inspector_.save(session_.memory());
    metrics_.save(session_.memory());
    plots_->save(session_.memory());
    benchmarks_->save(session_.memory());
    playback_.save(session_.memory());
}

/// The picture by which the project is known on the start page.
void MainWindow::save_thumbnail() {
    const QImage picture = workspace_.active_pane().snapshot(false);
    if (picture.isNull()) return;
    const QString file = thumbnail_file(QString::fromStdString(session_.open_project().folder().string()));
    QDir().mkpath(QFileInfo(file).path());
    try {
        write_picture(file, picture.scaledToWidth(thumbnail_width, Qt::SmoothTransformation));
    } catch (const Error&) {
        // Nothing of value is lost with it.
    }
}

void MainWindow::update_recent() {
    recent_menu_->clear();
    for (const QString& path : recent_.paths())
        recent_menu_->addAction(path, this, [this, path] {
            if (may_discard()) open_path(path);
        });
    recent_menu_->setEnabled(!recent_menu_->isEmpty());
    welcome_->set_recent(recent_.all());
    welcome_->set_samples(samples_.all());
}

}  // namespace ir::gui
