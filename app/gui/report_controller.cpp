#include "app/gui/report_controller.h"

#include <QAction>
#include <QDesktopServices>
#include <QMenu>
#include <QTemporaryDir>
#include <QUrl>
#include <chrono>
#include <condition_variable>
#include <mutex>

#include "app/gui/dialog_folder.h"
#include "app/gui/text_of.h"
#include "app/report/write_html.h"
#include "projects/results.h"
#include "projects/scene_files.h"

namespace ir::gui {
namespace {

/// How often the report's thread tells how far what it waits for is.
constexpr std::chrono::milliseconds wait_step{50};

/// Of the work, from one fraction to another.
report::Work share_of(const report::Work& work, double from, double to) {
    return {work.cancel, [&work, from, to](const std::string& what, double fraction) {
                work.progress(what, from + fraction * (to - from));
            }};
}

}  // namespace

/// Pictures that the project does not keep, as files that go with this: the window's thread fills it, the
/// report's thread waits for it.
class UnkeptFiles {
  public:
    explicit UnkeptFiles(projects::Project project) : project_(std::move(project)) {}
    /// As the report has it.
    const projects::Project& project() const { return project_; }

    void expect(const std::string& experiment) { waiting_[experiment] = {}; }
    void set_problem(const std::string& experiment, const QString& why) {
        found_[experiment].problem = why.toStdString();
    }
    bool expects(const std::string& experiment) const {
        const std::lock_guard lock(mutex_);
        return waiting_.count(experiment) > 0;
    }
    std::vector<std::string> expected() const {
        const std::lock_guard lock(mutex_);
        std::vector<std::string> ids;
        for (const auto& [id, progress] : waiting_) ids.push_back(id);
        return ids;
    }
    QString why_no_folder() const { return folder_.isValid() ? QString() : folder_.errorString(); }
    bool has(const std::string& file) const {
        return folder_.isValid() && text_of(file).startsWith(folder_.path() + QLatin1Char('/'));
    }
    /// Where a picture is to be written; the same is asked for once: then nothing.
    QString begin(const std::string& experiment) {
        if (!begun_.insert(experiment).second) return {};
        return folder_.filePath(QString::number(begun_.size()) + QStringLiteral(".exr"));
    }
    void set_progress(const std::string& experiment, const QString& doing, double fraction) {
        const std::lock_guard lock(mutex_);
        if (const auto found = waiting_.find(experiment); found != waiting_.end())
            found->second = {doing.toStdString(), fraction};
    }
    void answer(const std::string& experiment, report::Unkept found) {
        const std::lock_guard lock(mutex_);
        if (waiting_.erase(experiment) == 0) return;
        found_[experiment] = std::move(found);
        changed_.notify_all();
    }

    /// On the report's thread. Throws Cancelled.
    std::map<std::string, report::Unkept> wait(const report::Work& work) {
        std::unique_lock lock(mutex_);
        const auto all = double(waiting_.size());
        while (!waiting_.empty()) {
            const auto& [id, progress] = *waiting_.begin();
            const auto& [doing, fraction] = progress;
            work.tell("Waiting for the picture of " + name_of(id) + (doing.empty() ? "" : ": " + doing),
                      (all - double(waiting_.size()) + fraction) / all);
            changed_.wait_for(lock, wait_step);
        }
        return found_;
    }

  private:
    std::string name_of(const std::string& id) const {
        const auto* experiment = projects::find_item(project_.experiments, id);
        return experiment && !experiment->name.empty() ? experiment->name : id;
    }

    const projects::Project project_;
    const QTemporaryDir folder_;
    std::set<std::string> begun_;  ///< window's thread
    mutable std::mutex mutex_;     ///< of what follows
    std::condition_variable changed_;
    std::map<std::string, std::pair<std::string, double>> waiting_;  ///< doing what, how far; by experiment
    std::map<std::string, report::Unkept> found_;
};

ReportController::ReportController(QWidget& window, Session& session, LivePictures& live, Renderer& renderer,
                                   DocumentDock& document, Notices& notices, Actions& actions)
    : window_(window),
      session_(session),
      live_(live),
      renderer_(renderer),
      document_(document),
      notices_(notices),
      job_(window, notices, tr("Report"), "report") {
    action_ = actions.add("report", tr("&Report …"), nullptr, {QKeySequence(Qt::CTRL | Qt::ALT | Qt::Key_R)},
                          [this] {
                              const auto file = ask_for_file(text_of(session_.document().name));
                              if (!file.isEmpty()) write_to(file);
                          });
    action_->setData(
        tr("One HTML file of the kept results and of what views show: pictures to wipe and flip, metrics, "
           "plots, settings"));
    follow(session_, this, &ReportController::update);
    connect(&job_, &FileJob::changed, this, [this] {
        if (!is_writing()) unkept_.reset();
        update();
    });
    connect(&document_.tree(), &widgets::ProjectPanel::menu_opening, this, &ReportController::fill_menu);
    connect(&live_, &LivePictures::state_changed, this, &ReportController::look_at);
    connect(&live_, &LivePictures::progressed, this, [this](const std::string& id) {
        const auto now = live_.progress(id);
        if (unkept_) unkept_->set_progress(id, now.doing, now.fraction);
    });
    connect(&renderer_, &Renderer::exported, this, &ReportController::take);
    connect(&job_, &FileJob::written, this, [this](const QString& file) {
        if (!QDesktopServices::openUrl(QUrl::fromLocalFile(file)))
            notices_.say(tr("Wrote %1; no browser opens it here").arg(file));
    });
    update();
}

QString ReportController::why_not() const {
    return is_writing()              ? tr("A report is being written.")
           : !session_.has_project() ? tr("No project is open.")
           : session_.open_project().folder().empty()
               ? tr("Save the project first: results are kept in its folder.")
               : QString();
}

void ReportController::update() {
    set_reason(*action_, why_not());
}

void ReportController::fill_menu(const widgets::ItemRef& item, QMenu* menu) {
    if (item.kind != widgets::ItemKind::comparison) return;
    const auto id = item.id.toStdString();
    auto* entry = menu->addAction(tr("Report …"));
    entry->setObjectName(QStringLiteral("comparison-report"));
    entry->setData(
        tr("One HTML file of its two pictures, to wipe and flip, with metrics and settings; what is "
           "not kept is shown and rendered first"));
    set_reason(*entry, why_not());
    menu->setToolTipsVisible(true);
    connect(entry, &QAction::triggered, this, [this, id] {
        const auto* comparison = projects::find_item(session_.document().comparisons, id);
        if (!comparison) return;
        const auto file = ask_for_file(text_of(comparison->name.empty() ? id : comparison->name));
        if (!file.isEmpty()) write_comparison_to(file, id);
    });
}

QString ReportController::ask_for_file(const QString& title) {
    return ask_for_export(&window_, tr("Report"), title, tr("Web page (*.html)"), {QStringLiteral(".html")});
}

void ReportController::ask_for_sweep(const QString& folder, const QString& title) {
    if (is_writing()) return notices_.say(tr("A report is being written."));
    const auto file = ask_for_file(title);
    if (!file.isEmpty()) write_to(file, of_sweep(folder.toStdString()));
}

void ReportController::write_to(const QString& file) {
    write(file, {});
}

void ReportController::write_comparison_to(const QString& file, const std::string& comparison) {
    if (is_writing()) return;
    const auto ids = lacking({comparison, {}});
    if (std::ranges::any_of(ids,
                            [&](const auto& id) { return live_.state(id) == LivePictures::State::absent; }))
        document_.tree().activate({widgets::ItemKind::comparison, text_of(comparison)});
    write(file, comparison);
}

void ReportController::write(const QString& file, const std::string& comparison) {
    if (is_writing()) return;
    unkept_ = ask_for_unkept({comparison, {}});
    for (const auto& id : unkept_->expected()) look_at(id);
    write_to(file, [comparison, unkept = unkept_, folder = session_.open_project().folder()](
                       const std::string& path, const report::Work& work) {
        const report::Subject subject{comparison, unkept->wait(share_of(work, 0, 0.4))};
        const auto made = report::report_of(unkept->project(), folder, share_of(work, 0.4, 0.7), subject);
        report::write_html(path, made, {}, share_of(work, 0.7, 1));
    });
}

std::vector<std::string> ReportController::lacking(const report::Subject& subject) const {
    std::vector<std::string> ids;
    const auto& registry = session_.registry();
    const auto now = projects::with_contents(session_.document(), session_.open_project().contents());
    for (const auto& each : now.experiments)
        if (takes_part(now, subject, each.id) && registry.find(each.method) &&
            projects::result_state(now, each, registry) != projects::ResultState::current)
            ids.push_back(each.id);
    return ids;
}

std::shared_ptr<UnkeptFiles> ReportController::ask_for_unkept(const report::Subject& subject) {
    auto unkept = std::make_shared<UnkeptFiles>(session_.document());
    for (const auto& id : lacking(subject)) {
        if (live_.state(id) == LivePictures::State::absent) continue;
        const auto why_not = why_no_picture(id);
        why_not.isEmpty() ? unkept->expect(id) : unkept->set_problem(id, why_not);
    }
    return unkept;
}

QString ReportController::why_no_picture(const std::string& id) const {
    using State = LivePictures::State;
    const auto state = live_.state(id);
    if (state == State::absent) return tr("it is not shown any more");
    if (state == State::failed || state == State::blocked) return text_of(live_.text(id));
    if (state == State::cancelled) return tr("it was cancelled before it was finished");
    return why_not_its_own(id);
}

QString ReportController::why_not_its_own(const std::string& id) const {
    if (live_.moment() && live_.is_moving(id)) return tr("the timeline shows another time than its own");
    if (session_.camera().moved_pose(id))
        return tr("its camera was moved, and the project does not have that");
    return {};
}

void ReportController::look_at(const std::string& id) {
    if (!unkept_ || !unkept_->expects(id)) return;
    if (const auto why_not = why_no_picture(id); !why_not.isEmpty())
        return unkept_->answer(id, {{}, why_not.toStdString()});
    if (live_.state(id) != LivePictures::State::done) return;
    if (const auto why_not = unkept_->why_no_folder(); !why_not.isEmpty())
        return unkept_->answer(id, {{}, why_not.toStdString()});
    const auto file = unkept_->begin(id);
    if (!file.isEmpty()) renderer_.export_layers({id, file.toStdString(), {}});
}

void ReportController::take(const std::string& id, const std::string& file, const std::string& error) {
    if (!unkept_ || !unkept_->has(file)) return;  // of somebody else
    const auto* experiment = session_.experiment(id);
    const auto* asked = projects::find_item(unkept_->project().experiments, id);
    const bool is_same = experiment && asked && session_.registry().find(experiment->method) &&
                         projects::picture_inputs(session_.document(), *experiment, session_.registry()) ==
                             projects::picture_inputs(unkept_->project(), *asked, session_.registry());
    if (!error.empty()) return unkept_->answer(id, {{}, error});
    if (!is_same) return unkept_->answer(id, {{}, tr("it was changed meanwhile").toStdString()});
    if (const auto why_not = why_not_its_own(id); !why_not.isEmpty())
        return unkept_->answer(id, {{}, why_not.toStdString()});
    unkept_->answer(id, {file, {}});
}

ReportController::Maker ReportController::of_sweep(const std::filesystem::path& folder) {
    return [folder](const std::string& path, const report::Work& work) {
        const auto made =
            report::report_of_sweep(folder, report::usual_sweep_pictures, share_of(work, 0, 0.5));
        report::write_html(path, made, {}, share_of(work, 0.5, 1));
    };
}

void ReportController::write_to(const QString& file, const Maker& make) {
    job_.start(file, [file, make](const CancelToken& cancel, const ProgressCallback& progress) {
        make(file.toStdString(), {&cancel, progress});
    });
}

}  // namespace ir::gui
