#include "app/gui/sweeps_dock.h"

#include <QFileDialog>
#include <QVBoxLayout>
#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "app/gui/dialog_folder.h"
#include "app/gui/json_fields.h"
#include "app/gui/load_setting.h"
#include "app/gui/redraw.h"
#include "app/gui/text_of.h"
#include "projects/coordinate.h"
#include "renderers/core/error.h"
#include "renderers/core/write_file.h"
#include "widgets/document/makers.h"
#include "widgets/style/number_text.h"

namespace ir::gui {
namespace {

namespace fs = std::filesystem;
using engine::SweepRow;
using projects::Json;
using widgets::SweepLine, widgets::SweepPanel;

std::size_t count_done(const engine::SweepSheet& sheet) {
    const auto& rows = sheet.table.rows;
    return std::size_t(std::count_if(rows.begin(), rows.end(), std::mem_fn(&SweepRow::is_done)));
}

std::size_t count_failed(const engine::SweepSheet& sheet) {
    const auto& rows = sheet.table.rows;
    return std::size_t(std::count_if(rows.begin(), rows.end(), std::mem_fn(&SweepRow::has_failed)));
}

bool varies(const projects::Sweep& sweep, const std::string& key) {
    return std::ranges::count(sweep.axes, key, &projects::Sweep::Axis::key) > 0;
}

/// What varies first where nobody has chosen.
std::string first_axis_of(const MethodDescription* method) {
    return method && !method->parameters.empty() ? method->parameters.front().key : "seed";
}

QString nothing_varies(const QString& why_not_run) {
    const auto text =
        SweepsDock::tr("This sweep varies nothing yet. Add a parameter, then the values that it takes.");
    return why_not_run.isEmpty() ? text : text + QStringLiteral("\n\n") + why_not_run;
}

}  // namespace

SweepsDock::SweepsDock(Session& session, const Preferences& preferences, engine::SweepRunner runner,
                       QWidget* parent)
    : QWidget(parent),
      session_(session),
      preferences_(preferences),
      runs_(std::move(runner)),
      panel_(new SweepPanel) {
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->addWidget(panel_);
    redraw_.setSingleShot(true);
    redraw_.setInterval(redraw_ms);
    connect(&redraw_, &QTimer::timeout, this, &SweepsDock::update);
    connect_panel();
    connect_runs();
    connect(&session_, &Session::project_replaced, this, &SweepsDock::forget_all);
    connect(&session_, &Session::document_changed, this, &SweepsDock::look);
    connect(&session_.files(), &ProjectFiles::files_changed, this, &SweepsDock::look);
    update();
}

void SweepsDock::connect_panel() {
    connect(panel_, &SweepPanel::sweep_chosen, this,
            [this](const QString& id) { show_sweep(id.toStdString()); });
    connect(panel_, &SweepPanel::new_wanted, this, &SweepsDock::add_sweep);
    connect(panel_, &SweepPanel::axis_wanted, this, &SweepsDock::add_first_axis);
    connect(panel_, &SweepPanel::edit_wanted, this, [this] { emit edit_wanted(text_of(chosen())); });
    connect(panel_, &SweepPanel::run_wanted, this, &SweepsDock::run);
    connect(panel_, &SweepPanel::pause_wanted, this, &SweepsDock::pause);
    connect(panel_, &SweepPanel::cancel_wanted, this, &SweepsDock::cancel);
    connect(panel_, &SweepPanel::judging_chosen, this, [this](bool judges) {
        judges_ = judges;
        update();
    });
    connect(panel_, &SweepPanel::plot_chosen, this, [this](const QString& id) {
        plot_ = id.toStdString();
        update();
    });
    connect(panel_, &SweepPanel::quantity_chosen, this, [this](const QString& id) {
        quantity_ = id.toStdString();
        update();
    });
    connect(panel_, &SweepPanel::tab_chosen, this, &SweepsDock::update);
    connect(panel_, &SweepPanel::variation_chosen, this, &SweepsDock::load_variation);
    connect(panel_, &SweepPanel::csv_wanted, this, &SweepsDock::export_csv);
    connect(panel_, &SweepPanel::report_wanted, this,
            [this] { emit report_wanted(text_of(folder().string()), text_of(chosen())); });
    connect(panel_, &SweepPanel::folder_wanted, this, &SweepsDock::ask_for_folder);
    connect(panel_, &SweepPanel::own_folder_wanted, this, [this] { open_folder({}); });
    connect(&preferences_, &Preferences::maps_changed, this, [this] {
        panel_->sheet().pictures().restart();
        panel_->sheet().viewport()->update();
    });
}

void SweepsDock::connect_runs() {
    connect(&runs_, &SweepRuns::planned, this, [this](const engine::SweepTable& table) {
        run_sheet_ = {};
        run_sheet_.table = table;
        run_sheet_.stale.resize(table.rows.size());
        if (shows_run()) take(run_sheet_);
    });
    connect(&runs_, &SweepRuns::begun, this, [this](std::size_t row) {
        const auto before = std::exchange(at_, row);
        fraction_ = 0;
        doing_.clear();
        if (run_ == Run::paused) run_ = Run::running;
        if (!shows_run()) return;
        for (const auto each : {before, row})
            if (each < sheet_.table.rows.size()) panel_->set_line(int(each), line(each));
        if (!redraw_.isActive()) redraw_.start();
    });
    connect(&runs_, &SweepRuns::rows_arrived, this, [this](const SweepRuns::Rows& rows) {
        fraction_ = 0;
        for (const auto& [row, outcome] : rows) run_sheet_.table.rows.at(row) = outcome;
        if (!shows_run()) return;
        for (const auto& [row, outcome] : rows)
            if (row < sheet_.table.rows.size()) sheet_.table.rows[row] = outcome;
        if (sweep_columns(sheet_.table) != columns_)
            show_rows();
        else
            for (const auto& [row, outcome] : rows)
                if (row < sheet_.table.rows.size()) panel_->set_line(int(row), line(row));
        if (!redraw_.isActive()) redraw_.start();
    });
    connect(&runs_, &SweepRuns::progressed, this, [this](const QString& what, double fraction) {
        doing_ = what;
        fraction_ = fraction;
        if (!redraw_.isActive()) redraw_.start();
    });
    connect(&runs_, &SweepRuns::paused, this, [this] {
        if (run_ == Run::pausing) run_ = Run::paused;
        update();
    });
    connect(&runs_, &SweepRuns::noted, this, &SweepsDock::said);
    connect(&runs_, &SweepRuns::finished, this, [this] {
        end_run({});
        const auto failures = count_failed(run_sheet_);
        emit said(failures == 0
                      ? tr("The sweep is through")
                      : tr("The sweep is through; %1 failed")
                            .arg(widgets::counted(int(failures), tr("variation"), tr("variations"))));
    });
    connect(&runs_, &SweepRuns::failed, this, [this](const QString& error, bool cancelled) {
        end_run(cancelled ? QString() : error);
        cancelled ? emit said(tr("Cancelled the sweep; Run goes on with it")) : emit failed(error);
    });
}

bool SweepsDock::shows_run() const {
    return run_ != Run::none && running_ == chosen() && running_folder_ == folder();
}

void SweepsDock::end_run(const QString& problem) {
    problem_ = problem;
    running_.clear();
    run_ = Run::none;
    look();
}

const projects::Sweep* SweepsDock::sweep() const {
    return session_.has_project() ? projects::find_item(session_.document().sweeps, chosen()) : nullptr;
}

const projects::Experiment* SweepsDock::base() const {
    return session_.experiment(sheet_.is_foreign ? sheet_.table.experiment
                               : sweep()         ? sweep()->experiment
                                                 : std::string());
}

std::string SweepsDock::chosen() const {
    if (!session_.has_project()) return {};
    const auto& sweeps = session_.document().sweeps;
    if (projects::find_item(sweeps, chosen_)) return chosen_;
    return sweeps.empty() ? std::string() : sweeps.front().id;
}

fs::path SweepsDock::own_folder() const {
    const auto& project = session_.open_project().folder();
    return project.empty() ? fs::path() : project / "results" / projects::sweep_path(chosen());
}

fs::path SweepsDock::folder() const {
    const auto opened = opened_.find(chosen());
    return opened == opened_.end() ? own_folder() : opened->second;
}

engine::SweepJob SweepsDock::job() const {
    engine::SweepJob job;
    job.project = session_.document();
    job.folder = session_.open_project().folder();
    job.sweep = *sweep();
    job.out = folder();
    job.is_judged = judges_;
    job.repeats = engine::usual_repeats(judges_);
    job.resumes = true;
    return job;
}

void SweepsDock::show_sweep(const std::string& id) {
    const bool is_other = std::exchange(chosen_, id) != id;
    if (is_other) clear_sheet();
    problem_.clear();
    look();
}

void SweepsDock::add_sweep() {
    if (!session_.has_project()) return;
    const auto* shown = session_.experiment();
    if (!session_.edit(widgets::makers::add_sweep(shown ? shown->id : std::string()))) return;
    session_.end_gesture();
    show_sweep(session_.document().sweeps.back().id);
    emit edit_wanted(text_of(chosen()));
}

void SweepsDock::sweep_parameter(const std::string& key) {
    const auto* shown = session_.experiment();
    const bool is_its = shown && sweep() && sweep()->experiment == shown->id;
    if (is_its && varies(*sweep(), key)) return emit edit_wanted(text_of(chosen()));
    if (shown) add_axis(is_its ? sweep()->id : std::string(), shown->id, key);
}

/// Another one is chosen in the form, which shows it then.
void SweepsDock::add_first_axis() {
    const auto* experiment = sweep() ? base() : nullptr;
    if (!experiment) return;
    add_axis(sweep()->id, experiment->id, first_axis_of(session_.registry().find(experiment->method)));
}

void SweepsDock::add_axis(const std::string& sweep, const std::string& experiment, const std::string& key) {
    const bool is_new = sweep.empty();  // the edit makes other items
    if (!session_.edit(widgets::makers::add_axis(sweep, experiment, key))) return;
    session_.end_gesture();
    if (is_new) show_sweep(session_.document().sweeps.back().id);
    emit edit_wanted(text_of(chosen()));
}

void SweepsDock::open_folder(const fs::path& folder) {
    if (folder.empty())
        opened_.erase(chosen());
    else
        opened_[chosen()] = folder;
    clear_sheet();
    look();
}

void SweepsDock::ask_for_folder() {
    const auto start = folder().empty() ? dialog_folder(session_) : text_of(folder().string());
    const auto chosen_folder = QFileDialog::getExistingDirectory(this, tr("Results of a sweep"), start);
    if (!chosen_folder.isEmpty()) open_folder(chosen_folder.toStdString());
}

void SweepsDock::set_visible_to_user(bool seen) {
    if (std::exchange(seen_, seen) == seen) return;
    if (seen_ && outdated_) look();
}

bool SweepsDock::is_settled() const {
    return !runs_.is_running() && !reader_.is_running() &&
           !(panel_->sheet().isVisible() && panel_->sheet().pictures().is_reading());
}

/// Another project: what runs is not its own.
void SweepsDock::forget_all() {
    runs_.cancel();
    opened_.clear();
    clear_sheet();
    problem_.clear();
    look();
}

void SweepsDock::look() {
    outdated_ = !seen_;
    if (!seen_) return;
    reader_.drop_waiting();
    if (!sweep()) {
        sheet_ = {};
        show_rows();
        return update();
    }
    if (shows_run()) return take(run_sheet_);  // its run tells more
    update();
    reader_.start([this, job = job(), shown = chosen(),
                   &registry = session_.registry()](const std::atomic<bool>& cancelled) {
        auto sheet = std::make_shared<engine::SweepSheet>(
            engine::look_at_sweep(job, registry, [&cancelled] { return cancelled.load(); }));
        return [this, sheet, shown, out = job.out] {
            if (!sweep() || shown != chosen() || out != folder()) return;
            if (!shows_run()) take(std::move(*sheet));
        };
    });
}

void SweepsDock::take(engine::SweepSheet sheet) {
    sheet_ = std::move(sheet);
    show_rows();
    update();
}

QString SweepsDock::why_not_run() const {
    if (!sweep()) return tr("There is no sweep.");
    const auto& open = session_.open_project();
    if (open.folder().empty())
        return tr("Save the project first (Ctrl+S): the variations are files in its folder.");
    if (open.is_read_only()) return read_only_text(open);
    if (opened_.count(chosen())) return tr("These results are in another folder; go back to the project's.");
    if (!sheet_.refused.empty()) return text_of(sheet_.refused);
    if (sheet_.is_foreign) return tr("The sweep's folder has results of another one; move them away.");
    return {};
}

void SweepsDock::run() {
    if (runs_.is_running() || !why_not_run().isEmpty()) return;
    if (!runs_.start({job(), preferences_.machine(), preferences_.machine_settings().memory_budget()}))
        return;
    running_ = chosen();
    running_folder_ = folder();
    run_ = Run::running;
    run_sheet_ = sheet_;
    at_ = run_sheet_.table.rows.size();
    doing_ = tr("Starting …");
    fraction_ = 0;
    problem_.clear();
    update();
}

void SweepsDock::pause(bool pauses) {
    if (run_ == Run::none) return;
    run_ = pauses ? Run::pausing : Run::running;
    runs_.pause(pauses);
    update();
}

void SweepsDock::cancel() {
    runs_.cancel();
}

void SweepsDock::load_variation(const QString& id) {
    const auto& rows = sheet_.table.rows;
    const auto wanted = id.toStdString();
    const auto row =
        std::find_if(rows.begin(), rows.end(), [&](const SweepRow& each) { return each.id == wanted; });
    if (row == rows.end()) return;
    const auto* experiment = base();
    if (!experiment) return emit said(tr("The experiment of this variation is gone."));
    const auto experiment_id = text_of(experiment->id);  // the edit makes another experiment
    const auto loading =
        load_setting(session_, experiment->id, row->coordinates, text_of(engine::name_of(*row)), "sweep");
    if (!loading.failed.isEmpty()) return emit failed(loading.failed);
    if (loading.said.isEmpty()) return;
    emit said(loading.said);
    emit loaded(experiment_id);
}

void SweepsDock::save(Json& memory) const {
    auto& own = memory["sweeps"];
    own = {{"chosen", chosen()},
           {"judges", judges_},
           {"plot", plot_},
           {"quantity", quantity_},
           {"tab", panel_->tab()},
           {"shows", panel_->shows()},
           {"sorted_by", panel_->sorted_by().toStdString()},
           {"descending", panel_->is_descending()},
           {"hidden", Json::array()}};
    for (const auto& heading : panel_->hidden_columns()) own["hidden"].push_back(heading.toStdString());
    for (const auto& [id, folder] : opened_) own["folders"][id] = folder.string();
}

void SweepsDock::load(const Json& memory) {
    const auto& own = member_or_null(memory, "sweeps");
    chosen_ = field_or(own, "chosen", std::string());
    judges_ = field_or(own, "judges", true);
    plot_ = field_or(own, "plot", std::string());
    quantity_ = field_or(own, "quantity", std::string());
    panel_->set_tab(field_or(own, "tab", 0));
    panel_->set_shows(field_or(own, "shows", 0));
    QStringList hidden;
    for (const auto& heading : member_or_null(own, "hidden"))
        if (heading.is_string()) hidden << text_of(heading.get<std::string>());
    panel_->hide_columns(hidden);
    opened_.clear();
    if (const auto& folders = member_or_null(own, "folders"); folders.is_object())
        for (const auto& [id, folder] : folders.items())
            if (folder.is_string()) opened_[id] = folder.get<std::string>();
    clear_sheet();
    panel_->sort_by(text_of(field_or(own, "sorted_by", std::string())), field_or(own, "descending", false));
    look();
}

SweepLine SweepsDock::line(std::size_t row) const {
    return sweep_line(sheet_, columns_, row, folder(), shows_run() && row == at_);
}

void SweepsDock::show_rows() {
    columns_ = sweep_columns(sheet_.table);
    auto rows = sweep_headings(columns_);
    for (std::size_t i = 0; i < sheet_.table.rows.size(); ++i) rows.lines.push_back(line(i));
    panel_->set_rows(std::move(rows));
}

void SweepsDock::clear_sheet() {
    sheet_ = {};
    show_rows();
    panel_->sheet().pictures().restart();
}

void SweepsDock::update() {
    panel_->set_fields(fields());
}

widgets::SweepFields SweepsDock::fields() const {
    widgets::SweepFields fields;
    if (!session_.has_project()) {
        fields.empty = tr("No project is open.");
        fields.why_read_only = fields.empty;
        fields.why_not_run = fields.empty;
        return fields;
    }
    const auto& document = session_.document();
    const auto& open = session_.open_project();
    for (const auto& each : document.sweeps)
        fields.sweeps.push_back({text_of(each.id), name_text(each), text_of(each.id)});
    fields.sweep = text_of(chosen());
    if (open.is_read_only()) fields.why_read_only = read_only_text(open);
    if (!sweep()) {
        const bool can_have = !document.experiments.empty() && !open.is_read_only();
        fields.empty =
            tr("A sweep renders an experiment at all combinations of some values: parameters, size, "
               "seed, frames, time, camera, lights or scene. Its variations are seen beside each "
               "other, as a table and as plots.");
        fields.empty +=
            QStringLiteral("\n\n") + (can_have                       ? tr("This project has none yet.")
                                      : document.experiments.empty() ? tr("It needs an experiment.")
                                                                     : fields.why_read_only);
        if (can_have) fields.button = tr("New sweep");
        fields.why_not_run = tr("There is no sweep.");
        return fields;
    }
    fields.is_judged = judges_;
    fields.is_elsewhere = opened_.count(chosen()) != 0;
    fields.run = run_;
    fields.why_not_run = why_not_run();
    if (sheet_.table.rows.empty() && !sheet_.refused.empty())
        fields.empty =
            tr("This sweep has no variations.\n\n%1\n\nEdit it to mend that.").arg(text_of(sheet_.refused));
    if (sweep()->axes.empty() && run_ == Run::none && count_done(sheet_) == 0) {
        fields.empty = nothing_varies(fields.why_not_run);
        if (!open.is_read_only()) fields.button = tr("Add a parameter …");
    }
    fields.run_tip = count_done(sheet_) > 0
                         ? tr("Render the variations that are missing, that failed, and that would be other "
                              "pictures now")
                         : tr("Render all variations");
    if (run_ != Run::none) {
        fields.doing = doing();
        const double count = std::max<double>(1, double(run_sheet_.table.rows.size()));
        const auto ended = count_done(run_sheet_) + count_failed(run_sheet_);
        fields.fraction = (double(ended) + fraction_) / count;
    }
    if (const auto* experiment = base())
        if (const auto* method = session_.registry().find(experiment->method))
            if (const auto* output = main_output(*method, projects::effective(*experiment).values))
                fields.semantic = output->semantic;
    fill_sweep_plot(fields, sheet_.table, columns_, {plot_, quantity_});
    if (panel_->tab() != SweepPanel::plot_tab)
        fields.data = panel_->fields().data;  // drawn when it is seen
    else
        draw_sweep_plot(fields, sheet_.table);
    fill_foot(fields);
    return fields;
}

QString SweepsDock::doing() const {
    if (run_ == Run::paused) return tr("Paused");
    const auto& rows = run_sheet_.table.rows;
    auto text = at_ < rows.size() ? tr("%1 of %2").arg(at_ + 1).arg(rows.size()) : QString();
    if (!doing_.isEmpty()) text += (text.isEmpty() ? QString() : QStringLiteral(": ")) + doing_;
    return run_ == Run::pausing ? tr("Pauses after this one, %1").arg(text) : text;
}

/// Whose results these are, and what is to be known of them.
void SweepsDock::fill_foot(widgets::SweepFields& fields) const {
    QStringList parts;
    const auto problem = problem_.isEmpty() ? text_of(sheet_.problem) : problem_;
    if (!problem.isEmpty()) parts << problem;
    parts << tr("%1 of %2 variations").arg(count_done(sheet_)).arg(sheet_.table.rows.size());
    const auto stale = std::count(sheet_.stale.begin(), sheet_.stale.end(), true);
    if (stale > 0) parts << tr("%1 stale").arg(stale);
    const auto failures = count_failed(sheet_);
    if (failures > 0) parts << tr("%1 failed").arg(failures);
    if (sheet_.is_foreign) parts << tr("of the sweep %1").arg(text_of(sheet_.table.sweep));
    if (!fields.why_not_run.isEmpty() && problem.isEmpty() && run_ == Run::none) parts << fields.why_not_run;
    if (!folder().empty()) parts << text_of(folder().string());
    fields.is_warning = !problem.isEmpty() || failures > 0 || stale > 0;
    fields.foot = parts.join(QStringLiteral("  ·  "));
    fields.foot_tip = parts.join(QLatin1Char('\n'));
}

void SweepsDock::write_csv(const QString& file) const {
    write_file(file.toStdString(), engine::table_csv(sheet_.table));
}

void SweepsDock::export_csv() {
    const auto file =
        ask_for_export(this, tr("Export"), (sweep() ? name_text(*sweep()) : QString()) + tr(" sweep"),
                       tr("Comma-separated values (*.csv)"), {QStringLiteral(".csv")});
    if (file.isEmpty()) return;
    try {
        write_csv(file);
        emit said(tr("Wrote %1").arg(file));
    } catch (const Error& error) {
        emit failed(text_of(error.what()));
    }
}

}  // namespace ir::gui
