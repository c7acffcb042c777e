#include "app/gui/plots_dock.h"

#include <QApplication>
#include <QClipboard>
#include <QVBoxLayout>
#include <algorithm>

#include "app/gui/dialog_folder.h"
#include "app/gui/exports.h"
#include "app/gui/json_fields.h"
#include "app/gui/load_setting.h"
#include "app/gui/new_plot.h"
#include "app/gui/redraw.h"
#include "app/gui/text_of.h"
#include "projects/coordinate.h"
#include "projects/plots.h"
#include "projects/scene_files.h"
#include "renderers/core/error.h"
#include "renderers/core/write_file.h"
#include "renderers/image/metrics.h"
#include "widgets/document/plot_options.h"
#include "widgets/plot/plot_painter.h"
#include "widgets/style/number_text.h"

namespace ir::gui {
namespace {

using engine::KeptStudy;
using projects::Json;
using widgets::PlotPanel;

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

constexpr int paper_width = 800, paper_height = 500;

/// The inputs that differ, in a few words.
QStringList changed_inputs(const Json& before, const Json& now) {
    QStringList words;
    for (const char* key : {"over", "values", "reference"})
        if (member_or_null(before, key) != member_or_null(now, key)) words << QLatin1String(key);
    const auto &old_ones = member_or_null(before, "experiments"),
               &new_ones = member_or_null(now, "experiments");
    if (!old_ones.is_object() || !new_ones.is_object()) return words;
    for (const auto& [id, inputs] : new_ones.items())
        if (!old_ones.contains(id) || old_ones[id] != inputs) words << text_of(id);
    for (const auto& [id, inputs] : old_ones.items())
        if (!new_ones.contains(id)) words << text_of(id);
    return words;
}

QString points_text(int count) {
    return widgets::counted(count, PlotsDock::tr("point"), PlotsDock::tr("points"));
}

}  // namespace

PlotsDock::PlotsDock(Session& session, const Preferences& preferences, engine::StudyRunner runner,
                     QWidget* parent)
    : QWidget(parent),
      session_(session),
      preferences_(preferences),
      studies_(std::move(runner)),
      panel_(new PlotPanel) {
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
    connect(&session_.files(), &ProjectFiles::files_changed, this, &PlotsDock::update);
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
    studies_.run({.tag = id,
                  .project = session_.document(),
                  .plot = *plot(),
                  .folder = open.folder(),
                  .machine = preferences_.machine(),
                  .memory_budget = preferences_.machine_settings().memory_budget()},
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
    emit said(tr("%1: %2 measured")
                  .arg(now ? text_of(now->name) : text_of(id), points_text(count_measured(study))));
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
                    : state.running ? tr("Cancelled after %1, not kept").arg(points_text(count))
                                    : QString();
    if (!cancelled) emit failed(error);
    if (cancelled) emit said(tr("Cancelled the plot"));
    update();
}

void PlotsDock::load_point(const QString& id) {
    const auto numbers = shown_numbers();
    const auto* point = numbers ? engine::find_point(numbers->study, id.toStdString()) : nullptr;
    if (!point) return;
    if (!session_.experiment(point->experiment))
        return emit said(tr("The experiment of this point is gone."));
    const auto key = look_of(*numbers).over;
    const auto setting = tr("%1 = %2").arg(text_of(key), text_of(engine::value_text(point->value)));
    const auto loading =
        load_setting(session_, point->experiment, Json::object({{key, point->value}}), setting, "plot");
    if (!loading.failed.isEmpty()) return emit failed(loading.failed);
    if (loading.said.isEmpty()) return;
    emit said(loading.said);
    emit loaded(text_of(point->experiment));
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

std::shared_ptr<const KeptStudy> PlotsDock::shown_numbers() const {
    const auto found = states_.find(chosen());
    if (found == states_.end()) return nullptr;
    if (found->second.running) return found->second.running;
    return found->second.numbers;
}

engine::PlotLook PlotsDock::look_of(const KeptStudy& numbers) const {
    return {field_or(numbers.inputs, "over", plot() ? plot()->over : std::string()), log_x_, log_y_};
}

QString PlotsDock::stale_text() const {
    const auto found = states_.find(chosen());
    if (found == states_.end() || found->second.running || !found->second.numbers) return {};
    const auto& numbers = *found->second.numbers;
    const auto& contents = session_.open_project().contents();
    if (!engine::is_stale(numbers, session_.document(), *plot(), contents)) return {};
    const auto now = projects::with_contents(session_.document(), contents);
    const auto words = changed_inputs(numbers.inputs, engine::study_inputs(now, *plot()));
    return tr("These numbers are not of what the project says now. Run the plot again.\nChanged: %1")
        .arg(words.isEmpty() ? tr("what they depend on") : words.join(QStringLiteral(", ")));
}

void PlotsDock::read_if_needed() {
    auto& now = state();
    if (now.was_read || folder_.empty()) return;
    now.was_read = true;
    studies_.read(folder_, chosen());
}

void PlotsDock::update() {
    outdated_ = !seen_;
    if (!seen_) return;
    if (!plot()) return show_empty();
    read_if_needed();
    const auto numbers = shown_numbers();
    const auto& document = session_.document();
    const KeptStudy nothing;
    auto drawn =
        engine::draw_study(document, session_.registry(), *plot(), (numbers ? *numbers : nothing).study,
                           look_of(numbers ? *numbers : nothing));
    if (const auto& problem = state().problem; !problem.isEmpty())
        drawn.data.problems.insert(drawn.data.problems.begin(), problem.toStdString());
    panel_->show_data(drawn.data, waiting_text());
    show_header(drawn);
}

void PlotsDock::show_empty() {
    const bool has_experiments = session_.has_project() && !session_.document().experiments.empty();
    const bool writable = session_.has_project() && !session_.open_project().is_read_only();
    const auto what = tr(
        "A plot shows how far experiments are from their reference, against the time that they take, their "
        "frames or any parameter.");
    panel_->show_empty(!session_.has_project() ? tr("No project is open.")
                       : !has_experiments      ? what + tr("\n\nIt needs an experiment.")
                       : !writable             ? what + tr("\n\nThe project is open read-only, and has none.")
                                               : what + tr("\n\nThis project has none yet."),
                       has_experiments && writable ? tr("New plot") : QString());
    auto choices = plot_lists();
    panel_->header().show_choices(choices);
}

QString PlotsDock::waiting_text() const {
    const auto found = states_.find(chosen());
    if (found != states_.end() && found->second.is_running)
        return tr("Points appear as they are measured; the reference comes first.");
    if (studies_.is_reading()) return tr("Reading …");
    const auto why_not = why_not_run();
    return why_not.isEmpty() ? tr("Run the plot to measure its points.") : why_not;
}

widgets::PlotChoices PlotsDock::plot_lists() const {
    widgets::PlotChoices choices;
    if (!session_.has_project()) {
        choices.why_read_only = tr("No project is open.");
        return choices;
    }
    const auto& open = session_.open_project();
    for (const auto& each : session_.document().plots)
        choices.plots.push_back({text_of(each.id), name_text(each), text_of(each.notes)});
    choices.plot = text_of(chosen());
    if (open.is_read_only()) choices.why_read_only = read_only_text(open);
    return choices;
}

void PlotsDock::show_header(const engine::DrawnStudy& drawn) {
    auto choices = plot_lists();
    const auto& now = *plot();
    const auto& known = state();
    choices.metrics = widgets::metric_options();
    choices.metric = text_of(now.metric);
    choices.keys = widgets::plot_key_options(session_.document(), now, session_.registry());
    choices.key = text_of(now.over);
    choices.values = widgets::plot_values_text(now);
    choices.values_hint = widgets::plot_values_hint(now);
    choices.against_time = now.against_time;
    choices.log_x = log_x_;
    choices.log_y = log_y_;
    choices.why_no_log_x = text_of(drawn.why_no_log_x);
    choices.why_no_log_y = text_of(drawn.why_no_log_y);
    choices.why_not_run = why_not_run();
    choices.has_numbers = shown_numbers() != nullptr;
    choices.is_running = known.is_running;
    choices.doing = known.doing;
    choices.fraction = known.fraction;
    choices.stale = stale_text();
    panel_->header().show_choices(choices);
}

engine::ErrorStudy PlotsDock::study_with_front() const {
    const auto numbers = shown_numbers();
    if (!numbers) throw Error("there are no numbers yet; run the plot");
    auto study = numbers->study;
    engine::mark_front(study.points, plot()->metric);
    return study;
}

void PlotsDock::write_picture(const QString& file, const QSize& size, int scale, bool on_paper) const {
    const auto& style = on_paper ? PlotStyle::paper() : PlotStyle::screen();
    gui::write_picture(file, widgets::plot_picture(panel_->data(), size, scale, style));
}

void PlotsDock::write_numbers(const QString& file) const {
    write_file(file.toStdString(), engine::study_csv(study_with_front()));
}

QString PlotsDock::ask_for_file(const QString& words, const QString& suffix, const QString& filter) {
    const auto* drawn = plot(chosen());
    const auto name = drawn ? name_text(*drawn) : QString();
    return ask_for_export(this, tr("Export"), name + words, filter, {suffix});
}

void PlotsDock::export_picture(int scale, bool on_paper, bool to_clipboard) {
    const QSize size = on_paper ? QSize(paper_width, paper_height) : panel_->view().size();
    if (to_clipboard) {
        const auto& style = on_paper ? PlotStyle::paper() : PlotStyle::screen();
        QApplication::clipboard()->setImage(widgets::plot_picture(panel_->data(), size, scale, style));
        return emit said(tr("Copied the plot"));
    }
    const auto words =
        (on_paper ? tr(" on paper") : QString()) + (scale > 1 ? tr(" %1x").arg(scale) : QString());
    const auto file = ask_for_file(words, QStringLiteral(".png"), tr("PNG (*.png)"));
    if (file.isEmpty()) return;
    try {
        write_picture(file, size, scale, on_paper);
        emit said(tr("Wrote %1").arg(file));
    } catch (const Error& error) {
        emit failed(text_of(error.what()));
    }
}

void PlotsDock::export_numbers(bool to_clipboard) {
    try {
        if (to_clipboard) {
            QApplication::clipboard()->setText(text_of(engine::study_csv(study_with_front())));
            return emit said(tr("Copied the numbers"));
        }
        const auto file = ask_for_file({}, QStringLiteral(".csv"), tr("Comma-separated values (*.csv)"));
        if (file.isEmpty()) return;
        write_numbers(file);
        emit said(tr("Wrote %1").arg(file));
    } catch (const Error& error) {
        emit failed(text_of(error.what()));
    }
}

}  // namespace ir::gui
