#include <QApplication>
#include <QClipboard>
#include <QFileDialog>

#include "app/gui/dialog_folder.h"
#include "app/gui/json_fields.h"
#include "app/gui/plots_dock.h"
#include "app/gui/text_of.h"
#include "app/gui/write_picture.h"
#include "projects/scene_files.h"
#include "renderers/core/error.h"
#include "renderers/core/write_file.h"
#include "widgets/document/plot_options.h"

/// What the dock shows of a plot, and how that leaves it.
namespace ir::gui {
namespace {

using engine::KeptStudy;
using projects::Json;

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

}  // namespace

std::shared_ptr<const KeptStudy> PlotsDock::shown_numbers() const {
    const auto found = states_.find(chosen());
    if (found == states_.end()) return nullptr;
    if (found->second.running) return found->second.running;
    return found->second.numbers;
}

PlotLook PlotsDock::look_of(const KeptStudy& numbers) const {
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
    DrawnStudy drawn =
        draw_study(document, session_.registry(), *plot(), (numbers ? *numbers : nothing).study,
                   look_of(numbers ? *numbers : nothing));
    if (const auto& problem = state().problem; !problem.isEmpty()) drawn.data.problems.push_front(problem);
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
        choices.plots.push_back(
            {text_of(each.id), text_of(each.name.empty() ? each.id : each.name), text_of(each.notes)});
    choices.plot = text_of(chosen());
    if (open.is_read_only())
        choices.why_read_only = tr("The project is open read-only: %1").arg(text_of(open.read_only_reason()));
    return choices;
}

void PlotsDock::show_header(const DrawnStudy& drawn) {
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
    choices.why_no_log_x = drawn.why_no_log_x;
    choices.why_no_log_y = drawn.why_no_log_y;
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
    const auto& style = on_paper ? widgets::PlotStyle::paper() : widgets::PlotStyle::screen();
    gui::write_picture(file, widgets::plot_picture(panel_->data(), size, scale, style));
}

void PlotsDock::write_numbers(const QString& file) const {
    write_file(file.toStdString(), engine::study_csv(study_with_front()));
}

QString PlotsDock::ask_for_file(const QString& suffix, const QString& filter) {
    auto file =
        QFileDialog::getSaveFileName(this, tr("Export"), export_proposal(text_of(chosen()), suffix), filter);
    if (file.isEmpty()) return {};
    remember_export(file);
    return file.endsWith(suffix, Qt::CaseInsensitive) ? file : file + suffix;
}

void PlotsDock::export_picture(int scale, bool on_paper, bool to_clipboard) {
    const QSize size = on_paper ? QSize(paper_width, paper_height) : panel_->view().size();
    if (to_clipboard) {
        const auto& style = on_paper ? widgets::PlotStyle::paper() : widgets::PlotStyle::screen();
        QApplication::clipboard()->setImage(widgets::plot_picture(panel_->data(), size, scale, style));
        return emit said(tr("Copied the plot"));
    }
    const auto file = ask_for_file(QStringLiteral(".png"), tr("PNG (*.png)"));
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
        const auto file = ask_for_file(QStringLiteral(".csv"), tr("Comma-separated values (*.csv)"));
        if (file.isEmpty()) return;
        write_numbers(file);
        emit said(tr("Wrote %1").arg(file));
    } catch (const Error& error) {
        emit failed(text_of(error.what()));
    }
}

}  // namespace ir::gui
