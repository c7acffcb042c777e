#include <QDateTime>
#include <algorithm>

#include "app/gui/benchmark_dock.h"
#include "app/gui/text_of.h"

/// What the panel of benchmarks shows.
namespace ir::gui {
namespace {

using widgets::BenchmarkLine;

QString settings_text(const Settings& settings) {
    QStringList lines;
    for (const auto& [key, value] : settings)
        lines << QStringLiteral("%1 = %2").arg(text_of(key), text_of(to_string(value)));
    return lines.isEmpty() ? BenchmarkDock::tr("The method's defaults") : lines.join(QLatin1Char('\n'));
}

QString date_text(const std::string& date) {
    const auto when = QDateTime::fromString(text_of(date), Qt::ISODate);
    return when.isValid() ? when.toLocalTime().toString(QStringLiteral("yyyy-MM-dd HH:mm")) : text_of(date);
}

}  // namespace

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
