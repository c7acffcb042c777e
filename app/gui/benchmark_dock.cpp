#include "app/gui/benchmark_dock.h"

#include <QDateTime>
#include <QVBoxLayout>
#include <algorithm>

#include "app/gui/dialog_folder.h"
#include "app/gui/json_fields.h"
#include "app/gui/redraw.h"
#include "app/gui/text_of.h"
#include "renderers/core/error.h"
#include "renderers/core/limits.h"
#include "renderers/core/write_file.h"
#include "widgets/style/number_text.h"

namespace ir::gui {
namespace {

using widgets::BenchmarkLine;

const QString own_place = QStringLiteral("own"), experiments_place = QStringLiteral("experiment");

bool is_known(const std::string& name) {
    const auto& all = engine::benchmarks();
    return std::any_of(all.begin(), all.end(), [&](const auto& each) { return each.benchmark.name == name; });
}

QString settings_text(const Settings& settings) {
    QStringList lines;
    for (const auto& [key, value] : settings)
        lines << QStringLiteral("%1 = %2").arg(text_of(key), text_of(to_string(value)));
    return lines.isEmpty() ? BenchmarkDock::tr("The method's defaults") : lines.join(QLatin1Char('\n'));
}

}  // namespace

BenchmarkDock::BenchmarkDock(Session& session, const Preferences& preferences, engine::BenchmarkRunner runner,
                             QWidget* parent)
    : QWidget(parent),
      session_(session),
      preferences_(preferences),
      runs_(runner ? std::move(runner) : engine::run_request),
      panel_(new widgets::BenchmarkPanel),
      chosen_(engine::benchmarks().front().benchmark.name) {
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->addWidget(panel_);
    redraw_.setSingleShot(true);
    redraw_.setInterval(redraw_ms);
    connect(&redraw_, &QTimer::timeout, this, &BenchmarkDock::update);
    connect_panel();
    connect_runs();
    follow(session_, this, &BenchmarkDock::update);
    update();
}

void BenchmarkDock::connect_panel() {
    using Panel = widgets::BenchmarkPanel;
    connect(panel_, &Panel::benchmark_chosen, this, [this](const QString& id) { choose(id.toStdString()); });
    connect(panel_, &Panel::place_chosen, this, [this](const QString& id) {
        at_experiment_ = id == experiments_place;
        update();
    });
    connect(panel_, &Panel::repeats_chosen, this, [this](int repeats) { repeats_ = repeats; });
    connect(panel_, &Panel::variants_chosen, this, [this](const QStringList& labels) {
        auto& skipped = skipped_[chosen_];
        skipped.clear();
        for (const auto& variant : chosen().benchmark.variants)
            if (!labels.contains(text_of(variant.label))) skipped.insert(variant.label);
        update();
    });
    connect(panel_, &Panel::run_wanted, this, &BenchmarkDock::run);
    connect(panel_, &Panel::cancel_wanted, this, &BenchmarkDock::cancel);
    connect(panel_, &Panel::csv_wanted, this, [this] {
        export_to(QStringLiteral(".csv"), tr("Comma-separated values (*.csv)"), &BenchmarkDock::write_csv);
    });
    connect(panel_, &Panel::json_wanted, this,
            [this] { export_to(QStringLiteral(".json"), tr("JSON (*.json)"), &BenchmarkDock::write_json); });
}

void BenchmarkDock::connect_runs() {
    connect(&runs_, &BenchmarkRuns::reported, this, [this](const engine::BenchmarkReport& report) {
        reports_[running_] = report;
        update();
    });
    connect(&runs_, &BenchmarkRuns::progressed, this, [this](const engine::BenchmarkProgress& progress) {
        progress_ = progress;
        if (!redraw_.isActive()) redraw_.start();
    });
    connect(&runs_, &BenchmarkRuns::finished, this, [this](const engine::BenchmarkReport& report) {
        reports_[running_] = report;
        emit said(
            tr("%1: %2 measured")
                .arg(text_of(running_), widgets::counted(int(report.rows.size()), tr("row"), tr("rows"))));
        running_.clear();
        update();
    });
    connect(&runs_, &BenchmarkRuns::failed, this, [this](const QString& error, bool cancelled) {
        problems_[running_] = cancelled ? tr("Cancelled") : error;
        running_.clear();
        update();
        cancelled ? emit said(tr("Cancelled the benchmark")) : emit failed(error);
    });
}

const engine::NamedBenchmark& BenchmarkDock::chosen() const {
    return engine::find_benchmark(chosen_);
}

void BenchmarkDock::choose(const std::string& benchmark) {
    if (is_known(benchmark)) chosen_ = benchmark;
    update();
}

std::vector<std::string> BenchmarkDock::chosen_variants() const {
    std::vector<std::string> labels;
    const auto skipped = skipped_.find(chosen_);
    for (const auto& variant : chosen().benchmark.variants)
        if (skipped == skipped_.end() || !skipped->second.count(variant.label))
            labels.push_back(variant.label);
    return labels;
}

bool BenchmarkDock::runs_at_experiment() const {
    return at_experiment_ && session_.experiment();
}

std::optional<engine::BenchmarkRequest::Place> BenchmarkDock::place() const {
    if (!runs_at_experiment()) return {};
    return engine::BenchmarkRequest::Place{session_.document(), session_.experiment()->id,
                                           session_.open_project().folder()};
}

QString BenchmarkDock::why_not_run() const {
    return chosen_variants().empty() ? tr("No variant is checked.") : QString();
}

void BenchmarkDock::run() {
    if (runs_.is_running() || !why_not_run().isEmpty()) return;
    running_ = chosen_;
    progress_ = {};
    reports_.erase(running_);
    problems_.erase(running_);
    runs_.start({running_, place(), chosen_variants(), repeats_, preferences_.machine(),
                 preferences_.machine_settings().memory_budget()});
    update();
}

void BenchmarkDock::cancel() {
    runs_.cancel();
}

const engine::BenchmarkReport* BenchmarkDock::report() const {
    const auto found = reports_.find(chosen_);
    return found == reports_.end() ? nullptr : &found->second;
}

void BenchmarkDock::write_csv(const QString& file) const {
    if (report()) write_file(file.toStdString(), engine::benchmark_csv(*report()));
}

void BenchmarkDock::write_json(const QString& file) const {
    if (report()) write_file(file.toStdString(), engine::benchmark_json(*report()));
}

void BenchmarkDock::export_to(const QString& suffix, const QString& filter,
                              void (BenchmarkDock::*write)(const QString&) const) {
    const auto file = ask_for_export(this, tr("Export"), text_of(chosen_), filter, {suffix});
    if (file.isEmpty()) return;
    try {
        (this->*write)(file);
        emit said(tr("Wrote %1").arg(file));
    } catch (const Error& error) {
        emit failed(text_of(error.what()));
    }
}

void BenchmarkDock::save(projects::Json& memory) const {
    auto& own = memory["benchmarks"];
    own = {{"chosen", chosen_}, {"at_experiment", at_experiment_}, {"repeats", repeats_}};
    own["skipped"] = projects::Json::object();
    for (const auto& [benchmark, labels] : skipped_)
        if (!labels.empty()) own["skipped"][benchmark] = labels;
}

void BenchmarkDock::load(const projects::Json& memory) {
    const auto& own = member_or_null(memory, "benchmarks");
    const auto remembered = field_or(own, "chosen", std::string());
    if (!runs_.is_running() && is_known(remembered)) chosen_ = remembered;
    at_experiment_ = field_or(own, "at_experiment", false);
    repeats_ = std::clamp(field_or(own, "repeats", 5), 1, max_repeats);
    skipped_.clear();
    const auto& skipped = member_or_null(own, "skipped");
    for (const auto& [name, benchmark] : engine::benchmarks()) {
        const auto& labels = member_or_null(skipped, benchmark.name.c_str());
        if (!labels.is_array()) continue;
        for (const auto& label : labels)
            if (label.is_string()) skipped_[benchmark.name].insert(label.get<std::string>());
    }
    update();
}

void BenchmarkDock::update() {
    panel_->set_fields(fields());
}

widgets::BenchmarkFields BenchmarkDock::fields() const {
    widgets::BenchmarkFields fields;
    for (const auto& [method, benchmark] : engine::benchmarks())
        fields.benchmarks.push_back(
            {text_of(benchmark.name), text_of(benchmark.name), text_of(benchmark.doc)});
    fields.benchmark = text_of(chosen_);
    const auto& own = chosen().benchmark.scene;
    fields.places.push_back({own_place, tr("Its scene: %1").arg(text_of(own)), {}});
    if (const auto* experiment = session_.experiment())
        fields.places.push_back({experiments_place, tr("Scene of %1").arg(text_of(experiment->name)), {}});
    fields.place = runs_at_experiment() ? experiments_place : own_place;
    fields.repeats = repeats_;
    fields.table = table();
    fields.is_running = runs_.is_running();
    fields.has_numbers = report() && !report()->rows.empty();
    fields.doing = doing();
    fields.fraction = progress_.fraction;
    fields.why_not_run = why_not_run();
    show_foot(fields);
    return fields;
}

BenchmarkLine BenchmarkDock::line(const std::string& label, bool is_peer) const {
    BenchmarkLine line;
    line.label = text_of(label);
    line.is_peer = is_peer;
    const auto skipped = skipped_.find(chosen_);
    line.is_chosen = is_peer || skipped == skipped_.end() || !skipped->second.count(label);
    if (running_ == chosen_ && progress_.label == label) line.state = BenchmarkLine::State::running;
    const auto* numbers = report();
    if (!numbers) return line;
    for (const auto& row : numbers->rows) {
        if (row.label != label || row.is_peer != is_peer) continue;
        line.problem = text_of(row.problem);
        line.state = row.problem.empty() ? BenchmarkLine::State::measured : BenchmarkLine::State::failed;
    }
    return line;
}

widgets::BenchmarkTable BenchmarkDock::table() const {
    widgets::BenchmarkTable table;
    const auto& benchmark = chosen().benchmark;
    for (const auto& variant : benchmark.variants) {
        table.lines.push_back(line(variant.label, false));
        table.lines.back().tip = settings_text(variant.settings);
    }
    for (const auto& peer : benchmark.peers) {
        table.lines.push_back(line(peer.label, true));
        table.lines.back().tip = tr("A peer: it answers the same question in another way, in the same run.");
    }
    put_numbers(table);
    return table;
}

void BenchmarkDock::put_numbers(widgets::BenchmarkTable& table) const {
    engine::BenchmarkReport none;  // has headings, too
    none.columns = engine::columns_of(chosen().benchmark);
    const auto& numbers = report() ? *report() : none;
    for (std::size_t column = 0; column < numbers.columns.size(); ++column) {
        const auto shown = engine::shown_column(numbers, column);
        table.headings << text_of(shown.heading);
        table.docs << text_of(numbers.columns[column].doc);
        for (auto& line : table.lines) {
            auto& cell = line.cells.emplace_back();
            for (std::size_t row = 0; row < numbers.rows.size(); ++row) {
                if (text_of(numbers.rows[row].label) != line.label ||
                    numbers.rows[row].is_peer != line.is_peer)
                    continue;
                cell = {text_of(shown.cells[row]), numbers.rows[row].cells[column], shown.is_best[row]};
            }
        }
    }
}

QString BenchmarkDock::doing() const {
    if (!runs_.is_running()) return {};
    if (progress_.rows == 0) return tr("Starting …");
    const auto repeat = progress_.repeat == 0
                            ? tr("cold run")
                            : tr("warm run %1 of %2").arg(progress_.repeat).arg(progress_.repeats);
    auto text = tr("%1 of %2: %3, %4")
                    .arg(progress_.row + 1)
                    .arg(progress_.rows)
                    .arg(text_of(progress_.label), repeat);
    if (!progress_.what.empty()) text += QStringLiteral(", ") + text_of(progress_.what);
    return text;
}

/// Of which run the numbers are, or what there is to do.
void BenchmarkDock::show_foot(widgets::BenchmarkFields& fields) const {
    const auto caution =
        tr("Times that are measured while pictures are rendered in the views are longer than those of either "
           "alone; for clean times close the views' pictures or use the command line.");
    const auto* numbers = report();
    const auto problem = problems_.find(chosen_);
    const auto ended = problem == problems_.end() ? QString() : problem->second;
    if (!numbers) {
        fields.is_warning = !ended.isEmpty();
        fields.foot = !ended.isEmpty()     ? ended
                      : runs_.is_running() ? tr("The first row comes when its variant is measured.")
                                           : tr("Not measured yet: Run measures the checked variants.");
        fields.foot_tip = fields.foot + QLatin1Char('\n') + caution;
        return;
    }
    QStringList parts;
    if (!ended.isEmpty()) parts << ended;
    parts << tr("on %1").arg(text_of(numbers->device)) << text_of(numbers->scene)
          << QStringLiteral("%1×%2").arg(numbers->width).arg(numbers->height)
          << tr("median of %1").arg(numbers->repeats) << date_text(numbers->date);
    for (const auto& note : numbers->notes) parts << text_of(note);
    fields.is_warning = !ended.isEmpty() || !numbers->notes.empty();
    fields.foot = parts.join(QStringLiteral("  ·  "));
    fields.foot_tip = parts.join(QLatin1Char('\n')) + QStringLiteral("\n\n") + caution;
}

}  // namespace ir::gui
