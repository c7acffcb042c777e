#include "app/gui/file_controller.h"

#include <QAction>
#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QMenu>
#include <QMessageBox>
#include <optional>

#include "app/gui/card_picture.h"
#include "app/gui/dialog_folder.h"
#include "app/gui/exports.h"
#include "app/gui/patient_files.h"
#include "app/gui/text_of.h"
#include "projects/scene_files.h"
#include "projects/store.h"
#include "renderers/core/error.h"
#include "renderers/core/file_system.h"
#include "renderers/core/named_files.h"

namespace ir::gui {
namespace {

using Kind = widgets::BannerStack::Kind;

bool ends_with(const QString& path, std::initializer_list<const char*> suffixes) {
    for (const char* suffix : suffixes)
        if (path.endsWith(QLatin1String(suffix), Qt::CaseInsensitive)) return true;
    return false;
}

bool is_scene_file(const QString& path) {
    return projects::is_gltf_name(path.toStdString());
}

bool is_builtin(const QString& path) {
    return projects::is_builtin(path.toStdString());
}

}  // namespace

FileController::FileController(QWidget& window, Session& session, Workspace& workspace, Notices& notices,
                               widgets::WelcomePage& welcome, Actions& actions, bool remember)
    : window_(window),
      session_(session),
      workspace_(workspace),
      notices_(notices),
      actions_(actions),
      welcome_(welcome),
      recent_(remember),
      samples_(remember),
      recent_menu_(new QMenu(tr("Open recen&t"), &window)) {
    using K = QKeySequence;
    actions_.add("new", tr("&New project from a scene …"), "new", {K(Qt::CTRL | Qt::Key_N)},
                 [this] { new_project(); });
    actions_.add("open", tr("&Open project …"), "open", {K(Qt::CTRL | Qt::Key_O)},
                 [this] { choose_project(); });
    actions_.add("save", tr("&Save"), "save", {K(Qt::CTRL | Qt::Key_S)}, [this] { save(); });
    actions_.add("save-as", tr("Save &as …"), nullptr, {K(Qt::CTRL | Qt::SHIFT | Qt::Key_S)},
                 [this] { save_as(); });
    actions_.add("close", tr("&Close project"), nullptr, {K(Qt::CTRL | Qt::Key_W)}, [this] { close(); });
    actions_.add("quit", tr("&Quit"), nullptr, {K(Qt::CTRL | Qt::Key_Q)}, [this] { window_.close(); });
    follow(session_, this, &FileController::update_actions);
    using Page = widgets::WelcomePage;
    connect(&welcome_, &Page::new_chosen, this, &FileController::new_project);
    connect(&welcome_, &Page::open_chosen, this, &FileController::choose_project);
    connect(&welcome_, &Page::project_chosen, this, &FileController::open);
    connect(&welcome_, &Page::recent_removed, this, [this](const QString& path) {
        recent_.remove(path);
        update_recent();
    });
    const PatientFiles::Silence silence;  // no event finds half a window
    update_recent();
    update_actions();
}

void FileController::update_actions() {
    const bool open = session_.has_project();
    const auto* project = open ? &session_.open_project() : nullptr;
    actions_.enable("save",
                    open && !project->is_read_only() && (project->is_dirty() || project->folder().empty()));
    actions_.enable("save-as close", open);
}

bool FileController::open(const QString& path) {
    std::optional<projects::SampleCopy> copy;
    const bool is_scene = is_builtin(path) || is_scene_file(path);
    const auto work = [&] {
        const std::string text = path.toStdString();
        if (is_scene) return session_.files().create_from_scene(text);
        if (Samples::contains(text)) copy = samples_.copy(text);
        session_.files().open(copy ? copy->folder : std::filesystem::path(text));
    };
    if (!notices_.attempt(work, tr("Cannot open"))) return false;
    if (!copy && !is_builtin(path)) remember_folder_of(path);
    if (copy) say_copy(path, *copy);
    if (is_scene) return true;
    recent_.add(QString::fromStdString(session_.open_project().folder().string()));
    update_recent();
    return true;
}

void FileController::take(const QString& file) {
    const bool writable = session_.has_project() && !session_.open_project().is_read_only();
    const std::string path = file.toStdString();
    if (writable && is_scene_file(file))
        notices_.attempt([&] { session_.files().add_scene(path); }, tr("Add scene"));
    else if (writable && ends_with(file, {".exr", ".png", ".hdr", ".jpg", ".jpeg", ".tif", ".tiff"}))
        notices_.attempt([&] { session_.files().add_image(path); }, tr("Add image"));
    else
        go_to(file);
}

void FileController::go_to(const QString& path) {
    if (may_discard()) open(path);
}

void FileController::say_copy(const QString& sample, const projects::SampleCopy& copy) {
    const auto folder = QString::fromStdString(copy.folder.string());
    if (!copy.is_changed) {
        const auto text = tr("Opened a copy of the sample, %1; the sample stays as it is.").arg(folder);
        notices_.add({Severity::note, "project", text.toStdString()});
        return notices_.say(text);
    }
    const auto text = tr("This is your copy of the sample, as you left it: %1.").arg(folder);
    const auto newer = copy.is_outdated ? tr(" The sample itself has changed since.") : QString();
    notices_.banners().show_banner(QStringLiteral("sample"), Kind::note, text + newer,
                                   {{tr("Begin afresh"), [=, this] { begin_sample_afresh(sample, copy); }}});
}

/// The copy that somebody worked on stays, under another name.
void FileController::begin_sample_afresh(const QString& sample, const projects::SampleCopy& copy) {
    if (!may_discard()) return;
    QString aside;
    const auto put_aside = [&] { aside = QString::fromStdString(session_.files().put_aside(copy).string()); };
    if (!notices_.attempt(put_aside, tr("Cannot begin afresh"))) return;
    recent_.add(aside);
    if (open(sample)) notices_.say(tr("What you had is kept in %1").arg(aside));
}

void FileController::new_project() {
    if (!may_discard()) return;
    const QString file =
        QFileDialog::getOpenFileName(&window_, tr("New project from a scene"), dialog_folder(session_),
                                     tr("Scenes (*.gltf *.glb);;All files (*)"));
    if (!file.isEmpty()) open(file);
}

void FileController::choose_project() {
    if (!may_discard()) return;
    const QString folder = QFileDialog::getExistingDirectory(
        &window_, tr("Open a project: choose a folder NAME.interreflect"), dialog_folder(session_));
    if (!folder.isEmpty()) open(folder);
}

bool FileController::save() {
    if (!session_.has_project()) return false;
    emit ending();
    if (session_.open_project().folder().empty()) return save_as();
    bool overwriting_helps = false;  // a full disk or a missing right stays what it is
    const auto work = [&] {
        try {
            session_.files().save();
        } catch (const projects::ChangedOnDisk&) {
            overwriting_helps = true;
            throw;
        }
    };
    if (notices_.attempt(work, tr("Cannot save"))) {
        show_as_saved(save_thumbnail());
        notices_.say(tr("Saved %1").arg(QString::fromStdString(session_.open_project().folder().string())));
        return true;
    }
    const auto overwrite = [this] {
        if (notices_.attempt([this] { session_.files().save(true); }, tr("Cannot save")))
            show_as_saved(save_thumbnail());
    };
    std::vector<widgets::BannerStack::Action> ways{{tr("Save as …"), [this] { save_as(); }}};
    if (overwriting_helps) ways.push_back({tr("Overwrite"), overwrite});
    auto& banners = notices_.banners();
    banners.show_banner(QStringLiteral("file"), Kind::error, banners.text(QStringLiteral("file")), ways);
    return false;
}

bool FileController::save_as() {
    if (!session_.has_project()) return false;
    emit ending();
    QString proposal = dialog_folder(session_);
    if (session_.open_project().folder().empty()) {
        const auto name = clean_file_name(QString::fromStdString(session_.document().name));
        const auto file = QDir(proposal).filePath(name + QLatin1String(projects::folder_suffix));
        if (!QFileInfo::exists(file)) proposal = file;  // a folder would be entered
    }
    QString path = QFileDialog::getSaveFileName(&window_, tr("Save the project as"), proposal,
                                                tr("Projects (*.interreflect)"), nullptr,
                                                QFileDialog::DontConfirmOverwrite);
    if (path.isEmpty()) return false;
    path = QString::fromStdString(projects::folder_with_suffix(path.toStdString()).string());
    if (QFileInfo::exists(path) &&
        QMessageBox::question(&window_, tr("Save as"),
                              tr("%1 exists. Replace the project in it?").arg(path)) != QMessageBox::Yes)
        return false;
    if (!notices_.attempt([&] { session_.files().save_as(path.toStdString()); }, tr("Cannot save")))
        return false;
    remember_folder_of(path);
    save_thumbnail();
    recent_.add(path);
    update_recent();
    return true;
}

void FileController::close() {
    emit ending();
    if (may_discard()) session_.files().close();
}

bool FileController::may_discard() {
    session_.camera().finish_move();
    if (!session_.has_project() || !session_.open_project().is_dirty() ||
        session_.open_project().is_read_only())
        return true;
    const auto answer = QMessageBox::question(
        &window_, tr("Unsaved changes"),
        tr("Save the changes to “%1” first?").arg(QString::fromStdString(session_.document().name)),
        QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel);
    if (answer == QMessageBox::Save) return save();
    return answer == QMessageBox::Discard;
}

/// The picture by which the project is known on the start page; null: it stays the one before.
QImage FileController::save_thumbnail() {
    const auto shown = workspace_.active_pane().picture_at(0);
    if (shown && !shown->draft.isEmpty()) return {};
    const QImage picture = picture_of(workspace_.active_pane());
    if (picture.isNull()) return {};
    const auto folder = session_.open_project().folder();
    const auto name = thumbnail_file(QString::fromStdString(folder.string()));
    try {
        const auto small = picture.scaled(largest_thumbnail, Qt::KeepAspectRatio, Qt::SmoothTransformation);
        const auto bytes = encoded(small, name);
        patient_files().wait_for([&] {
            const std::filesystem::path file = name.toStdString();
            if (!lies_within(file.parent_path(), folder)) return;  // somebody else's link
            auto& files = real_file_system();
            files.create_directories(file.parent_path());
            write_atomically(files, file, {bytes.constData(), std::size_t(bytes.size())});
        });
        return small;
    } catch (const Error&) {
        return {};  // nothing of value is lost with it
    }
}

/// On the start page, without looking at the disk again: it may be slow.
void FileController::show_as_saved(const QImage& thumbnail) {
    const auto path = QString::fromStdString(session_.open_project().folder().string());
    for (auto& each : listed_)
        if (each.path == path) {
            each.name = QString::fromStdString(session_.document().name);
            each.when = QDateTime::currentDateTime();
            each.missing = false;
            if (!thumbnail.isNull()) each.thumbnail = thumbnail;
        }
    welcome_.set_recent(listed_);
}

void FileController::update_recent() {
    std::vector<widgets::RecentProject> listed;
    std::vector<widgets::SampleProject> samples;
    QStringList paths;
    patient_files().wait_for([&] {
        listed = recent_.all();
        samples = samples_.all();
        paths = recent_.paths();
    });
    listed_ = std::move(listed);
    recent_menu_->clear();
    for (const QString& path : paths)
        recent_menu_->addAction(in_menu(path), this, [this, path] { go_to(path); });
    recent_menu_->setEnabled(!recent_menu_->isEmpty());
    welcome_.set_recent(listed_);
    welcome_.set_samples(samples);
}

}  // namespace ir::gui
