#include "app/gui/frames_dock.h"

#include <QAction>
#include <QFileDialog>
#include <QFileInfo>
#include <QMessageBox>
#include <QTemporaryDir>
#include <algorithm>
#include <optional>

#include "app/engine/camera_pose.h"
#include "app/engine/film.h"
#include "app/engine/part.h"
#include "app/gui/dialog_folder.h"
#include "app/gui/exports.h"
#include "app/gui/json_fields.h"
#include "app/gui/text_of.h"
#include "projects/analyses.h"
#include "projects/edit_steps.h"
#include "renderers/core/error.h"
#include "renderers/image/channels.h"
#include "renderers/image/exr.h"

namespace ir::gui {
namespace {

constexpr double bytes_per_mib = 1024.0 * 1024.0;

/// What the files of a film are made of, so that frames that go meanwhile are there still.
struct FilmJob {
    std::vector<std::shared_ptr<const engine::LiveResult>> frames;
    engine::Part part;
    widgets::Display display;
    Semantic semantic = Semantic::generic;
    FramesDock::Film film = FramesDock::Film::pictures;
};

void write_frames(const FilmJob& job, const std::filesystem::path& out, const CancelToken& cancel,
                  const ProgressCallback& progress) {
    const bool is_video = job.film == FramesDock::Film::video;
    engine::check_film_file(out);
    std::optional<QTemporaryDir> temporary;
    if (is_video && !temporary.emplace().isValid()) throw Error(temporary->errorString().toStdString());
    const auto folder = is_video ? std::filesystem::path(temporary->path().toStdString()) : out;
    for (std::size_t i = 0; i < job.frames.size(); ++i) {
        cancel.check();
        progress("picture " + std::to_string(i + 1) + " of " + std::to_string(job.frames.size()),
                 double(i) / double(job.frames.size()));
        const auto& image = job.frames[i]->images.at(job.part);
        auto file = engine::film_picture(folder, int(i) + 1);
        if (job.film == FramesDock::Film::values)
            write_exr(file.replace_extension(".exr"),
                      {{"", channel_names(job.semantic, image.channels), image}}, {});
        else
            write_picture(text_of(file.string()), widgets::to_qimage(image, job.display));
    }
    if (is_video) engine::make_video(folder, out, &cancel);
}

}  // namespace

FramesDock::FramesDock(QWidget& window, Session& session, LivePictures& live, Workspace& workspace,
                       Notices& notices, Actions& actions)
    : QObject(&window),
      window_(window),
      session_(session),
      live_(live),
      workspace_(workspace),
      past_(live.past()),
      actions_(actions),
      panel_(new widgets::FramesPanel),
      job_(window, notices, tr("Film"), "frames") {
    const auto add = [&](const char* name, const QString& text, const char* icon, Qt::Key key,
                         const QString& help, auto run) {
        actions.add(name, text, icon, {QKeySequence(Qt::ALT | key)}, run)->setData(help);
    };
    add("past-older", tr("Frame be&fore (of the last frames)"), "step-back", Qt::Key_Comma,
        tr("All views go back by one of the frames that are kept"),
        [this] { choose(int(past_.place()) - 1); });
    add("past-newer", tr("Frame af&ter (of the last frames)"), "step-forward", Qt::Key_Period,
        tr("All views go on by one of the frames that are kept"), [this] { choose(int(past_.place()) + 1); });
    add("past-now", tr("&Newest frame"), nullptr, Qt::Key_N, tr("All views show what is newest again"),
        [this] { past_.show_now(); });
    add("past-keep", tr("Keep the &last frames"), "keep", Qt::Key_K,
        tr("An analysis of the project that renders as many frames, and keeps their pictures"),
        [this] { keep_frames(); });
    using Panel = widgets::FramesPanel;
    connect(panel_, &Panel::frame_chosen, this, &FramesDock::choose);
    connect(panel_, &Panel::now_wanted, &past_, &PastFrames::show_now);
    connect(panel_, &Panel::limit_chosen, this,
            [this](double limit) { past_.set_limit(std::uint64_t(limit * bytes_per_mib)); });
    connect(panel_, &Panel::film_wanted, this, &FramesDock::ask);
    connect(panel_, &Panel::experiment_wanted, this, &FramesDock::add_experiment);
    connect(panel_, &Panel::keep_wanted, this, &FramesDock::keep_frames);
    connect(&past_, &PastFrames::kept_changed, this, &FramesDock::update);
    connect(&past_, &PastFrames::shown_changed, this, &FramesDock::update);
    connect(&workspace_, &Workspace::picture_shown, this, &FramesDock::update);
    connect(&job_, &FileJob::changed, this, &FramesDock::update);
    follow(session_, this, &FramesDock::update);
    update();
}

void FramesDock::choose(int frame) {
    if (frame >= 0 && !past_.frames().empty()) past_.show(std::size_t(frame));
}

const PastFrame* FramesDock::chosen() const {
    const auto* experiment = session_.has_project() ? session_.experiment() : nullptr;
    return experiment ? past_.shown_of(experiment->id) : nullptr;
}

QString FramesDock::caption() const {
    const auto& frames = past_.frames();
    const auto place = past_.place();
    if (place >= frames.size()) return {};
    const auto& frame = frames[place];
    const auto& id = frame.result->tag;
    QStringList words{past_.is_elsewhere() ? tr("%1 of %2").arg(place + 1).arg(frames.size())
                      : frames.size() == 1 ? tr("Now, one frame is kept")
                                           : tr("Now, %1 frames are kept").arg(frames.size()),
                      text_of(workspace_.views().pictures().owner_name(id))};
    if (frame.result->frames > 1)
        words << tr("frame %1 of %2").arg(frame.result->frame).arg(frame.result->frames);
    if (live_.is_moving(id)) words << tr("%1 s").arg(frame.result->time, 0, 'g', 4);
    for (auto i = place + 1; i-- > 0;)
        if (frames[i].result->tag == id && !frames[i].change.empty()) {
            words << tr("after “%1”").arg(text_of(frames[i].change));
            break;
        }
    return words.join(QStringLiteral(" · "));
}

/// Of what the active view shows as A, all of one size.
std::vector<std::shared_ptr<const engine::LiveResult>> FramesDock::film_frames(engine::Part& part) const {
    const auto& source = workspace_.views().active_state().a;
    part = {source.output, source.level, source.layer, live_.step(source.owner).after};
    std::vector<std::shared_ptr<const engine::LiveResult>> found;
    const auto size = [&](const engine::LiveResult& result) {
        const auto& image = result.images.at(part);
        return std::pair(image.width, image.height);
    };
    const auto& frames = past_.frames();
    for (auto each = frames.rbegin(); each != frames.rend(); ++each)
        if (const auto& result = each->result; result->tag == source.owner && result->images.count(part) &&
                                               (found.empty() || size(*result) == size(*found.front())))
            found.push_back(result);
    std::reverse(found.begin(), found.end());
    return found;
}

void FramesDock::update() {
    set_reason(*actions_.find("past-older"), past_.place() > 0 ? QString() : tr("No older frame is kept."));
    for (const char* name : {"past-newer", "past-now"})
        set_reason(*actions_.find(name), past_.is_elsewhere() ? QString() : tr("The newest frame is shown."));
    widgets::FramesState state;
    for (const auto& frame : past_.frames()) state.edited.push_back(!frame.change.empty());
    state.shown = int(past_.place());
    state.is_past = past_.is_elsewhere();
    state.caption = caption();
    state.used_mib = double(past_.bytes()) / bytes_per_mib;
    state.limit_mib = double(past_.limit()) / bytes_per_mib;
    engine::Part part;
    if (is_saving())
        state.why_no_film = tr("Frames are being saved.");
    else if (!session_.has_project() || film_frames(part).empty())
        state.why_no_film = tr("No kept frame has the picture of the active view.");
    if (!chosen())
        state.why_no_experiment = tr("Choose an older frame of the experiment that is worked on.");
    else if (session_.open_project().is_read_only())
        state.why_no_experiment = read_only_text(session_.open_project());
    state.why_not_kept = why_not_kept();
    set_reason(*actions_.find("past-keep"), state.why_not_kept);
    if (past_.frames().empty())
        state.caption = past_.limit() == 0 ? tr("No frames are kept.")
                                           : tr("Frames are kept here as they arrive in the views.");
    panel_->show_state(state);
}

void FramesDock::ask(Film film) {
    const auto name =
        text_of(workspace_.views().pictures().owner_name(workspace_.views().active_state().a.owner));
    if (film == Film::video) {
        const auto endings = QString::fromLatin1(engine::video_endings).split(QStringLiteral(", "));
        const auto file = ask_for_export(
            &window_, tr("Film"), name,
            tr("Video (%1)").arg(QStringLiteral("*") + endings.join(QStringLiteral(" *"))), endings);
        if (!file.isEmpty()) save_film(film, file);
        return;
    }
    const auto folder = QFileDialog::getExistingDirectory(
        &window_, tr("Folder for the pictures"), QFileInfo(export_proposal(name, {})).absolutePath());
    if (folder.isEmpty()) return;
    const auto first = text_of(engine::film_picture(folder.toStdString(), 1).string());
    if (QFileInfo::exists(first) &&
        QMessageBox::question(&window_, tr("Film"),
                              tr("%1 and those behind it are there. Replace them?").arg(first)) !=
            QMessageBox::Yes)
        return;
    remember_export(folder);
    save_film(film, folder);
}

void FramesDock::save_film(Film film, const QString& file) {
    FilmJob job;
    job.frames = film_frames(job.part);
    if (job.frames.empty()) return;
    job.film = film;
    job.display = workspace_.active_pane().compare().compared().shown_display(0);
    if (const auto picture = workspace_.active_pane().picture_at(0)) job.semantic = picture->semantic;
    job_.start(file, [job, out = std::filesystem::path(file.toStdString())](
                         const CancelToken& cancel, const ProgressCallback& progress) {
        write_frames(job, out, cancel, progress);
    });
}

/// As it asked for the frame, with the camera that saw it: a new one where that has moved since.
void FramesDock::add_experiment() {
    const auto* frame = chosen();
    if (!frame) return;
    auto copy = frame->experiment;
    copy.last_kept_key.clear();
    const auto pose = engine::pose_of(frame->result->camera);
    copy.name += tr(", frame %1").arg(past_.place_of(*frame) + 1).toStdString();
    const auto now = session_.camera().pose();
    const bool has_moved = !now || copy.camera != session_.experiment()->camera ||
                           engine::seen_by(engine::camera_of(*now)) != engine::seen_by(frame->result->camera);
    const bool done = session_.edit([&](const projects::Project& project) {
        copy.id = projects::free_experiment_id(project, copy.name);
        projects::EditSteps steps(project);
        if (has_moved) {
            const auto view = new_view(project, pose, "View");
            copy.camera = view.id;
            steps.add(projects::edits::add(project, view));
        }
        steps.add(projects::edits::add(steps.after(), copy));
        return steps.as_one("Add experiment of a past frame");
    });
    if (!done) return;
    past_.show_now();
    session_.select_experiment(copy.id);
}

QString FramesDock::why_not_kept() const {
    engine::Part part;
    if (!session_.has_project() || film_frames(part).empty())
        return tr("No kept frame has the picture of the active view.");
    if (session_.open_project().is_read_only()) return read_only_text(session_.open_project());
    if (!part.after.empty()) return tr("The view shows a step within the frame; show its end first.");
    if (part.level == engine::Part::all || part.layer == engine::Part::all)
        return tr("The view shows several levels or layers; choose one of them.");
    return {};
}

/// They are rendered anew: past ones may be of settings of before.
void FramesDock::keep_frames() {
    if (!why_not_kept().isEmpty()) return;
    engine::Part part;
    const int count = int(film_frames(part).size());
    const auto output = part.key.empty() ? part.key : engine::layer_name(part, part.layer > 0);
    const auto experiment = workspace_.views().active_state().a.owner;
    const bool done = session_.edit([&](const projects::Project& project) {
        auto analysis = projects::analysis_of(project, "frames", experiment, session_.registry(), output);
        analysis.frames = std::clamp(count, projects::min_analysis_frames, projects::max_analysis_frames);
        return projects::edits::add(project, analysis);
    });
    if (!done) return;
    session_.end_gesture();
    emit analysis_added();
}

void FramesDock::save(projects::Json& memory) const {
    memory["frames"] = {{"limit_mib", double(past_.limit()) / bytes_per_mib}};
}

void FramesDock::load(const projects::Json& memory) {
    const double standard = double(PastFrames::standard_limit) / bytes_per_mib;
    const double limit = field_or(member_or_null(memory, "frames"), "limit_mib", standard);
    past_.set_limit(std::uint64_t(std::clamp(limit, 0.0, 1e6) * bytes_per_mib));
}

}  // namespace ir::gui
