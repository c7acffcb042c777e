#include "app/gui/benchmark_dock.h"

#include <QFileDialog>
#include <QVBoxLayout>
#include <algorithm>

#include "app/gui/dialog_folder.h"
#include "app/gui/json_fields.h"
#include "app/gui/text_of.h"
#include "renderers/core/error.h"
#include "renderers/core/write_file.h"

namespace ir::gui {
namespace {

constexpr int redraw_ms = 60;
constexpr int most_repeats = 1000;

const QString own_place = QStringLiteral("own"), experiments_place = QStringLiteral("experiment");

bool is_known(const std::string& name) {
    const auto& all = engine::benchmarks();
    return std::any_of(all.begin(), all.end(), [&](const auto& each) { return each.benchmark.name == name; });
}

}  // namespace

BenchmarkDock::BenchmarkDock(Session& session, engine::BenchmarkRunner runner, QWidget* parent)
    : QWidget(parent),
      session_(session),
      runs_(std::move(runner)),
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
    for (auto signal :
         {&Session::project_replaced, &Session::document_changed, &Session::experiment_selected})
        connect(&session_, signal, this, &BenchmarkDock::update);
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
        emit said(tr("%1: %n row(s) measured", nullptr, int(report.rows.size())).arg(text_of(running_)));
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
    runs_.start({running_, place(), chosen_variants(), repeats_});
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
    auto file =
        QFileDialog::getSaveFileName(this, tr("Export"), export_proposal(text_of(chosen_), suffix), filter);
    if (file.isEmpty()) return;
    remember_export(file);
    if (!file.endsWith(suffix, Qt::CaseInsensitive)) file += suffix;
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
    repeats_ = std::clamp(field_or(own, "repeats", 5), 1, most_repeats);
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

}  // namespace ir::gui
