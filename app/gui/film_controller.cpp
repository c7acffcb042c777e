#include "app/gui/film_controller.h"

#include <QAction>
#include <QFileDialog>
#include <QFileInfo>
#include <QTemporaryDir>

#include "app/gui/dialog_folder.h"
#include "app/gui/film_dialog.h"
#include "app/gui/text_of.h"
#include "renderers/core/error.h"

namespace ir::gui {
namespace {

/// On a machine that is made for it.
std::vector<Message> make_request(const FilmController::Request& request, const CancelToken& cancel,
                                  const ProgressCallback& progress) {
    engine::Machine machine(request.machine);
    graph::FrameOptions options;
    options.cancel = &cancel;
    options.progress = progress;
    options.memory_budget = request.memory_budget;
    const QTemporaryDir temporary;
    const bool is_video = engine::is_video(request.film.out);
    if (is_video && !temporary.isValid()) throw Error(temporary.errorString().toStdString());
    const auto folder = is_video ? std::filesystem::path(temporary.path().toStdString()) : request.film.out;
    return engine::make_film(machine, {request.project, request.experiment, request.folder}, request.film,
                             folder, options)
        .messages;
}

}  // namespace

FilmController::FilmController(QWidget& window, Session& session, LivePictures& live, Workspace& workspace,
                               const Preferences& preferences, Notices& notices, Actions& actions)
    : QObject(&window),
      window_(window),
      session_(session),
      live_(live),
      workspace_(workspace),
      preferences_(preferences),
      notices_(notices),
      job_(window, notices, tr("Film"), "film"),
      make_(make_request) {
    action_ = actions.add("film", tr("Fil&m …"), nullptr, {QKeySequence(Qt::CTRL | Qt::ALT | Qt::Key_M)},
                          [this] { open(); });
    action_->setData(tr("The experiment as time passes, or as its camera turns: a video or PNG files"));
    follow(session_, this, &FilmController::update);
    connect(&job_, &FileJob::changed, this, &FilmController::update);
    update();
}

void FilmController::update() {
    set_reason(*action_, is_making()              ? tr("A film is being made.")
                         : !session_.experiment() ? tr("There is no experiment to show.")
                                                  : QString());
}

void FilmController::open() {
    const auto* chosen = session_.experiment();
    if (dialog_ || !chosen) return;
    const auto run = projects::effective(*chosen);
    const auto& pictures = workspace_.views().pictures();
    const auto outputs = pictures.outputs(chosen->id);
    const auto* output = pictures.find(outputs, pictures.key_of({chosen->id, {}}));
    const auto what = tr("%1%2, %3 × %4 pixels")
                          .arg(text_of(chosen->name), output ? " · " + output->label : QString())
                          .arg(run.size[0])
                          .arg(run.size[1]);
    dialog_ = new FilmDialog(what, run.time, live_.moves_until(chosen->id),
                             workspace_.active_pane().compare().main_view().display().exposure, &window_);
    dialog_->setAttribute(Qt::WA_DeleteOnClose);
    connect(dialog_, &QDialog::finished, this, [this] { dialog_ = nullptr; });
    connect(dialog_, &FilmDialog::video_wanted, this, [this] { ask(true); });
    connect(dialog_, &FilmDialog::pictures_wanted, this, [this] { ask(false); });
    dialog_->open();
}

void FilmController::ask(bool for_video) {
    const auto* chosen = session_.experiment();
    if (!chosen) return dialog_->reject();
    const auto endings = QString::fromLatin1(engine::video_endings).split(QStringLiteral(", "));
    const auto file =
        for_video
            ? ask_for_export(dialog_, tr("Film"), text_of(chosen->name),
                             tr("Video (%1)").arg(QStringLiteral("*") + endings.join(QStringLiteral(" *"))),
                             endings)
            : QFileDialog::getExistingDirectory(
                  dialog_, tr("Folder for the pictures"),
                  QFileInfo(export_proposal(text_of(chosen->name), {})).absolutePath());
    if (file.isEmpty() || !dialog_) return;
    if (!for_video) remember_export(file);
    auto film = dialog_->film();
    film.out = file.toStdString();
    dialog_->accept();
    make(std::move(film));
}

void FilmController::make(engine::Film film) {
    const auto* chosen = session_.experiment();
    if (!chosen) return;
    const auto file = text_of(film.out.string());
    Request request{session_.document(),
                    *chosen,
                    session_.open_project().folder(),
                    std::move(film),
                    preferences_.machine(),
                    preferences_.machine_settings().memory_budget()};
    job_.start(file, [this, request = std::move(request), make = make_](const CancelToken& cancel,
                                                                        const ProgressCallback& progress) {
        const auto messages = make(request, cancel, progress);
        QMetaObject::invokeMethod(this, [this, messages] {
            for (const auto& message : messages) notices_.add(message);
        });
    });
}

}  // namespace ir::gui
