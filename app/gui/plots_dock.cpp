#include "app/gui/plots_dock.h"

#include <QVBoxLayout>
#include <algorithm>

#include "app/gui/json_fields.h"
#include "app/gui/new_plot.h"
#include "app/gui/text_of.h"
#include "projects/coordinate.h"
#include "projects/plots.h"
#include "projects/scene_files.h"
#include "renderers/image/metrics.h"
#include "widgets/document/plot_options.h"

namespace ir::gui {
namespace {

using engine::KeptStudy;
using projects::Json;
using widgets::PlotPanel;

constexpr int redraw_ms = 60;

/// A point of the value that another had replaces that one.
void put_point(std::vector<engine::ErrorPoint>& points, const engine::ErrorPoint& point) {
    const auto found = std::find_if(points.begin(), points.end(), [&](const engine::ErrorPoint& each) {
        return each.experiment == point.experiment && each.value == point.value;
    });
    if (found == points.end())
        points.push_back(point);
    else
        *found = point;
}

/// Points that were refused have a problem instead of numbers.
int count_measured(const engine::ErrorStudy& study) {
    return int(std::count_if(study.points.begin(), study.points.end(),
                             [](const engine::ErrorPoint& point) { return point.problem.empty(); }));
}

}  // namespace

PlotsDock::PlotsDock(Session& session, const engine::MachineOptions& machine, engine::StudyRunner runner,
                     QWidget* parent)
    : QWidget(parent), session_(session), studies_(machine, std::move(runner)), panel_(new PlotPanel) {
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->addWidget(panel_);
    redraw_.setSingleShot(true);
    redraw_.setInterval(redraw_ms);
    connect(&redraw_, &QTimer::timeout, this, &PlotsDock::update);
    connect_panel();
    connect_studies();
    connect(&session_, &Session::project_replaced, this, &PlotsDock::forget_all);
    connect(&session_, &Session::document_changed, this, &PlotsDock::follow_document);
    connect(&session_, &Session::files_changed, this, &PlotsDock::update);
    update();
}

void PlotsDock::connect_panel() {
    auto* header = &panel_->header();
    using Header = widgets::PlotHeader;
    connect(panel_, &PlotPanel::point_activated, this, &PlotsDock::load_point);
    connect(panel_, &PlotPanel::button_clicked, this, &PlotsDock::add_plot);
    connect(header, &Header::new_wanted, this, &PlotsDock::add_plot);
    connect(header, &Header::run_wanted, this, &PlotsDock::run);
    connect(header, &Header::cancel_wanted, this, &PlotsDock::cancel);
    connect(header, &Header::edit_wanted, this, [this] { emit edit_wanted(text_of(chosen())); });
    connect(header, &Header::plot_chosen, this, [this](const QString& id) { show_plot(id.toStdString()); });
    connect(header, &Header::metric_chosen, this, [this](const QString& metric) {
        change(widgets::set_plot_metric(chosen(), metric.toStdString()));
    });
    connect(header, &Header::key_chosen, this,
            [this](const QString& key) { change(widgets::set_plot_key(chosen(), key.toStdString())); });
    connect(header, &Header::values_chosen, this,
            [this](const QString& text) { change(widgets::set_plot_values(chosen(), text.toStdString())); });
    connect(header, &Header::against_time_chosen, this,
            [this](bool against_time) { change(widgets::set_plot_axis(chosen(), against_time)); });
    connect(header, &Header::log_chosen, this, [this](bool log_x, bool log_y) {
        log_x_ = log_x;
        log_y_ = log_y;
        update();
    });
    connect(header, &Header::picture_wanted, this, &PlotsDock::export_picture);
    connect(header, &Header::numbers_wanted, this, &PlotsDock::export_numbers);
}

void PlotsDock::connect_studies() {
    connect(&studies_, &Studies::point_arrived, this,
            [this](const std::string& id, const engine::ErrorPoint& point) {
                auto& running = states_[id].running;
                if (!running) return;
                put_point(running->study.points, point);
                if (!redraw_.isActive()) redraw_.start();
            });
    connect(&studies_, &Studies::progressed, this,
            [this](const std::string& id, const QString& what, double fraction) {
                states_[id].doing = what;
                states_[id].fraction = fraction;
                if (!redraw_.isActive()) redraw_.start();
            });
    connect(&studies_, &Studies::finished, this, &PlotsDock::finish);
    connect(&studies_, &Studies::failed, this, &PlotsDock::fail);
    connect(&studies_, &Studies::read_done, this,
            [this](const std::string& folder, const std::string& id, std::shared_ptr<const KeptStudy> kept,
                   const QString& error) {
                if (folder != folder_.string() || !plot(id)) return;
                auto& state = states_[id];
                if (kept) {
                    state.numbers = std::move(kept);
                    if (!state.is_running) state.running.reset();
                }
                if (!error.isEmpty()) state.problem = error;
                update();
                if (runs_when_read_ && id == chosen()) run_if_needed();
            });
}

void PlotsDock::change(const widgets::EditMaker& make) {
    session_.edit(make);
    session_.end_gesture();
    update();  // a refused value leaves its field again
}

/// Another project.
void PlotsDock::forget_all() {
    for (const auto& [id, state] : states_) studies_.release(id);
    states_.clear();
    folder_ = session_.has_project() ? session_.open_project().folder() : std::filesystem::path();
    update();
}

/// Plots may be gone, or the project in another place, where others may be kept.
void PlotsDock::follow_document() {
    for (auto each = states_.begin(); each != states_.end();) {
        if (plot(each->first)) {
            ++each;
            continue;
        }
        studies_.release(each->first);
        each = states_.erase(each);
    }
    if (session_.has_project() && folder_ != session_.open_project().folder()) {
        folder_ = session_.open_project().folder();
        for (auto& [id, state] : states_) state.was_read = false;
    }
    update();
}

const projects::ErrorPlot* PlotsDock::plot(const std::string& id) const {
    return session_.has_project() ? projects::find_item(session_.document().plots, id) : nullptr;
}

std::string PlotsDock::chosen() const {
    if (plot(chosen_)) return chosen_;
    return session_.has_project() && !session_.document().plots.empty() ? session_.document().plots.front().id
                                                                        : std::string();
}

const projects::ErrorPlot* PlotsDock::plot() const {
    return plot(chosen());
}

void PlotsDock::show_plot(const std::string& id) {
    chosen_ = id;
    update();
}

void PlotsDock::set_visible_to_user(bool seen) {
    seen_ = seen;
    if (seen_ && outdated_) update();
}

bool PlotsDock::is_settled() const {
    return !studies_.is_running() && !studies_.is_reading();
}

void PlotsDock::add_plot() {
    if (!session_.has_project()) return;
    const auto* shown = session_.experiment();
    if (session_.edit(add_error_plot(session_.registry(), shown ? shown->id : std::string())))
        show_plot(session_.document().plots.back().id);
}

void PlotsDock::look() {
    for (auto& [id, state] : states_) state.was_read = false;
    update();
}

QString PlotsDock::why_not_run() const {
    const auto* now = plot();
    if (!now) return tr("There is no plot.");
    if (now->experiments.empty()) return tr("Edit it: choose experiments to be judged.");
    if (now->reference.empty())
        return tr("Edit it: choose what they are judged by. Match reference (Ctrl+M) adds a ground truth.");
    if (projects::count_points(session_.document(), *now) == 0) return tr("Give values to measure at.");
    return {};
}

void PlotsDock::run() {
    if (!why_not_run().isEmpty()) return;
    const auto id = chosen();
    const auto& open = session_.open_project();
    auto& state = states_[id];
    const auto now = projects::with_contents(session_.document(), open.contents());
    state.running = std::make_shared<KeptStudy>();
    state.running->key = engine::study_key(now, *plot());
    state.running->inputs = engine::study_inputs(now, *plot());
    state.running->study.plot = id;
    state.running->study.metrics = metric_names();
    state.is_running = true;
    state.problem.clear();
    state.doing = tr("Waiting …");
    state.fraction = -1;
    runs_when_read_ = false;
    studies_.run({id, session_.document(), *plot(), open.folder()},
                 !open.folder().empty() && !open.is_read_only());
    update();
}

void PlotsDock::run_if_needed() {
    auto& now = state();
    if (!plot() || now.is_running) return;
    runs_when_read_ = !folder_.empty() && (!now.was_read || studies_.is_reading());
    if (runs_when_read_) return read_if_needed();
    if (!now.numbers || !stale_text().isEmpty()) run();
}

void PlotsDock::cancel() {
    studies_.cancel(chosen());
}

void PlotsDock::finish(const std::string& id, const engine::ErrorStudy& study, const QString& keep_error) {
    auto& state = states_[id];
    if (!state.running) return;
    auto numbers = std::move(state.running);
    numbers->study = study;
    state.running.reset();
    state.is_running = false;
    state.numbers = std::move(numbers);
    if (!keep_error.isEmpty()) {
        state.problem = tr("The numbers were not kept: %1").arg(keep_error);
        emit failed(state.problem);
    }
    const auto* now = plot(id);
    emit said(tr("%1: %n point(s) measured", nullptr, count_measured(study))
                  .arg(now ? text_of(now->name) : text_of(id)));
    update();
}

/// What was measured until then stays, where nothing better is there.
void PlotsDock::fail(const std::string& id, const QString& error, bool cancelled) {
    auto& state = states_[id];
    state.is_running = false;
    const bool is_empty = !state.running || state.running->study.points.empty();
    const int count = is_empty ? 0 : count_measured(state.running->study);
    if (state.numbers || is_empty) state.running.reset();
    state.problem = !cancelled      ? error
                    : state.running ? tr("Cancelled after %n point(s); they are not kept", nullptr, count)
                                    : QString();
    if (!cancelled) emit failed(error);
    if (cancelled) emit said(tr("Cancelled the plot"));
    update();
}

void PlotsDock::load_point(const QString& id) {
    const auto numbers = shown_numbers();
    const auto* point = numbers ? find_point(numbers->study, id) : nullptr;
    if (!point) return;
    const auto* experiment = session_.experiment(point->experiment);
    if (!experiment) return emit said(tr("The experiment of this point is gone."));
    const auto key = look_of(*numbers).over;
    const auto setting = tr("%1 = %2").arg(text_of(key), value_text(point->value));
    if (session_.open_project().is_read_only())
        return emit failed(tr("%1 is not loaded: the project is open read-only: %2")
                               .arg(setting, text_of(session_.open_project().read_only_reason())));
    namespace edits = projects::edits;
    const bool changed = session_.edit([&](const projects::Project& project) {
        const auto& registry = session_.registry();
        const auto run = projects::with_coordinate(project, *experiment, key, point->value, registry);
        std::vector<projects::EditPtr> steps;
        if (key == "frames")
            steps.push_back(edits::set_frames(project, run.id, run.frames));
        else if (key == "seed")
            steps.push_back(edits::set_seed(project, run.id, run.seed));
        else
            steps.push_back(edits::set_values(project, registry, run.id, {{key, run.values.at(key)}}));
        return edits::group("Load " + setting.toStdString() + " from plot", std::move(steps));
    });
    session_.end_gesture();
    const auto name = text_of(point->experiment);
    emit said(changed ? tr("Loaded %1 into %2").arg(setting, name) : tr("%2 has %1").arg(setting, name));
    emit loaded(name);
}

void PlotsDock::save(Json& memory) const {
    memory["plots"] = {{"chosen", chosen()}, {"log_x", log_x_}, {"log_y", log_y_}};
}

void PlotsDock::load(const Json& memory) {
    const auto& own = member_or_null(memory, "plots");
    chosen_ = field_or(own, "chosen", std::string());
    log_x_ = field_or(own, "log_x", true);
    log_y_ = field_or(own, "log_y", true);
    update();
}

}  // namespace ir::gui
